// SPDX-License-Identifier: BSD-3-Clause
// What passes between the stages, through files and back.
#include <gtest/gtest.h>
#include <storey/segmentation/detail/point_classes.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "io/failure.h"
#include "stages/floorplan_file.h"
#include "stages/stage_cloud_io.h"
#include "temporary_files.h"

namespace storey::stages {
namespace {

using test::readAll;
using test::TemporaryDirectory;

/// A cloud in which everything is there, its numbers such that few of their bits are zero.
StageCloud makeCloud() {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> number(-100.0, 100.0);
  StageCloud cloud;
  cloud.has_normals = true;
  cloud.state.frame_to_input.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  cloud.state.frame_to_input.translation() = Eigen::Vector3d(512345.678901, 5.0 / 3.0, -1e-7);
  cloud.state.crs = "local grid, 1 : 1000";
  cloud.state.inside = true;
  cloud.state.noise = 1.0 / 30.0;
  cloud.state.density = 1e6 / 7.0;
  cloud.state.planar_threshold = 0.3f;
  for (int i = 0; i < 3; ++i) {
    cloud.state.directions.push_back({std::cos(1.0 + i), std::sin(1.0 + i), 0.0});
  }
  for (int i = 0; i < 1200; ++i) cloud.state.slices.emplace_back(i / 3.0, (i + 1) / 3.0);
  for (int i = 0; i < 200; ++i) {
    Point p;
    for (float* const value :
         {&p.x, &p.y, &p.z, &p.normal_x, &p.normal_y, &p.normal_z, &p.curvature}) {
      *value = static_cast<float>(number(generator));
    }
    if (i % 10 == 0) p.normal_x = std::numeric_limits<float>::quiet_NaN();  // no normal found
    cloud.points->push_back(p);
    cloud.confidences.push_back(static_cast<float>(i) / 199.0f);
    cloud.groups(Class).push_back(i % (detail::kNumPointClasses + 1) - 1);
    cloud.groups(Slice).push_back(i - 1);
    cloud.groups(Direction).push_back(i % 4 - 1);
    cloud.groups(Region).push_back(i / 2 - 1);
    cloud.groups(Wall).push_back(i % 7 - 1);
  }
  cloud.points->push_back((*cloud.points)[5]);  // copies of a point stay
  cloud.confidences.push_back(0.0f);
  for (std::vector<int>& groups : cloud.groups_of) groups.push_back(-1);
  return cloud;
}

bool sameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(StageFiles, CloudsComeBackBitByBit) {
  const TemporaryDirectory directory;
  const StageCloud cloud = makeCloud();
  for (const char* const name : {"a.pcd", "a.ply"}) {
    const std::string path = directory.file(name);
    writeStageCloud(path, cloud);
    const StageCloud back = readStageCloud(path);
    EXPECT_EQ(back.state.frame_to_input.matrix(), cloud.state.frame_to_input.matrix());
    EXPECT_EQ(back.state.crs, cloud.state.crs);
    EXPECT_EQ(back.state.inside, cloud.state.inside);
    EXPECT_EQ(back.state.noise, cloud.state.noise);
    EXPECT_EQ(back.state.density, cloud.state.density);
    EXPECT_EQ(back.state.planar_threshold, cloud.state.planar_threshold);
    EXPECT_EQ(back.state.directions, cloud.state.directions);
    EXPECT_EQ(back.state.slices, cloud.state.slices);
    EXPECT_EQ(back.confidences, cloud.confidences);
    EXPECT_EQ(back.groups_of, cloud.groups_of);
    EXPECT_TRUE(back.has_normals);
    ASSERT_EQ(back.points->size(), cloud.points->size());
    for (std::size_t i = 0; i < cloud.points->size(); ++i) {
      const Point& p = (*cloud.points)[i];
      const Point& q = (*back.points)[i];
      EXPECT_TRUE(sameBits(p.x, q.x) && sameBits(p.y, q.y) && sameBits(p.z, q.z)) << i;
      EXPECT_TRUE(sameBits(p.normal_x, q.normal_x) && sameBits(p.normal_y, q.normal_y)) << i;
      EXPECT_TRUE(sameBits(p.normal_z, q.normal_z) && sameBits(p.curvature, q.curvature)) << i;
    }
    writeStageCloud(directory.file("again" + std::string(name)), back);
    EXPECT_EQ(readAll(directory.file("again" + std::string(name))), readAll(path));
  }
}

TEST(StageFiles, GroupsThatDoNotExistAreRefused) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.pcd");
  for (const Group group : {Class, Slice, Direction}) {
    StageCloud cloud = makeCloud();
    const int one_too_many = group == Class ? detail::kNumPointClasses : group == Slice ? 1200 : 3;
    cloud.groups(group)[3] = one_too_many;
    writeStageCloud(path, cloud);
    try {
      readStageCloud(path);
      FAIL() << kGroupNames[group];
    } catch (const io::Failure& failure) {
      EXPECT_EQ(failure.status(), io::BadInput);
      EXPECT_NE(std::string(failure.what()).find(kGroupNames[group]), std::string::npos);
    }
  }
}

StageFloorplans makeFloorplans() {
  StageFloorplans floorplans;
  floorplans.method = Method::Paper;
  floorplans.state = makeCloud().state;
  const auto ring = [](double size, int wall) {
    FloorplanRing r;
    r.vertices = {{0.1, 1.0 / 3.0}, {size, 1.0 / 3.0}, {size, size}, {0.1, size / 7.0}};
    for (int i = 0; i < 4; ++i) r.edges.push_back({wall + i, i % 2 == 0});
    return r;
  };
  FloorplanComponent component;
  component.outer = ring(10.0, 0);
  component.holes = {ring(3.0, -1), ring(2.0, 5)};
  floorplans.layers = {{0.1, 0.7, {{component, component}}}, {0.7, 1.9, {}}};
  return floorplans;
}

TEST(StageFiles, FloorplansComeBackBitByBit) {
  const TemporaryDirectory directory;
  const StageFloorplans floorplans = makeFloorplans();
  writeFloorplans(directory.file("a.geojson"), floorplans);
  const StageFloorplans back = readFloorplans(directory.file("a.geojson"));
  EXPECT_EQ(back.method, floorplans.method);
  EXPECT_EQ(back.state.frame_to_input.matrix(), floorplans.state.frame_to_input.matrix());
  EXPECT_EQ(back.state.noise, floorplans.state.noise);
  ASSERT_EQ(back.layers.size(), 2U);
  EXPECT_TRUE(back.layers[1].plan.empty());
  EXPECT_EQ(back.layers[0].z_max, 0.7);
  ASSERT_EQ(back.layers[0].plan.components.size(), 2U);
  const FloorplanComponent& before = floorplans.layers[0].plan.components[0];
  const FloorplanComponent& after = back.layers[0].plan.components[1];
  EXPECT_EQ(after.outer.vertices, before.outer.vertices);
  ASSERT_EQ(after.holes.size(), 2U);
  EXPECT_EQ(after.holes[1].vertices, before.holes[1].vertices);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(after.holes[1].edges[i].wall, before.holes[1].edges[i].wall);
    EXPECT_EQ(after.holes[1].edges[i].hypothetical, before.holes[1].edges[i].hypothetical);
  }
}

