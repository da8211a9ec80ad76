// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "io/images/image_files.h"
#include "synth/buildings.h"
#include "synth/photos/photo_files.h"
#include "temporary_files.h"

namespace storey::synth {
namespace {

PhotoOptions plainOptions() {
  PhotoOptions options;
  options.views = 6;
  options.width = 320;
  options.occluders = 0;
  options.exposure = 0.0;
  options.pixel_noise = 0.0;
  return options;
}

PolyhedralModel modelOf(const char* name) { return extrudeFloorplans(makeBuilding(name).layers); }

/// Median difference between photos and what is expected of points all over the walls that the
/// camera sees: `expected(facade, place, direction of sight)`.
template <typename Expected>
double medianDifference(const PhotoScene& scene, const Expected& expected) {
  std::mt19937 random(3);
  std::vector<double> differences;
  const std::vector<Camera> cameras = scene.placeCameras();
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const RgbImage photo = scene.photograph(cameras[k], static_cast<int>(k));
    const Eigen::Vector3d center = cameras[k].center();
    for (std::size_t f = 0; f < scene.facades().size(); ++f) {
      const FacadeFrame& frame = scene.frames()[f];
      std::uniform_real_distribution<double> x(0.0, frame.width);
      std::uniform_real_distribution<double> y(0.0, frame.height);
      for (int i = 0; i < 50; ++i) {
        const Eigen::Vector2d place(x(random), y(random));
        const Eigen::Vector3d point = frame.point(place.x(), place.y());
        const auto pixel = cameras[k].project(point);
        if (!((center - point).dot(frame.normal()) > 0.0) || !pixel) continue;
        if (!cameras[k].contains(*pixel)) continue;
        const std::uint8_t* const seen =
            photo.at(static_cast<int>(pixel->x()), static_cast<int>(pixel->y()));
        const Eigen::Vector3d color = expected(f, place, (point - center).normalized());
        for (int c = 0; c < 3; ++c) differences.push_back(std::abs(seen[c] - color[c]));
      }
    }
  }
  EXPECT_GT(differences.size(), 1000u);
  std::nth_element(differences.begin(),
                   differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                   differences.end());
  return differences[differences.size() / 2];
}

TEST(TriangleTree, FirstHitIsThatOfATestOfAllTriangles) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  TriangleMesh mesh;
  for (int t = 0; t < 60; ++t) {
    const Eigen::Vector3d at = 3.0 * draw();
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back(at + draw());
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleTree tree(mesh);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from = 3.0 * draw();
    const Eigen::Vector3d direction = draw();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::Matrix3d edges;  // from + s direction = a + u (b - a) + v (c - a)
      edges << direction, mesh.corner(t, 0) - mesh.corner(t, 1),
          mesh.corner(t, 0) - mesh.corner(t, 2);
      const Eigen::Vector3d suv = edges.inverse() * (mesh.corner(t, 0) - from);
      if (suv.minCoeff() >= 0.0 && suv.y() + suv.z() <= 1.0) nearest = std::min(nearest, suv.x());
    }
    const auto hit = tree.firstHit(from, direction);
    ASSERT_EQ(hit.has_value(), std::isfinite(nearest));
    if (!hit) continue;
    EXPECT_NEAR(hit->distance, nearest, 1e-9 * (1.0 + nearest));
    ++hits;
  }
  EXPECT_GT(hits, 300);
}

// Where stains are wider than a pixel, a pixel shows the paint of its place. A box hides nothing
// of itself that faces the camera.
TEST(SyntheticPhotos, ShowThePaint) {
  const PhotoScene scene(modelOf("box"), plainOptions());
  EXPECT_LT(medianDifference(scene, [&](std::size_t f, const Eigen::Vector2d& place,
                                        const auto&) { return scene.paints()[f].color(place); }),
            4.0);  // the courses, 5 grey levels, are finer than a pixel
}

// Through a window's opening one sees the pane where the line of sight meets it, or a reveal.
TEST(SyntheticPhotos, RecessedWindowsShowTheirPanesByParallax) {
  PhotoOptions options = plainOptions();
  options.recess = 0.5;
  const PhotoScene scene(modelOf("box"), options);
  const auto parallax = [&](std::size_t f, const Eigen::Vector2d& place,
                            const Eigen::Vector3d& sight) -> Eigen::Vector3d {
    const FacadePaint& paint = scene.paints()[f];
    if (paint.windowAt(place) == nullptr) return paint.color(place);
    const FacadeFrame& frame = scene.frames()[f];
    const double depth = -sight.dot(frame.normal());
    const Eigen::Vector2d pane =
        place + 0.5 / depth * Eigen::Vector2d(sight.dot(frame.right), sight.dot(frame.up));
    return paint.windowAt(pane) == paint.windowAt(place)
               ? paint.color(pane)
               : Eigen::Vector3d(0.7 * paint.wallColor(place));
  };
  EXPECT_LT(medianDifference(scene, parallax), 4.0);
}

TEST(SyntheticPhotos, TheTruthIsWhatThePaintIs) {
  const PhotoScene scene(modelOf("box"), plainOptions());
  const FacadeFrame& frame = scene.frames()[0];
  const double texel = 0.04;  // a sixth of a course of bricks
  const RgbImage image = scene.orthoImage(0, texel);
  int on_edges = 0;
  int compared = 0;
  for (int row = 3; row < image.height - 3; row += 7) {
    for (int column = 3; column < image.width - 3; column += 7) {
      const Eigen::Vector2d place((column + 0.5) * texel, frame.height - (row + 0.5) * texel);
      const double difference = image.at(column, row)[1] - scene.paints()[0].color(place)[1];
      ++compared;
      on_edges += std::abs(difference) > 4.0;  // of windows, frames and mullions
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(on_edges, compared / 20);
}

TEST(SyntheticPhotos, FilesFollowThePose) {
  const test::TemporaryDirectory directory;
  PhotoOptions options = plainOptions();
  options.views = 3;
  Pose pose;
  pose.yaw = 0.4;
  pose.tilt = 0.2;
  pose.scale = 2.0;
  pose.offset = {100.0, -50.0, 7.0};
  const PolyhedralModel model = modelOf("box");
  writePhotos(directory.path(), model, options, pose);
  io::CameraSet set = io::readCameras(directory.path());
  io::findImages(directory.file("images"), set);
  ASSERT_EQ(set.photos.size(), 3u);
  EXPECT_EQ(io::readImage(set.photos[1]).width, 320);
  const PhotoScene scene(model, options);
  const std::vector<Camera> own = scene.placeCameras();
  const Eigen::Vector3d point = model.vertices[2];
  for (std::size_t k = 0; k < own.size(); ++k) {
    EXPECT_TRUE(
        set.photos[k].camera.project(pose.apply(point))->isApprox(*own[k].project(point), 1e-6));
  }
  const auto truth = nlohmann::json::parse(test::readAll(directory.file("truth.json")));
  ASSERT_EQ(truth["facades"].size(), model.faces.size());
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const auto& facade = truth["facades"][f];
    EXPECT_EQ(facade["windows"].size(), scene.paints()[f].windows().size());
    EXPECT_DOUBLE_EQ(facade["width"], 2.0 * scene.frames()[f].width);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(facade["origin"][i], pose.apply(scene.frames()[f].origin)[i], 1e-9);
    }
  }
}

}  // namespace
}  // namespace storey::synth
