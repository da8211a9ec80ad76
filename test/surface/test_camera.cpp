// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/camera.h>

#include <cmath>
#include <random>
#include <vector>

namespace storey {
namespace {

constexpr double kTolerance = 1e-10;

Camera exampleCamera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.focal = {500.0, 520.0};
  camera.principal = {322.0, 241.0};
  camera.world_to_camera.linear() =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).matrix();
  camera.world_to_camera.translation() = Eigen::Vector3d(3.0, -1.0, 8.0);
  return camera;
}

std::vector<Lens> allLenses() {
  return {Lens(),
          Lens::perspective({-0.3, 0.0, 0.0}),
          Lens::perspective({0.2, -0.05, 0.0}),
          Lens::perspective({-0.28, 0.07, 0.0}, {}, {1e-3, -2e-3}),
          Lens::perspective({0.4, -0.1, 0.02}, {0.3, 0.05, 0.01}, {5e-4, 1e-3}),
          Lens::fisheye({-0.01, 0.02, -0.005, 0.001}),
          Lens::fisheye({0.05, 0.0, 0.0, 0.0}),
          Lens::fisheye({0.03, -0.02, 0.004, 0.0}, {1e-3, 2e-3}, {1e-3, -5e-4}),
          Lens::fieldOfView(0.9)};
}

TEST(Camera, PinholeByItsDefinition) {
  Camera camera = exampleCamera();
  camera.skew = 3.0;
  Eigen::Matrix3d k;
  k << 500.0, 3.0, 322.0, 0.0, 520.0, 241.0, 0.0, 0.0, 1.0;
  const Eigen::Vector3d point(0.3, 0.4, 1.5);
  const Eigen::Vector3d homogeneous = k * (camera.world_to_camera * point);
  ASSERT_TRUE(camera.project(point));
  EXPECT_TRUE(camera.project(point)->isApprox(homogeneous.hnormalized(), kTolerance));
  EXPECT_NEAR((camera.world_to_camera * camera.center()).norm(), 0.0, kTolerance);
  EXPECT_FALSE(camera.project(2.0 * camera.center() - point));  // behind
}

// The formulas as the manuals of OpenCV and COLMAP write them, one term after the other.
TEST(Lens, ModelsByTheirDefinition) {
  const double x = 0.3;
  const double y = -0.2;
  const double r2 = x * x + y * y;
  const auto rational = Lens::perspective({0.4, -0.1, 0.02}, {0.3, 0.05, 0.01}, {5e-4, 1e-3});
  const double g = (1 + 0.4 * r2 - 0.1 * r2 * r2 + 0.02 * r2 * r2 * r2) /
                   (1 + 0.3 * r2 + 0.05 * r2 * r2 + 0.01 * r2 * r2 * r2);
  const Eigen::Vector2d expected(x * g + 2 * 5e-4 * x * y + 1e-3 * (r2 + 2 * x * x),
                                 y * g + 5e-4 * (r2 + 2 * y * y) + 2 * 1e-3 * x * y);
  EXPECT_TRUE(rational.distort({2 * x, 2 * y, 2.0})->isApprox(expected, kTolerance));

  const double r = std::sqrt(r2);
  const double theta = std::atan(r);
  const auto fisheye = Lens::fisheye({0.03, -0.02, 0.004, 0.001}, {1e-3, 2e-3}, {3e-3, -5e-4});
  const double u = theta / r * x;
  const double v = theta / r * y;
  const double t2 = theta * theta;
  const double h =
      1 + 0.03 * t2 - 0.02 * t2 * t2 + 0.004 * t2 * t2 * t2 + 0.001 * t2 * t2 * t2 * t2;
  const Eigen::Vector2d prism(u * h + 2 * 1e-3 * u * v + 2e-3 * (t2 + 2 * u * u) + 3e-3 * t2,
                              v * h + 2 * 2e-3 * u * v + 1e-3 * (t2 + 2 * v * v) - 5e-4 * t2);
  EXPECT_TRUE(fisheye.distort({x, y, 1.0})->isApprox(prism, kTolerance));

  const double bent = std::atan(2 * r * std::tan(0.45)) / 0.9;
  EXPECT_NEAR(Lens::fieldOfView(0.9).distort({x, y, 1.0})->norm(), bent, kTolerance);
  EXPECT_NEAR(Lens::fieldOfView(1e-5).distort({x, y, 1.0})->norm(), r, 1e-9);
}

TEST(Lens, UndistortInvertsDistort) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-0.8, 0.8);
  for (const Lens& lens : allLenses()) {
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d ray = Eigen::Vector3d(across(random), across(random), 1.0).normalized();
      const auto image = lens.distort(ray);
      if (!image) continue;
      const auto back = lens.undistort(*image);
      ASSERT_TRUE(back);
      EXPECT_NEAR((*back - ray).norm(), 0.0, kTolerance);
    }
    EXPECT_NEAR((*lens.undistort({0.0, 0.0}) - Eigen::Vector3d::UnitZ()).norm(), 0.0, kTolerance);
  }
}

// With k1 = -0.3, r (1 - 0.3 r^2) is largest, 0.7027, at r = 1 / sqrt(0.9).
TEST(Lens, NothingIsFoldedBackIntoThePicture) {
  const Lens barrel = Lens::perspective({-0.3, 0.0, 0.0});
  EXPECT_TRUE(barrel.distort({1.04, 0.0, 1.0}));
  EXPECT_FALSE(barrel.distort({1.06, 0.0, 1.0}));
  EXPECT_FALSE(barrel.distort({1.8, 0.0, 1.0}));  // would be shown at 0.05
  EXPECT_TRUE(barrel.undistort({0.70, 0.0}));
  EXPECT_FALSE(barrel.undistort({0.71, 0.0}));
  EXPECT_FALSE(Lens::fieldOfView(0.9).undistort({M_PI_2 / 0.9 + 0.01, 0.0}));
}

TEST(Lens, FisheyesLookBehindThemselves) {
  const Lens fisheye = Lens::fisheye({});
  const double angle = 2.0;  // more than a right angle
  const auto image = fisheye.distort({std::sin(angle), 0.0, std::cos(angle)});
  ASSERT_TRUE(image);
  EXPECT_NEAR(image->x(), angle, kTolerance);
  EXPECT_NEAR(fisheye.undistort(*image)->z(), std::cos(angle), kTolerance);
}

TEST(Camera, BackProjectionInvertsProjection) {
  for (const Lens& lens : allLenses()) {
    Camera camera = exampleCamera();
    camera.lens = lens;
    const Eigen::Vector3d point =
        camera.world_to_camera.inverse() * Eigen::Vector3d(0.7, -0.5, 3.0);
    const double distance = (point - camera.center()).norm();
    const auto pixel = camera.project(point);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*camera.backProject(*pixel, distance) - point).norm(), 0.0, kTolerance);
  }
}

}  // namespace
}  // namespace storey