// Cut anywhere, or with any byte changed, floorplans are refused or read, and what is read is fit
// for a model: finite, at least three corners a ring, ascending.
TEST(StageFiles, FloorplansCutAndChanged) {
  const TemporaryDirectory directory;
  writeFloorplans(directory.file("a.geojson"), makeFloorplans());
  const std::string good = readAll(directory.file("a.geojson"));
  const test::MemoryFile file;
  int num_refused = 0;
  const auto check = [&](const std::string& content) {
    try {
      double last = -std::numeric_limits<double>::infinity();
      for (const FloorplanLayer& layer : readFloorplans(file.write(content)).layers) {
        EXPECT_LT(layer.z_min, layer.z_max);
        EXPECT_LE(last, layer.z_min);
        last = layer.z_min;
        for (const FloorplanComponent& component : layer.plan.components) {
          EXPECT_GE(component.outer.size(), 3U);
          EXPECT_EQ(component.outer.edges.size(), component.outer.size());
        }
      }
    } catch (const io::Failure& failure) {
      EXPECT_EQ(failure.status(), io::BadInput) << failure.what();
      ++num_refused;
    }
  };
  for (std::size_t at = 1; at < good.size(); at += 3) {
    check(good.substr(0, at));
    for (const char changed : {'\0', '9', '-', '[', '}', '"', 'e'}) {
      std::string content = good;
      content[at] = changed;
      check(content);
    }
  }
  check("[[[[[[[[");
  check(std::string(100000, '['));
  check("{\"type\": \"FeatureCollection\", \"features\": []}");
  EXPECT_GT(num_refused, 1000);
}

}  // namespace
}  // namespace storey::stages
