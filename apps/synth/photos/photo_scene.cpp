// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/photo_scene.h"

#include <storey/surface/triangulation.h>

#include <algorithm>
#include <cmath>

#include "synth/random.h"

namespace storey::synth {
namespace {

const Eigen::Vector3d kSky(150.0, 168.0, 190.0);

enum Stream : std::uint64_t { kExposures = 50, kSensor };

TriangleMesh trianglesOf(const PolyhedralModel& model, std::vector<std::size_t>& facade_of) {
  TriangleMesh mesh;
  mesh.vertices = model.vertices;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    for (const auto& triangle : triangulateFace(model, model.faces[f])) {
      mesh.triangles.push_back(triangle);
      facade_of.push_back(f);
    }
  }
  return mesh;
}

std::uint8_t toLevel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Camera lookingAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target,
                 const PhotoOptions& options) {
  Camera camera;
  camera.width = options.width;
  camera.height = options.width * 3 / 4;
  camera.focal.setConstant(0.5 * camera.width / std::tan(0.5 * options.field_of_view));
  camera.principal = 0.5 * Eigen::Vector2d(camera.width, camera.height);
  const Eigen::Vector3d ahead = (target - center).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  camera.world_to_camera.linear() = rotation;
  camera.world_to_camera.translation() = -rotation * center;
  return camera;
}

}  // namespace

PhotoScene::PhotoScene(const PolyhedralModel& model, const PhotoOptions& options)
    : options_(options), facades_(facadesOf(model)), tree_(trianglesOf(model, facade_of_)) {
  for (const Eigen::Vector3d& vertex : model.vertices) box_.extend(vertex);
  for (std::size_t f = 0; f < facades_.size(); ++f) {
    frames_.push_back(frameOf(facades_[f]));
    outlines_.push_back(frames_[f].outline(facades_[f]));
    paints_.emplace_back(frames_[f], outlines_[f], model.faces[f].label == FaceLabel::Wall,
                         options_.window_pitch, options_.seed * 1000 + f);
  }
  ground_paint_.emplace_back(FacadeFrame{}, FacadeOutline{}, false, options_.window_pitch,
                             options_.seed * 1000 + 999);
  occluders_ = Occluders(box_, options_.occluders, options_.seed);
}

std::vector<Camera> PhotoScene::placeCameras() const {
  const double radius = 0.5 * box_.sizes().norm();
  const double distance =
      radius / std::sin(0.5 * std::atan(0.75 * std::tan(0.5 * options_.field_of_view) * 2.0));
  std::vector<Camera> cameras;
  for (int k = 0; k < options_.views; ++k) {
    const double angle = 2.0 * M_PI * (k + 0.25) / options_.views;
    const double height = box_.sizes().z() * (k % 2 == 0 ? 0.15 : 0.6);
    Eigen::Vector3d center = box_.center();
    center += 0.8 * distance * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    center.z() = box_.min().z() + height;
    cameras.push_back(lookingAt(center, box_.center(), options_));
  }
  return cameras;
}

Eigen::Vector3d PhotoScene::groundColor(const Eigen::Vector3d& at) const {
  return 0.6 * ground_paint_[0].wallColor(at.head<2>());
}

// A ray that falls on a recessed window goes on to its pane or its reveals.
Eigen::Vector3d PhotoScene::facadeColor(std::size_t facade, const Eigen::Vector3d& at,
                                        const Eigen::Vector3d& direction) const {
  const FacadeFrame& frame = frames_[facade];
  const FacadePaint& paint = paints_[facade];
  const Eigen::Vector2d place = frame.local(at);
  const PaintedWindow* const window = paint.windowAt(place);
  const double inwards = -direction.dot(frame.normal());
  if (window == nullptr || options_.recess <= 0.0 || !(inwards > 0.0)) return paint.color(place);
  const Eigen::Vector2d slope =
      Eigen::Vector2d(direction.dot(frame.right), direction.dot(frame.up)) / inwards;
  const Eigen::Vector2d on_pane = place + options_.recess * slope;
  const bool meets_pane =
      (on_pane - window->min).minCoeff() >= 0.0 && (window->max - on_pane).minCoeff() >= 0.0;
  return meets_pane ? paint.color(on_pane) : Eigen::Vector3d(0.7 * paint.wallColor(place));
}

