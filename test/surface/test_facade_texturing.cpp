// SPDX-License-Identifier: BSD-3-Clause
// A wall painted with a formula, and photos of it computed from the formula.
#include <gtest/gtest.h>
#include <omp.h>
#include <pcl/io/obj_io.h>
#include <storey/surface/detail/exposure_levelling.h>
#include <storey/surface/detail/texture_fill.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/facade_texturing.h>
#include <storey/surface/mesh_export.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "stacks.h"

namespace storey {
namespace {

constexpr double kWidth = 6.0;
constexpr double kHeight = 4.0;

/// A wall in the plane y = 0 that looks to -y.
Facade wall() {
  return {{{{0, 0, 0}, {kWidth, 0, 0}, {kWidth, 0, kHeight}, {0, 0, kHeight}}}, {0, -1, 0}};
}

/// Grey level of the wall at (x, z): waves longer than any pixel here.
double paint(double x, double z) {
  return 120.0 + 30.0 * std::sin(2.0 * x) + 20.0 * std::cos(3.0 * z);
}

Camera cameraAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target) {
  Camera camera;
  camera.width = 200;
  camera.height = 150;
  camera.focal = {150.0, 150.0};
  camera.principal = {100.0, 75.0};
  const Eigen::Vector3d ahead = (target - center).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  camera.world_to_camera.linear() = rotation;
  camera.world_to_camera.translation() = -rotation * center;
  return camera;
}

/// Textures of facades from photos, all else by default.
std::vector<FacadeTexture> texturesOf(const std::vector<Facade>& facades,
                                      const std::vector<FacadePhoto>& photos,
                                      double texel_size = 0.0) {
  FacadeTexturing texturing;
  texturing.setFacades(facades);
  texturing.setPhotos(photos);
  texturing.setTexelSize(texel_size);
  std::vector<FacadeTexture> textures;
  EXPECT_TRUE(texturing.texture(textures));
  return textures;
}

using Shading = std::function<double(const Eigen::Vector3d& from, const Eigen::Vector3d& along)>;

/// Grey level along a ray: the wall's, times the exposure.
double shadeWall(const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  const Eigen::Vector3d at = from - from.y() / along.y() * along;
  const bool on_wall = at.x() >= 0.0 && at.x() <= kWidth && at.z() >= 0.0 && at.z() <= kHeight;
  return along.y() > 0.0 && on_wall ? paint(at.x(), at.z()) : 200.0;
}

FacadePhoto photograph(const Camera& camera, const Shading& shading, double exposure = 1.0) {
  FacadePhoto photo = {camera, RgbImage(camera.width, camera.height)};
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double level = shading(camera.center(), *camera.ray({x + 0.5, y + 0.5}));
      for (int c = 0; c < 3; ++c) {
        photo.image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(exposure * level));
      }
    }
  }
  return photo;
}

std::vector<Camera> fiveCameras() {
  std::vector<Camera> cameras;
  for (const double x : {0.0, 1.5, 3.0, 4.5, 6.0}) {
    cameras.push_back(cameraAt({x, -6.0, 2.0}, {kWidth / 2, 0.0, kHeight / 2}));
  }
  return cameras;
}

/// Largest difference of the seen texels from the paint, after the factor that fits best. At the
/// wall's edges a photo's pixels show the background too: two texels are left out.
double largestError(const FacadeTexture& texture) {
  double ab = 0.0;
  double aa = 0.0;
  double largest = 0.0;
  for (const bool measure : {false, true}) {
    for (std::size_t i = 0; i < texture.states.size(); ++i) {
      if (texture.states[i] != TexelState::Seen) continue;
      const int x = static_cast<int>(i) % texture.image.width;
      const int y = static_cast<int>(i) / texture.image.width;
      if (std::min(x, y) < 2 || x + 3 > texture.image.width || y + 3 > texture.image.height) {
        continue;
      }
      const double truth = paint((x + 0.5) * texture.texel, kHeight - (y + 0.5) * texture.texel);
      const double level = texture.image.at(x, y)[0];
      ab += measure ? 0.0 : level * truth;
      aa += measure ? 0.0 : level * level;
      if (measure) largest = std::max(largest, std::abs(ab / aa * level - truth));
    }
  }
  return largest;
}

