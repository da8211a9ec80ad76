// SPDX-License-Identifier: BSD-3-Clause
// Normals where the place of the sensor is known.
#include <gtest/gtest.h>

#include "stages/attitude.h"

namespace storey::test {
namespace {

using stages::Attitude;
using stages::AttitudeOptions;
using stages::StageCloud;

/// A part of a wall in the plane normal.x = offset, 6 wide and high, without normals.
void addWall(const Eigen::Vector3f& normal, float offset, StageCloud& cloud) {
  const Eigen::Vector3f along = Eigen::Vector3f::UnitZ().cross(normal);
  for (int i = 0; i <= 60; ++i) {
    for (int k = 0; k <= 60; ++k) {
      stages::Point p;
      p.getVector3fMap() = offset * normal + 0.1f * (static_cast<float>(i) - 30.0f) * along +
                           0.1f * static_cast<float>(k) * Eigen::Vector3f::UnitZ();
      cloud.points->push_back(p);
    }
  }
}

/// A street between two buildings: walls at x = 5 and x = -5 whose fronts face each other, and a
/// third across its end. Far away in the input.
StageCloud street() {
  StageCloud cloud;
  cloud.points = pcl::make_shared<stages::Cloud>();
  cloud.state.frame_to_input.translation() = Eigen::Vector3d(4e5, 5e6, 100.0);
  addWall(Eigen::Vector3f::UnitX(), 5.0f, cloud);
  addWall(Eigen::Vector3f::UnitX(), -5.0f, cloud);
  addWall(Eigen::Vector3f::UnitY(), 12.0f, cloud);
  return cloud;
}

void expectNormalsFacing(const StageCloud& cloud, const Eigen::Vector3f& place) {
  for (const stages::Point& p : *cloud.points) {
    ASSERT_GT(p.getNormalVector3fMap().dot(place - p.getVector3fMap()), 0.0f) << p;
  }
}

TEST(Sensor, EstimatedNormalsFaceIt) {
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(1, 2, 1.5), Eigen::Vector3d(20, -30, 2)}) {
    StageCloud cloud = street();
    AttitudeOptions options;
    options.sensor = cloud.state.frame_to_input * place;
    Attitude found;
    estimateMissingNormals(cloud, options, 1, found);
    EXPECT_GT(found.normals_k, 0);
    expectNormalsFacing(cloud, place.cast<float>());
  }
}

TEST(Sensor, GivenNormalsAreTurnedAsWell) {
  StageCloud cloud = street();
  AttitudeOptions options;
  Attitude found;
  estimateMissingNormals(cloud, options, 1, found);
  for (std::size_t i = 0; i < cloud.points->size(); i += 3) {
    (*cloud.points)[i].getNormalVector3fMap() *= -1.0f;
  }
  options.sensor = cloud.state.frame_to_input * Eigen::Vector3d(0.0, 0.0, 1.5);
  Attitude again;
  estimateMissingNormals(cloud, options, 1, again);
  EXPECT_EQ(again.normals_k, 0);
  expectNormalsFacing(cloud, Eigen::Vector3f(0.0f, 0.0f, 1.5f));
}

TEST(Sensor, WhatItStandsInIsASpace) {
  StageCloud cloud = street();
  addWall(Eigen::Vector3f::UnitY(), -12.0f, cloud);
  AttitudeOptions options;
  options.sensor = cloud.state.frame_to_input * Eigen::Vector3d(0.0, 1.0, 1.5);
  Attitude found;
  estimateMissingNormals(cloud, options, 1, found);
  setUpright(cloud, options, 1, found);
  orientOutwards(cloud, options, 1, found);
  EXPECT_TRUE(cloud.state.inside);
  for (const stages::Point& p : *cloud.points) {  // out of the space, whose walls they are
    ASSERT_GT(p.getNormalVector3fMap().dot(p.getVector3fMap()), 0.0f) << p;
  }
}

}  // namespace
}  // namespace storey::test