Eigen::Vector3d PhotoScene::colorAlong(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction) const {
  const auto building = tree_.firstHit(from, direction);
  const auto occluder = occluders_.firstHit(from, direction);
  if (occluder && (!building || occluder->distance < building->distance)) return occluder->color;
  if (building) {
    return facadeColor(facade_of_[building->triangle], from + building->distance * direction,
                       direction);
  }
  const double fall = (box_.min().z() - from.z()) / direction.z();
  return fall > 0.0 ? groundColor(from + fall * direction) : kSky;
}

bool PhotoScene::isClear(const Camera& camera, std::size_t facade,
                         const Eigen::Vector3d& point) const {
  const Eigen::Vector3d center = camera.center();
  const auto pixel = camera.project(point);
  if (!pixel || !camera.contains(*pixel)) return false;
  if (!((center - point).dot(frames_[facade].normal()) > 0.0)) return false;
  constexpr double kThere = 1.0 - 1e-6;  // of the way
  const auto building = tree_.firstHit(center, point - center);
  const auto occluder = occluders_.firstHit(center, point - center);
  const bool behind =
      building && building->distance < kThere && facade_of_[building->triangle] != facade;
  return !behind && !(occluder && occluder->distance < kThere);
}

RgbImage PhotoScene::photograph(const Camera& camera, int k) const {
  const auto photo = static_cast<std::uint64_t>(k);
  const double range = std::log1p(options_.exposure);
  const double gain =
      std::exp(Random(options_.seed, kExposures + 2 * photo).uniform(-range, range));
  RgbImage image(camera.width, camera.height);
  const Eigen::Vector3d center = camera.center();
#pragma omp parallel for schedule(dynamic, 8)
  for (int y = 0; y < camera.height; ++y) {
    const auto row =
        photo * static_cast<std::uint64_t>(camera.height) + static_cast<std::uint64_t>(y);
    Random noise(options_.seed + kSensor, row);
    for (int x = 0; x < camera.width; ++x) {
      Eigen::Vector3d color = Eigen::Vector3d::Zero();
      for (int sample = 0; sample < 4; ++sample) {
        const auto ray = camera.ray({x + 0.25 + 0.5 * (sample % 2), y + 0.25 + 0.5 * (sample / 2)});
        color += 0.25 * colorAlong(center, *ray);
      }
      for (int c = 0; c < 3; ++c) {
        image.at(x, y)[c] = toLevel(gain * color[c] + options_.pixel_noise * noise.normal());
      }
    }
  }
  return image;
}

RgbImage PhotoScene::orthoImage(std::size_t facade, double texel_size) const {
  constexpr int kSamples = 3;  // in each direction
  const FacadeFrame& frame = frames_[facade];
  RgbImage image(std::max(1, static_cast<int>(std::ceil(frame.width / texel_size))),
                 std::max(1, static_cast<int>(std::ceil(frame.height / texel_size))));
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const Eigen::Vector2d corner(column * texel_size, frame.height - row * texel_size);
      const Eigen::Vector2d middle = corner + 0.5 * texel_size * Eigen::Vector2d(1.0, -1.0);
      if (!isInside(outlines_[facade], middle)) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const Eigen::Vector2d step(i % kSamples + 0.5, -(i / kSamples + 0.5));
        sum += paints_[facade].color(corner + texel_size / kSamples * step);
      }
      for (int c = 0; c < 3; ++c)
        image.at(column, row)[c] = toLevel(sum[c] / (kSamples * kSamples));
    }
  }
  return image;
}

}  // namespace storey::synth
