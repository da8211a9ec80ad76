// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace storey::cameras {
namespace {

constexpr std::size_t kMinPoints = 30;    // a correlation of fewer says nothing
constexpr double kPointsOfCell = 16.0;    // of the depth map
constexpr double kDepthTolerance = 0.02;  // of the depth: what is within it hides nothing
constexpr double kMinFacing = 0.2;        // cosine of a point's normal to its line of sight

/// Nearest depth of the points in each cell of the image.
class DepthMap {
 public:
  DepthMap(const Camera& camera, std::size_t num_points)
      : cell_(std::sqrt(kPointsOfCell * camera.width * camera.height /
                        static_cast<double>(std::max<std::size_t>(num_points, 1)))),
        columns_(static_cast<std::size_t>(camera.width / cell_) + 1),
        nearest_(columns_ * (static_cast<std::size_t>(camera.height / cell_) + 1),
                 std::numeric_limits<double>::infinity()) {}

  double& at(const Eigen::Vector2d& pixel) {
    return nearest_[static_cast<std::size_t>(pixel.y() / cell_) * columns_ +
                    static_cast<std::size_t>(pixel.x() / cell_)];
  }

 private:
  double cell_;
  std::size_t columns_;
  std::vector<double> nearest_;
};

double brightness(const RgbImage& image, const Eigen::Vector2d& pixel) {
  double sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int x = std::clamp(static_cast<int>(pixel.x()) + dx, 0, image.width - 1);
      const int y = std::clamp(static_cast<int>(pixel.y()) + dy, 0, image.height - 1);
      const std::uint8_t* const p = image.at(x, y);
      sum += p[0] + p[1] + p[2];
    }
  }
  return sum / 27.0;
}

bool faces(const CloudPoints& cloud, std::size_t i, const Eigen::Vector3d& center) {
  if (cloud.normals.empty() || cloud.normals[i].isZero()) return true;
  const Eigen::Vector3d sight = (center - cloud.positions[i]).normalized();
  return cloud.normals[i].dot(sight) > kMinFacing;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), static_cast<Eigen::Index>(a.size()));
  const Eigen::Map<const Eigen::ArrayXd> y(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::ArrayXd dx = x - x.sum() / n;
  const Eigen::ArrayXd dy = y - y.sum() / n;
  const double scale = std::sqrt(dx.square().sum() * dy.square().sum());
  return scale > 0.0 ? (dx * dy).sum() / scale : 0.0;
}

struct Sight {
  std::size_t point;
  double brightness;
};

}  // namespace

std::vector<std::size_t> shownPoints(const CloudPoints& cloud, const Camera& camera) {
  DepthMap map(camera, cloud.positions.size());
  std::vector<std::size_t> inside;
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const auto pixel = camera.project(cloud.positions[i]);
    if (!pixel || !camera.contains(*pixel)) continue;
    double& nearest = map.at(*pixel);
    nearest = std::min(nearest, camera.depth(cloud.positions[i]));
    inside.push_back(i);
    pixels.push_back(*pixel);
  }
  std::vector<std::size_t> shown;
  const Eigen::Vector3d center = camera.center();
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const double depth = camera.depth(cloud.positions[inside[k]]);
    const double nearest = map.at(pixels[k]);
    const bool hidden = depth > nearest + kDepthTolerance * std::abs(nearest);
    if (!hidden && faces(cloud, inside[k], center)) shown.push_back(inside[k]);
  }
  return shown;
}

std::vector<PhotoAgreement> measureAgreement(const CloudPoints& cloud,
                                             const std::vector<Camera>& cameras,
                                             const std::vector<RgbImage>& images) {
  std::vector<double> sum(cloud.positions.size(), 0.0);
  std::vector<double> count(cloud.positions.size(), 0.0);
  std::vector<std::vector<Sight>> sights(cameras.size());
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    for (const std::size_t i : shownPoints(cloud, cameras[k])) {
      const double value = brightness(images[k], *cameras[k].project(cloud.positions[i]));
      sights[k].push_back({i, value});
      sum[i] += value;
      count[i] += 1.0;
    }
  }
  std::vector<PhotoAgreement> agreement(cameras.size());
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    std::vector<double> own;
    std::vector<double> others;
    for (const Sight& sight : sights[k]) {
      if (count[sight.point] < 2.0) continue;
      own.push_back(sight.brightness);
      others.push_back((sum[sight.point] - sight.brightness) / (count[sight.point] - 1.0));
    }
    agreement[k].points = own.size();
    if (own.size() >= kMinPoints) agreement[k].correlation = correlation(own, others);
  }
  return agreement;
}

double meanCorrelation(const std::vector<PhotoAgreement>& agreement) {
  double sum = 0.0;
  for (const PhotoAgreement& photo : agreement) sum += photo.correlation;
  return agreement.empty() ? 0.0 : sum / static_cast<double>(agreement.size());
}

}  // namespace storey::cameras
