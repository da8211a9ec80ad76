// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>

#include "cameras/agreement.h"

namespace storey::cameras {
namespace {

/// A mistake and what undoes it.
struct Remedy {
  std::string mistake;
  std::function<void(Camera&)> undo;
};

void mirrorAcross(Camera& camera) {
  camera.focal.x() *= -1.0;
  camera.skew *= -1.0;
  camera.principal.x() = camera.width - camera.principal.x();
}

void mirrorUpright(Camera& camera) {
  camera.focal.y() *= -1.0;
  camera.skew *= -1.0;
  camera.principal.y() = camera.height - camera.principal.y();
}

void turnAxes(Camera& camera) {
  camera.world_to_camera =
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()) * camera.world_to_camera;
}

void scaleIntrinsics(Camera& camera, double factor) {
  camera.focal *= factor;
  camera.skew *= factor;
  camera.principal *= factor;
}

std::vector<Remedy> remedies() {
  std::vector<Remedy> all = {
      {"the images are mirrored left to right", mirrorAcross},
      {"the images are upside down and mirrored: y goes up", mirrorUpright},
      {"the images are upside down",
       [](Camera& c) {
         mirrorAcross(c);
         mirrorUpright(c);
       }},
      {"the cameras look along -z, y going up", turnAxes},
      {"the poses are camera to world, not world to camera",
       [](Camera& c) { c.world_to_camera = c.world_to_camera.inverse(); }},
      {"the principal point is wrong, the middle of the image is better",
       [](Camera& c) { c.principal = 0.5 * Eigen::Vector2d(c.width, c.height); }},
      {"the principal point is counted from the middle of the image",
       [](Camera& c) { c.principal += 0.5 * Eigen::Vector2d(c.width, c.height); }}};
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    all.push_back({"focal length and principal point are those of an image " +
                       std::to_string(1.0 / factor).substr(0, 4) + " times as large",
                   [factor](Camera& c) { scaleIntrinsics(c, factor); }});
  }
  for (const double factor : {0.001, 0.01, 0.3048, 100.0, 1000.0}) {
    all.push_back({"the cameras' positions are to be multiplied by " +
                       std::to_string(factor).substr(0, 6) + " (another unit)",
                   [factor](Camera& c) { c.world_to_camera.translation() *= factor; }});
  }
  return all;
}

}  // namespace

std::vector<Suspicion> suspectMistakes(const CloudPoints& cloud, const std::vector<Camera>& cameras,
                                       const std::vector<RgbImage>& images) {
  std::vector<Suspicion> suspicions;
  for (const Remedy& remedy : remedies()) {
    std::vector<Camera> changed = cameras;
    for (Camera& camera : changed) remedy.undo(camera);
    suspicions.push_back(
        {remedy.mistake, meanCorrelation(measureAgreement(cloud, changed, images))});
  }
  std::stable_sort(
      suspicions.begin(), suspicions.end(),
      [](const Suspicion& a, const Suspicion& b) { return a.correlation > b.correlation; });
  return suspicions;
}

}  // namespace storey::cameras
