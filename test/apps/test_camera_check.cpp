// SPDX-License-Identifier: BSD-3-Clause
// A painted box photographed from all sides: mistakes put into its cameras must be named.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cameras/agreement.h"
#include "cameras/camera_json.h"

namespace storey::cameras {
namespace {

/// Brightness of a place on the surface: waves in all directions.
double paint(const Eigen::Vector3d& p) {
  return 128.0 + 60.0 * std::sin(5.0 * p.x() + 2.0 * p.z()) + 60.0 * std::cos(4.0 * p.y() - p.z());
}

constexpr double kHalf = 2.0;  // of the box's width

/// The point of the cube that a ray meets first.
bool meetCube(const Eigen::Vector3d& from, const Eigen::Vector3d& along, Eigen::Vector3d& at) {
  const Eigen::Array3d low = (-kHalf - from.array()) / along.array();
  const Eigen::Array3d high = (kHalf - from.array()) / along.array();
  const double enter = low.min(high).maxCoeff();
  if (!(enter > 0.0) || enter > low.max(high).minCoeff()) return false;
  at = from + enter * along;
  return true;
}

Camera cameraAt(double angle) {
  Camera camera;
  camera.width = 120;
  camera.height = 90;
  camera.focal = {100.0, 100.0};
  camera.principal = {64.0, 41.0};
  const Eigen::Vector3d center(8.0 * std::cos(angle), 8.0 * std::sin(angle), 3.0);
  const Eigen::Vector3d ahead = -center.normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  camera.world_to_camera.linear() = rotation;
  camera.world_to_camera.translation() = -rotation * center;
  return camera;
}

RgbImage photograph(const Camera& camera) {
  RgbImage image(camera.width, camera.height);
  Eigen::Vector3d at;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (!meetCube(camera.center(), *camera.ray({x + 0.5, y + 0.5}), at)) continue;
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(paint(at));
    }
  }
  return image;
}

class PaintedBox : public ::testing::Test {
 protected:
  PaintedBox() {
    constexpr int kSteps = 40;
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 2 * kSteps * kSteps; ++i) {
        Eigen::Vector3d p;
        p[axis] = i % 2 == 0 ? kHalf : -kHalf;
        p[(axis + 1) % 3] = kHalf * (2.0 * (i / 2 % kSteps) / (kSteps - 1.0) - 1.0);
        p[(axis + 2) % 3] = kHalf * (2.0 * (i / 2 / kSteps) / (kSteps - 1.0) - 1.0);
        cloud_.positions.push_back(p);
        cloud_.normals.push_back(Eigen::Vector3d::Unit(axis) * (i % 2 == 0 ? 1.0 : -1.0));
      }
    }
    for (int k = 0; k < 12; ++k) {
      cameras_.push_back(cameraAt(2.0 * M_PI * k / 12));
      images_.push_back(photograph(cameras_.back()));
    }
  }

  /// What the check says of cameras with a mistake put into all of them.
  Suspicion named(const std::function<void(Camera&)>& mistake) const {
    std::vector<Camera> wrong = cameras_;
    for (Camera& camera : wrong) mistake(camera);
    EXPECT_LT(meanCorrelation(measureAgreement(cloud_, wrong, images_)), 0.6);
    return suspectMistakes(cloud_, wrong, images_).front();
  }

  CloudPoints cloud_;
  std::vector<Camera> cameras_;
  std::vector<RgbImage> images_;
};

TEST_F(PaintedBox, OnlyPointsInFrontAreShown) {
  const Eigen::Vector3d center = cameras_[0].center();
  std::size_t facing = 0;
  for (const Eigen::Vector3d& normal : cloud_.normals)
    facing += normal.x() > 0.5 || normal.z() > 0.5;
  cloud_.normals.clear();  // told by depth alone
  const std::vector<std::size_t> shown = shownPoints(cloud_, cameras_[0]);
  std::size_t hidden = 0;
  for (const std::size_t i : shown) {
    const Eigen::Vector3d& p = cloud_.positions[i];
    Eigen::Vector3d met;
    ASSERT_TRUE(meetCube(center, (0.999 * p - center).normalized(), met));
    hidden += (met - p).norm() > 0.2;
  }
  EXPECT_GT(shown.size(), facing / 2);
  EXPECT_LT(hidden, shown.size() / 50);
}

