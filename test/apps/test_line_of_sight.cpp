// SPDX-License-Identifier: BSD-3-Clause
// Clouds of other programs: normals turned to the photos that saw their points, and coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "io/cameras/camera_writer.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "loaded_points.h"
#include "malformed_files.h"
#include "temporary_files.h"

namespace storey::io {
namespace {

using test::TemporaryDirectory;

/// Points of a sphere about `middle`, their normals outwards but for every third one, and cameras
/// in a circle around it. A point is seen by the cameras before its tangential plane.
struct Scene {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> outwards;
  std::vector<Eigen::Vector3d> normals;
  std::vector<std::vector<std::uint32_t>> viewers;
  CameraSet cameras;
  std::size_t num_wrong = 0;
};

Camera cameraAt(const Eigen::Vector3d& center) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.focal = {500.0, 500.0};
  camera.principal = {320.0, 240.0};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.3 * center.x(), Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  pose.translation() = center;
  camera.world_to_camera = pose.inverse();
  return camera;
}

Scene makeScene() {
  constexpr int kCameras = 12;
  constexpr double kTurn = 2.0 * M_PI / kCameras;
  const Eigen::Vector3d middle(3.0, -2.0, 1.0);
  Scene scene;
  for (int c = 0; c < kCameras; ++c) {
    Photo photo;
    photo.index = static_cast<std::size_t>(c);
    photo.name = "photo" + std::to_string(c) + ".jpg";
    photo.camera =
        cameraAt(middle + 5.0 * Eigen::Vector3d(std::cos(c * kTurn), std::sin(c * kTurn), 0.1));
    scene.cameras.photos.push_back(photo);
  }
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  while (scene.points.size() < 300) {
    const Eigen::Vector3d n =
        Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
    std::vector<std::uint32_t> viewers;
    for (std::uint32_t c = 0; c < kCameras; ++c) {
      const Eigen::Vector3d to_camera = scene.cameras.photos[c].camera.center() - middle - n;
      if (n.dot(to_camera) > 0.1) viewers.push_back(c);
    }
    if (viewers.empty()) continue;  // near the poles
    const bool wrong = scene.points.size() % 3 == 0;
    scene.num_wrong += wrong ? 1 : 0;
    scene.points.push_back(middle + n);
    scene.outwards.push_back(n);
    scene.normals.push_back(wrong ? Eigen::Vector3d(-n) : n);
    scene.viewers.push_back(viewers);
  }
  return scene;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string triple(const Eigen::Vector3d& v) {
  return number(v.x()) + " " + number(v.y()) + " " + number(v.z());
}

std::string plyOf(const Scene& scene) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(scene.points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
                     "property float ny\nproperty float nz\nend_header\n";
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    text += triple(scene.points[i]) + " " + triple(scene.normals[i]) + "\n";
  }
  return text;
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string visibilityOf(const Scene& scene) {
  std::string bytes;
  append(bytes, static_cast<std::uint64_t>(scene.points.size()));
  for (const std::vector<std::uint32_t>& viewers : scene.viewers) {
    append(bytes, static_cast<std::uint32_t>(viewers.size()));
    for (const std::uint32_t viewer : viewers) append(bytes, viewer);
  }
  return bytes;
}

void expectOutwards(const Scene& scene, const LoadedCloud& loaded) {
  ASSERT_EQ(loaded.cloud->size(), scene.points.size());
  EXPECT_TRUE(loaded.has_normals);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d normal =
        test::pointAt(loaded, scene.points[i]).getNormalVector3fMap().cast<double>();
    EXPECT_GT(normal.dot(scene.outwards[i]), 0.999) << i;
  }
}

int statusOf(const std::string& path) {
  try {
    readCloud(path);
  } catch (const Failure& failure) {
    return failure.status();
  }
  return 0;
}

TEST(LineOfSight, TurnsTheNormalsOfColmap) {
  const Scene scene = makeScene();
  const TemporaryDirectory directory;
  const std::string cloud = directory.write("fused.ply", plyOf(scene));
  EXPECT_EQ(readCloud(cloud).turned_normals, 0U);  // nothing is known of photos
  directory.write("fused.ply.vis", visibilityOf(scene));
  EXPECT_EQ(readCloud(cloud).turned_normals, 0U);  // nor of cameras
  std::filesystem::create_directory(directory.file("sparse"));
  writeColmapText(directory.file("sparse"), scene.cameras);
  const LoadedCloud loaded = readCloud(cloud);
  EXPECT_EQ(loaded.turned_normals, scene.num_wrong);
  expectOutwards(scene, loaded);
}

TEST(LineOfSight, FilesThatDoNotBelongTogetherAreRefused) {
  const Scene scene = makeScene();
  const TemporaryDirectory directory;
  const std::string cloud = directory.write("fused.ply", plyOf(scene));
  writeColmapText(directory.path(), scene.cameras);
  const std::string good = visibilityOf(scene);
  const auto status = [&](const std::string& bytes) {
    directory.write("fused.ply.vis", bytes);
    return statusOf(cloud);
  };
  EXPECT_EQ(status(good), 0);
  for (std::size_t length = 1; length < good.size(); length += 7) {
    EXPECT_EQ(status(good.substr(0, length)), BadInput) << length;
  }
  EXPECT_EQ(status(good + "more"), BadInput);
  EXPECT_EQ(status("\x01" + good.substr(1)), BadInput);  // of another number of points
  std::string beyond = good;
  beyond[12] = '\x7f';  // the first photo of the first point
  EXPECT_EQ(status(beyond), BadInput);
  std::string many = good;
  many.replace(8, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(status(many), BadInput);
}

TEST(LineOfSight, TurnsTheNormalsOfPmvs) {
  const Scene scene = makeScene();
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("models"));
  std::string text = "PATCHES\n" + std::to_string(scene.points.size()) + "\n";
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    text += "PATCHS\n" + triple(scene.points[i]) + " 1\n" + triple(scene.normals[i]) +
            " 0\n0.9 0 0\n" + std::to_string(scene.viewers[i].size()) + "\n";
    for (const std::uint32_t viewer : scene.viewers[i]) text += std::to_string(viewer) + " ";
    text += "\n0\n\n\n";
  }
  const std::string cloud = directory.write("models/option.patch", text);
  EXPECT_EQ(readCloud(cloud).turned_normals, 0U);
  std::filesystem::create_directory(directory.file("txt"));
  for (const Photo& photo : scene.cameras.photos) {
    Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
    k.diagonal().head<2>() = photo.camera.focal;
    k.col(2).head<2>() = photo.camera.principal;
    const Eigen::Matrix<double, 3, 4> projection =
        k * photo.camera.world_to_camera.matrix().topRows<3>();
    std::string matrix = "CONTOUR\n";
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) matrix += number(projection(row, column)) + " ";
      matrix += "\n";
    }
    char name[32];
    std::snprintf(name, sizeof name, "txt/%08zu.txt", photo.index);
    directory.write(name, matrix);
  }
  const LoadedCloud loaded = readCloud(cloud);
  EXPECT_EQ(loaded.turned_normals, scene.num_wrong);
  expectOutwards(scene, loaded);
}