TEST(FacadeFrame, IsSeenFromOutside) {
  const FacadeFrame frame = frameOf(wall());
  EXPECT_TRUE(frame.origin.isApprox(Eigen::Vector3d::Zero(), 1e-12) || frame.origin.norm() < 1e-12);
  EXPECT_TRUE(frame.right.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(frame.up.isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(frame.normal().isApprox(wall().normal));
  EXPECT_DOUBLE_EQ(frame.width, kWidth);
  EXPECT_DOUBLE_EQ(frame.height, kHeight);
}

// A camera straight in front, 6 away, with 150 pixels of focal length: 6 / 150 a pixel in the
// middle, a little more towards the ends.
TEST(FacadeTexturing, TexelsAreWhatThePhotosResolve) {
  const FacadePhoto photo = photograph(cameraAt({3.0, -6.0, 2.0}, {3.0, 0.0, 2.0}), shadeWall);
  const auto textures = texturesOf({wall()}, {photo});
  ASSERT_EQ(textures.size(), 1u);
  EXPECT_GT(textures[0].texel, 6.0 / 150.0);
  EXPECT_LT(textures[0].texel, 1.3 * 6.0 / 150.0);
  EXPECT_LT(largestError(textures[0]), 4.0);
}

TEST(FacadeTexturing, ExposuresAreLevelled) {
  const double exposures[] = {0.7, 1.0, 1.3, 0.9, 1.1};
  std::vector<FacadePhoto> photos;
  for (const Camera& camera : fiveCameras()) {
    photos.push_back(photograph(camera, shadeWall, exposures[photos.size()]));
  }
  const auto textures = texturesOf({wall()}, photos);
  EXPECT_EQ(textures[0].seenShare(), 1.0);
  EXPECT_LT(largestError(textures[0]), 6.0);  // 60 without levelling
}

// A pole stands 1 in front of the wall: each photo shows it elsewhere on the wall, the wall behind
// it is in four of the five photos.
TEST(FacadeTexturing, WhatStandsInFrontIsNotPaintedOn) {
  const Shading pole = [](const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
    const Eigen::Vector3d at = from + (-1.0 - from.y()) / along.y() * along;
    return std::abs(at.x() - 3.0) < 0.15 && at.z() < 3.0 ? 20.0 : shadeWall(from, along);
  };
  std::vector<FacadePhoto> photos;
  for (const Camera& camera : fiveCameras()) photos.push_back(photograph(camera, pole));
  const auto textures = texturesOf({wall()}, photos);
  EXPECT_LT(largestError(textures[0]), 15.0);  // the pole is more than 50 darker than the wall
}

// A wall in front, of which nothing is known but where it is, hides the lower half from a camera
// at its height, by similar triangles: what lies below z = 2.
TEST(FacadeTexturing, WhatOtherFacadesHideIsUnseen) {
  const Facade in_front = {{{{-20, -1, -5}, {20, -1, -5}, {20, -1, 2}, {-20, -1, 2}}}, {0, -1, 0}};
  const FacadePhoto photo = photograph(cameraAt({3.0, -6.0, 2.0}, {3.0, 0.0, 2.0}), shadeWall);
  const auto textures = texturesOf({wall(), in_front}, {photo}, 0.05);
  ASSERT_EQ(textures.size(), 2u);
  const FacadeTexture& t = textures[0];
  for (int y = 0; y < t.image.height; ++y) {
    const double z = kHeight - (y + 0.5) * t.texel;
    const auto middle = static_cast<std::size_t>(y * t.image.width + t.image.width / 2);
    EXPECT_EQ(t.states[middle], z > 2.0 ? TexelState::Seen : TexelState::Unseen) << z;
  }
}

TEST(FacadeTexturing, SameForAnyNumberOfThreads) {
  std::vector<FacadePhoto> photos;
  for (const Camera& camera : fiveCameras()) photos.push_back(photograph(camera, shadeWall, 1.2));
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = texturesOf({wall()}, photos);
  omp_set_num_threads(4);
  const auto four = texturesOf({wall()}, photos);
  omp_set_num_threads(before);
  EXPECT_EQ(one[0].image.channels, four[0].image.channels);
  EXPECT_EQ(one[0].photos, four[0].photos);
}

TEST(FacadeTexturing, RefusesWhatCannotBe) {
  FacadePhoto photo = photograph(fiveCameras()[0], shadeWall);
  FacadeTexturing texturing;
  std::vector<FacadeTexture> textures(1);
  EXPECT_FALSE(texturing.texture(textures));  // no model
  EXPECT_TRUE(textures.empty());
  texturing.setFacades({wall()});
  texturing.setTexelSize(-1.0);
  EXPECT_FALSE(texturing.texture(textures));
  texturing.setTexelSize(0.0);
  texturing.setMaxTexels(0.0);
  EXPECT_FALSE(texturing.texture(textures));
  texturing.setMaxTexels(1e6);
  texturing.setVertical({0.0, 0.0, 2.0});
  EXPECT_FALSE(texturing.texture(textures));
  texturing.setVertical(Eigen::Vector3d::UnitZ());
  photo.camera.width = 100;
  texturing.setPhotos({photo});
  EXPECT_FALSE(texturing.texture(textures));
  texturing.setPhotos({});
  EXPECT_TRUE(texturing.texture(textures));
  ASSERT_EQ(textures.size(), 1u);
  EXPECT_EQ(textures[0].seenShare(), 0.0);
}

TEST(IsEnclosed, PointsInAndOutOfABox) {
  const auto facades = facadesOf(
      extrudeFloorplans({test::layer(0, 3, {test::ring({{0, 0}, {4, 0}, {4, 5}, {0, 5}})})}));
  EXPECT_TRUE(isEnclosed(facades, {1.0, 2.0, 1.5}));
  EXPECT_FALSE(isEnclosed(facades, {1.0, 2.0, 3.5}));
  EXPECT_FALSE(isEnclosed(facades, {-1.0, 2.0, 1.5}));
}

/// Windows every 40 texels across and 30 upwards; a rectangle of the image is unseen.
FacadeTexture windows(bool repeat) {
  FacadeTexture t;
  t.texel = 0.1;
  t.image = RgbImage(200, 150);
  t.states.assign(200 * 150, TexelState::Seen);
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool window = repeat && x % 40 >= 10 && x % 40 < 28 && y % 30 >= 8 && y % 30 < 24;
      for (int c = 0; c < 3; ++c) t.image.at(x, y)[c] = window ? 40 : 150;
      if (x < 90 || x >= 130 || y < 60 || y >= 100) continue;
      t.states[static_cast<std::size_t>(y * 200 + x)] = TexelState::Unseen;
      for (int c = 0; c < 3; ++c) t.image.at(x, y)[c] = 0;
    }
  }
  return t;
}