TEST_F(PaintedBox, RightCamerasAgree) {
  for (const PhotoAgreement& photo : measureAgreement(cloud_, cameras_, images_)) {
    EXPECT_GT(photo.points, 1000u);
    EXPECT_GT(photo.correlation, 0.9);  // 3 x 3 pixels blur the waves
  }
}

TEST_F(PaintedBox, OneWrongCameraIsToldFromTheOthers) {
  cameras_[3] = cameraAt(2.0 * M_PI * 4 / 12);
  const auto agreement = measureAgreement(cloud_, cameras_, images_);
  for (std::size_t k = 0; k < agreement.size(); ++k) {
    EXPECT_EQ(agreement[k].correlation < 0.5, k == 3) << k;
  }
}

TEST_F(PaintedBox, MistakesAreNamed) {
  const auto expectNamed = [&](const std::function<void(Camera&)>& mistake, const char* words) {
    const Suspicion suspicion = named(mistake);
    EXPECT_GT(suspicion.correlation, 0.9);
    EXPECT_NE(suspicion.mistake.find(words), std::string::npos) << suspicion.mistake;
  };
  expectNamed(
      [](Camera& c) {
        c.focal.x() *= -1.0;
        c.principal.x() = c.width - c.principal.x();
      },
      "mirrored left to right");
  expectNamed([](Camera& c) { c.world_to_camera = c.world_to_camera.inverse(); },
              "camera to world");
  expectNamed([](Camera& c) { c.principal -= Eigen::Vector2d(60.0, 45.0); },
              "counted from the middle");
  expectNamed(
      [](Camera& c) {
        c.focal *= 2.0;
        c.principal *= 2.0;
      },
      "2.00 times as large");
  expectNamed([](Camera& c) { c.world_to_camera.translation() *= 1000.0; }, "another unit");
  expectNamed(
      [](Camera& c) {
        c.world_to_camera = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()) * c.world_to_camera;
      },
      "along -z");
}

// The numbers alone are enough to project a point.
TEST_F(PaintedBox, IsToldAsJson) {
  io::CameraSet set;
  set.format = "COLMAP text";
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    io::Photo photo;
    photo.name = "view\xff.png";  // no UTF-8
    photo.index = k;
    photo.camera = cameras_[k];
    set.photos.push_back(photo);
  }
  const auto bare = nlohmann::json::parse(toJson(set, std::nullopt));
  EXPECT_FALSE(bare.contains("agreement"));
  ASSERT_EQ(bare["photos"].size(), cameras_.size());
  const Eigen::Vector4d point(0.3, -0.2, kHalf, 1.0);
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const auto& photo = bare["photos"][k];
    EXPECT_EQ(photo["photo"], k);
    Eigen::Vector3d seen;
    for (std::size_t row = 0; row < 3; ++row) {
      const auto numbers = photo["world_to_camera"][row].get<std::vector<double>>();
      seen[static_cast<Eigen::Index>(row)] = Eigen::Vector4d(numbers.data()).dot(point);
    }
    const double x = photo["focal_length"][0].get<double>() * seen.x() / seen.z() +
                     photo["principal_point"][0].get<double>();
    EXPECT_NEAR(x, cameras_[k].project(point.head<3>())->x(), 1e-9);
  }
  const CameraCheck check = {measureAgreement(cloud_, cameras_, images_), 0.7, {"reason", 0.9}};
  const auto checked = nlohmann::json::parse(toJson(set, check));
  EXPECT_EQ(checked["agreement"], 0.7);
  EXPECT_EQ(checked["suspected_mistake"]["mistake"], "reason");
  EXPECT_EQ(checked["photos"][1]["agreement"], check.agreement[1].correlation);
}

}  // namespace
}  // namespace storey::cameras