TEST(Imports, LasKeepsMillimetresFarFromTheOrigin) {
  std::string las = test::lasFile(3, 2, 0);
  const double easting = 512345.678;
  std::memcpy(&las[155], &easting, sizeof easting);
  const TemporaryDirectory directory;
  const LoadedCloud loaded = readCloud(directory.write("a.las", las));
  ASSERT_EQ(loaded.cloud->size(), 3U);
  EXPECT_FALSE(loaded.has_normals);
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d point = test::samplePoint(i);
    point.x() += 2.0 + easting;
    EXPECT_NEAR(test::pointAt(loaded, point).x + loaded.offset.x(), point.x(), 1e-5);
  }
}

TEST(Imports, TextHasNormalsWhereThreeColumnsAreUnitVectors) {
  const TemporaryDirectory directory;
  const auto normalOf = [&](const std::string& name, const std::string& text) {
    const LoadedCloud loaded = readCloud(directory.write(name, text));
    EXPECT_EQ(loaded.cloud->size(), 3U) << name;
    if (!loaded.has_normals) return Eigen::Vector3f(Eigen::Vector3f::Zero());
    return Eigen::Vector3f(test::pointAt(loaded, {1, 0, 0}).getNormalVector3fMap());
  };
  const Eigen::Vector3f n(0.6f, 0.0f, 0.8f);
  EXPECT_TRUE(normalOf("a.xyz", "0 0 0 1 0 0\n1 0 0 .6 0 .8\n0 1 0 0 0 1\n").isApprox(n));
  EXPECT_TRUE(normalOf("b.txt", "0,0,0,9,8,7,1,0,0\n1,0,0,9,8,7,0.6,0,0.8\n0,1,0,9,8,7,0,0,1\n")
                  .isApprox(n));
  EXPECT_TRUE(normalOf("c.csv", "x;y;z;nx;ny;nz;c\n0;0;0;1;0;0;5\n1;0;0;.6;0;.8;5\n0;1;0;0;0;1;5\n")
                  .isApprox(n));
  EXPECT_TRUE(normalOf("colours.xyz", "0 0 0 255 0 0\n1 0 0 12 80 90\n0 1 0 3 0 1\n").isZero());
  EXPECT_TRUE(normalOf("dark.xyz", "0 0 0 1 0 0\n1 0 0 12 80 90\n0 1 0 3 0 1\n").isZero());
}

}  // namespace
}  // namespace storey::io
