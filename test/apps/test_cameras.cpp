// SPDX-License-Identifier: BSD-3-Clause
// Cameras in every format that is read: what the file says must be what is projected.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "io/cameras/camera_set.h"
#include "io/cameras/camera_writer.h"
#include "io/failure.h"
#include "temporary_files.h"

namespace storey {
namespace {

using io::CameraSet;
using test::TemporaryDirectory;

const Eigen::Quaterniond kTurn =
    Eigen::Quaterniond(Eigen::AngleAxisd(0.6, Eigen::Vector3d(0.2, 1.0, -0.3).normalized()));
const Eigen::Vector3d kShift(0.5, -0.25, 4.0);
const Eigen::Vector3d kPoint(0.4, 0.3, 1.0);

Eigen::Vector3d inCamera() { return kTurn * kPoint + kShift; }

/// A PNG of one row, of which nothing but the header is ever read.
std::string pngHeader(unsigned width, unsigned height) {
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  for (const unsigned side : {width, height}) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(side >> shift & 255);
  }
  return bytes;
}

std::string poseText() {
  std::ostringstream text;
  text.precision(17);
  text << kTurn.w() << " " << kTurn.x() << " " << kTurn.y() << " " << kTurn.z() << " " << kShift.x()
       << " " << kShift.y() << " " << kShift.z();
  return text.str();
}

TEST(CameraReaders, ColmapText) {
  const TemporaryDirectory directory;
  directory.write("cameras.txt",
                  "# comment\n7 PINHOLE 640 480 500 510 320.5 239\n"
                  "8 FULL_OPENCV 64 48 50 51 32 24 .1 .02 .001 .002 .03 .1 .01 .001\n");
  directory.write("images.txt", "# comment\n3 " + poseText() + " 7 a photo.jpg\n1 2 -1 3 4 9\n4 " +
                                    poseText() + " 8 folder/b.jpg\n\n");
  directory.write("points3D.txt", "1 1.5 2.5 3.5 0 0 0 0.1 3 0\n");
  const CameraSet set = io::readCameras(directory.path());
  EXPECT_EQ(set.format, "COLMAP text");
  ASSERT_EQ(set.photos.size(), 2u);
  EXPECT_EQ(set.photos[0].name, "a photo.jpg");
  EXPECT_EQ(set.photos[1].name, "folder/b.jpg");
  ASSERT_EQ(set.points.size(), 1u);
  EXPECT_EQ(set.points[0], Eigen::Vector3d(1.5, 2.5, 3.5));
  EXPECT_EQ(set.photos[1].camera.width, 64);
  const Eigen::Vector2d q = inCamera().hnormalized();
  EXPECT_NEAR(set.photos[0].camera.project(kPoint)->x(), 500 * q.x() + 320.5, 1e-9);
  EXPECT_NEAR(set.photos[0].camera.project(kPoint)->y(), 510 * q.y() + 239, 1e-9);
  const double s = q.squaredNorm();
  const double g =
      (1 + .1 * s + .02 * s * s + .03 * s * s * s) / (1 + .1 * s + .01 * s * s + .001 * s * s * s);
  const double x = q.x() * g + 2 * .001 * q.x() * q.y() + .002 * (s + 2 * q.x() * q.x());
  EXPECT_NEAR(set.photos[1].camera.project(kPoint)->x(), 50 * x + 32, 1e-9);
}

// Where the number of each parameter goes, told by the image of one point.
TEST(CameraReaders, EveryColmapModel) {
  const Eigen::Vector2d q = inCamera().hnormalized();
  const double r = q.norm();
  const double t = std::atan(r);
  const auto radial = [&](double s, double a, double b) { return 1 + a * s + b * s * s; };
  const double s = r * r;
  struct Case {
    std::string parameters;
    double x;  // on the image plane of focal length 1
  };
  const double u = q.x() * t / r;
  const double v = q.y() * t / r;
  const std::vector<Case> cases = {
      {"SIMPLE_PINHOLE 640 480 100 0 0", q.x()},
      {"PINHOLE 640 480 100 1 0 0", q.x()},
      {"SIMPLE_RADIAL 640 480 100 0 0 .1", q.x() * radial(s, .1, 0)},
      {"RADIAL 640 480 100 0 0 .1 .02", q.x() * radial(s, .1, .02)},
      {"OPENCV 640 480 100 1 0 0 .1 .02 .003 .004",
       q.x() * radial(s, .1, .02) + .006 * q.x() * q.y() + .004 * (s + 2 * q.x() * q.x())},
      {"OPENCV_FISHEYE 640 480 100 1 0 0 .1 .02 .003 .004",
       u * (1 + .1 * t * t + .02 * std::pow(t, 4) + .003 * std::pow(t, 6) + .004 * std::pow(t, 8))},
      {"FOV 640 480 100 1 0 0 .8", q.x() * std::atan(2 * r * std::tan(.4)) / (r * .8)},
      {"SIMPLE_RADIAL_FISHEYE 640 480 100 0 0 .1", u * radial(t * t, .1, 0)},
      {"RADIAL_FISHEYE 640 480 100 0 0 .1 .02", u * radial(t * t, .1, .02)},
      {"THIN_PRISM_FISHEYE 640 480 100 1 0 0 .1 .02 .003 .004 .005 .006 .007 .008",
       u * (1 + .1 * t * t + .02 * std::pow(t, 4) + .005 * std::pow(t, 6) + .006 * std::pow(t, 8)) +
           .006 * u * v + .004 * (t * t + 2 * u * u) + .007 * t * t}};
  for (const Case& one : cases) {
    const TemporaryDirectory directory;
    directory.write("cameras.txt", "1 " + one.parameters + "\n");
    directory.write("images.txt", "1 " + poseText() + " 1 a.jpg\n");
    const CameraSet set = io::readCameras(directory.path());
    EXPECT_NEAR(set.photos[0].camera.project(kPoint)->x(), 100 * one.x, 1e-9) << one.parameters;
  }
}

template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

TEST(CameraReaders, ColmapBinary) {
  const TemporaryDirectory directory;
  std::string cameras;
  append<std::uint64_t>(cameras, 1);
  append<std::uint32_t>(cameras, 9);
  append<std::int32_t>(cameras, 2);  // SIMPLE_RADIAL
  append<std::uint64_t>(cameras, 640);
  append<std::uint64_t>(cameras, 480);
  for (const double p : {500.0, 320.0, 240.0, -0.05}) append(cameras, p);
  std::string images;
  append<std::uint64_t>(images, 1);
  append<std::uint32_t>(images, 4);
  for (const double p : {kTurn.w(), kTurn.x(), kTurn.y(), kTurn.z()}) append(images, p);
  for (int i = 0; i < 3; ++i) append(images, kShift[i]);
  append<std::uint32_t>(images, 9);
  images += std::string("a.jpg\0", 6);
  append<std::uint64_t>(images, 1);
  images += std::string(24, '\x11');
  std::string points;
  append<std::uint64_t>(points, 1);
  append<std::uint64_t>(points, 5);
  for (const double p : {1.0, 2.0, 3.0}) append(points, p);
  points += std::string(3 + 8, '\0');
  append<std::uint64_t>(points, 2);
  points += std::string(16, '\0');
  const std::string folder = directory.path() + "/sparse/0";
  std::filesystem::create_directories(folder);
  directory.write("sparse/0/cameras.bin", cameras);
  directory.write("sparse/0/images.bin", images);
  directory.write("sparse/0/points3D.bin", points);
  const CameraSet set = io::readCameras(directory.path());
  EXPECT_EQ(set.format, "COLMAP binary");
  ASSERT_EQ(set.photos.size(), 1u);
  EXPECT_EQ(set.photos[0].name, "a.jpg");
  EXPECT_EQ(set.points.at(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  const Eigen::Vector2d q = inCamera().hnormalized();
  const Eigen::Vector2d expected =
      500 * (1 - 0.05 * q.squaredNorm()) * q + Eigen::Vector2d(320.0, 240.0);
  EXPECT_TRUE(set.photos[0].camera.project(kPoint)->isApprox(expected, 1e-12));
}

// By the formula of Bundler's manual: p = -P / P.z, p' = f r(p) p from the middle, y up.
TEST(CameraReaders, Bundler) {
  const TemporaryDirectory directory;
  const Eigen::Matrix3d rotation = Eigen::Vector3d(1, -1, -1).asDiagonal() * kTurn.matrix();
  const Eigen::Vector3d shift = Eigen::Vector3d(1, -1, -1).cwiseProduct(kShift);
  std::ostringstream text;
  text.precision(17);
  text << "# Bundle file v0.3\n2 1\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n500 -0.05 0.01\n"
       << rotation << "\n"
       << shift.transpose() << "\n1 2 3\n9 9 9\n1 1 0 3.5 4.5\n";
  directory.write("bundle.out", text.str());
  directory.write("list.txt", "./first.png\n./second.png 0 700\n");
  directory.write("second.png", pngHeader(640, 480));
  CameraSet set = io::readCameras(directory.file("bundle.out"));
  ASSERT_EQ(set.photos.size(), 1u);  // the first was not registered
  EXPECT_EQ(set.photos[0].index, 1u);
  EXPECT_EQ(set.points.at(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  io::findImages(directory.path(), set);
  const Eigen::Vector3d p3 = rotation * kPoint + shift;
  const Eigen::Vector2d p = -p3.head<2>() / p3.z();
  const double s = p.squaredNorm();
  const Eigen::Vector2d from_middle = 500 * (1 - 0.05 * s + 0.01 * s * s) * p;
  const auto pixel = set.photos[0].camera.project(kPoint);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 320 + from_middle.x(), 1e-9);
  EXPECT_NEAR(pixel->y(), 240 - from_middle.y(), 1e-9);
}

// A projection matrix means the same at any scale and sign. PMVS's pixel centres are integers.
TEST(CameraReaders, Pmvs) {
  const TemporaryDirectory directory;
  Eigen::Matrix3d k;
  k << 500, 2, 320, 0, 510, 240, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> pose;
  pose << kTurn.matrix(), kShift;
  const Eigen::Matrix<double, 3, 4> projection = k * pose;
  for (const double scale : {1.0, -3.0}) {
    std::ostringstream text;
    text.precision(17);
    text << "CONTOUR\n" << scale * projection << "\n";
    directory.write(scale > 0 ? "00000000.txt" : "00000001.txt", text.str());
  }
  directory.write("a.png", pngHeader(640, 480));
  directory.write("b.png", pngHeader(640, 480));
  CameraSet set = io::readCameras(directory.path());
  io::findImages(directory.path(), set);
  ASSERT_EQ(set.photos.size(), 2u);
  EXPECT_EQ(set.photos[1].image, directory.file("b.png"));
  const Eigen::Vector2d expected = (k * inCamera()).hnormalized() + Eigen::Vector2d::Constant(0.5);
  for (const io::Photo& photo : set.photos) {
    ASSERT_TRUE(photo.camera.project(kPoint));
    EXPECT_TRUE(photo.camera.project(kPoint)->isApprox(expected, 1e-9));
  }
}

TEST(CameraReaders, WhatIsWrittenIsRead) {
  const TemporaryDirectory directory;
  io::Photo photo;
  photo.name = "a.png";
  photo.camera.width = 640;
  photo.camera.height = 480;
  photo.camera.focal.setConstant(500.0);
  photo.camera.principal = {320.0, 240.0};
  photo.camera.world_to_camera = Eigen::Translation3d(kShift) * kTurn;
  CameraSet written;
  written.photos = {photo};
  written.points = {{1.0, 2.0, 3.0}};
  directory.write("a.png", pngHeader(640, 480));
  for (const bool bundler : {false, true}) {
    const std::string folder = directory.file(bundler ? "bundler" : "colmap");
    std::filesystem::create_directory(folder);
    bundler ? io::writeBundler(folder, written) : io::writeColmapText(folder, written);
    CameraSet read = io::readCameras(folder);
    io::findImages(directory.path(), read);
    EXPECT_EQ(read.points, written.points);
    EXPECT_EQ(read.photos.at(0).name, "a.png");
    EXPECT_TRUE(read.photos[0].camera.project(kPoint)->isApprox(*photo.camera.project(kPoint)));
  }
}

TEST(CameraReaders, ImagesMustBeThereAndOfTheSize) {
  const TemporaryDirectory directory;
  directory.write("cameras.txt", "1 PINHOLE 640 480 500 510 320 240\n");
  directory.write("images.txt", "1 " + poseText() + " 1 a.png\n\n");
  CameraSet set = io::readCameras(directory.path());
  try {
    io::findImages(directory.path(), set);
    FAIL() << "no image is there";
  } catch (const io::Failure& failure) {
    EXPECT_EQ(failure.status(), io::MissingInput);
  }
  directory.write("a.png", pngHeader(480, 640));
  EXPECT_THROW(io::findImages(directory.path(), set), io::Failure);
  directory.write("a.png", pngHeader(640, 480));
  EXPECT_NO_THROW(io::findImages(directory.path(), set));
}

}  // namespace
}  // namespace storey
