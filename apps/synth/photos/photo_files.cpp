// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/photo_files.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/cameras/camera_writer.h"
#include "io/images/image_files.h"
#include "io/output_file.h"

namespace storey::synth {
namespace {

using Json = nlohmann::ordered_json;

std::string numbered(const char* format, std::size_t number) {
  char name[48];
  std::snprintf(name, sizeof name, format, number);
  return name;
}

/// The camera in the coordinates that x -> offset + scale R x leads to.
Camera posed(Camera camera, const Pose& pose) {
  const Eigen::Matrix3d rotation = camera.world_to_camera.linear() * pose.rotation().transpose();
  const Eigen::Vector3d shift = pose.scale * camera.world_to_camera.translation();
  camera.world_to_camera.linear() = rotation;
  camera.world_to_camera.translation() = shift - rotation * pose.offset;
  return camera;
}

Json toJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json facadeJson(const PhotoScene& scene, std::size_t f, const Pose& pose, double texel,
                double recess) {
  const FacadeFrame& frame = scene.frames()[f];
  Json windows = Json::array();
  for (const PaintedWindow& w : scene.paints()[f].windows()) {
    const Eigen::Vector4d r =
        pose.scale * Eigen::Vector4d(w.min.x(), w.min.y(), w.max.x(), w.max.y());
    windows.push_back({r[0], r[1], r[2], r[3]});
  }
  return {{"origin", toJson(pose.apply(frame.origin))},
          {"right", toJson(pose.rotation() * frame.right)},
          {"up", toJson(pose.rotation() * frame.up)},
          {"width", pose.scale * frame.width},
          {"height", pose.scale * frame.height},
          {"texel", pose.scale * texel},
          {"image", "truth/" + numbered("facade_%03zu.png", f)},
          {"recess", pose.scale * recess},
          {"windows", windows}};
}

}  // namespace

void writePhotos(const std::string& folder, const PolyhedralModel& model,
                 const PhotoOptions& options, const Pose& pose) {
  const io::OutputDirectory directory(folder);
  const io::OutputDirectory images(directory.file("images"));
  const io::OutputDirectory truth(directory.file("truth"));
  const io::OutputDirectory colmap(directory.file("sparse"));
  const io::OutputDirectory bundler(directory.file("bundler"));

  const PhotoScene scene(model, options);
  io::CameraSet set;
  double texel = std::numeric_limits<double>::infinity();  // the finest that any photo resolves
  for (const Camera& camera : scene.placeCameras()) {
    const std::size_t k = set.photos.size();
    io::Photo photo;
    photo.index = k;
    photo.name = numbered("view_%02zu.png", k);
    photo.camera = posed(camera, pose);
    set.photos.push_back(photo);
    io::writePng(images.file(photo.name), scene.photograph(camera, static_cast<int>(k)));
    for (const Eigen::Vector3d& vertex : model.vertices) {
      texel = std::min(texel, camera.depth(vertex) / camera.focal.x());
    }
  }
  for (const Eigen::Vector3d& vertex : model.vertices) set.points.push_back(pose.apply(vertex));
  io::writeColmapText(colmap.path(), set);
  io::writeBundler(bundler.path(), set);

  Json facades = Json::array();
  for (std::size_t f = 0; f < scene.facades().size(); ++f) {
    io::writePng(truth.file(numbered("facade_%03zu.png", f)), scene.orthoImage(f, texel));
    facades.push_back(facadeJson(scene, f, pose, texel, options.recess));
  }
  io::OutputFile file(directory.file("truth.json"));
  file.write(Json{{"facades", facades}}.dump(1) + "\n");
  file.commit();
}

}  // namespace storey::synth