TEST(TextureFill, FollowsTheRepetitionOfTheFacade) {
  FacadeTexture t = windows(true);
  const detail::Repetition period = detail::findRepetition(t);
  EXPECT_EQ(period.across, 40);
  EXPECT_EQ(period.upwards, 30);
  detail::fillUnseen(t);
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool window = x % 40 >= 10 && x % 40 < 28 && y % 30 >= 8 && y % 30 < 24;
      ASSERT_EQ(t.image.at(x, y)[1], window ? 40 : 150) << x << " " << y;
    }
  }
}

TEST(TextureFill, IsSmoothWhereNothingRepeats) {
  FacadeTexture t = windows(false);
  detail::fillUnseen(t);
  for (const std::uint8_t level : t.image.channels) ASSERT_EQ(level, 150);
}

// PCL's writer must not fail on it, and what it writes must say where each corner is in its image.
TEST(TextureMesh, IsWrittenByPcl) {
  const PolyhedralModel model =
      extrudeFloorplans({test::layer(0, 3, {test::ring({{0, 0}, {4, 0}, {4, 5}, {0, 5}})})});
  FacadeTexturing texturing;
  texturing.setModel(model);
  texturing.setTexelSize(0.25);
  std::vector<FacadeTexture> textures;
  ASSERT_TRUE(texturing.texture(textures));
  std::vector<std::string> images;
  for (std::size_t f = 0; f < model.faces.size(); ++f) images.push_back(std::to_string(f) + ".png");
  const pcl::TextureMesh mesh = toTextureMesh(model, textures, images);
  std::string folder = (std::filesystem::temp_directory_path() / "storey_test_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  ASSERT_EQ(pcl::io::saveOBJFile(folder + "/model.obj", mesh, 9), 0);

  std::ifstream file(folder + "/model.obj");
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector2d> coordinates;
  std::size_t face = 0;
  int num_corners = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    double x = 0.0, y = 0.0, z = 0.0;
    if (keyword == "v" && words >> x >> y >> z) vertices.emplace_back(x, y, z);
    if (keyword == "vt" && words >> x >> y) coordinates.emplace_back(x, y);
    if (keyword == "usemtl") {
      std::string name;
      words >> name;
      face = static_cast<std::size_t>(std::atoi(name.c_str() + 5));
    }
    if (keyword != "f") continue;
    for (std::string corner; words >> corner; ++num_corners) {
      const auto vertex = static_cast<std::size_t>(std::atoi(corner.c_str()) - 1);
      const auto at =
          static_cast<std::size_t>(std::atoi(corner.c_str() + corner.find('/') + 1) - 1);
      ASSERT_LT(at, coordinates.size());
      const Eigen::Vector2d expected = textures[face].coordinates(vertices.at(vertex));
      EXPECT_NEAR((coordinates[at] - expected).norm(), 0.0, 1e-6);
    }
  }
  EXPECT_EQ(num_corners, 12 * 3);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace storey
