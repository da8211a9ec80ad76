// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "../segmentation/wall_clouds.h"

/// The cloud and the slices of an L under a tower, and what must hold of the mesh made from them.
namespace storey::test {

inline const Corners kL = {{0, 0}, {16, 0}, {16, 6}, {7, 6}, {7, 12}, {0, 12}};
inline const Corners kTower = box(0, 0, 7, 12);
constexpr double kNoise = 0.05;
constexpr double kVolume = (16.0 * 6.0 + 7.0 * 6.0) * 4.0 + 7.0 * 12.0 * 4.0;

// A level face over the points of a lattice that lie inside the plan.
template <typename PointT>
void addCap(const Floorplan& plan, double z, double up, pcl::PointCloud<PointT>& cloud) {
  for (double x = -30.05; x < 30.0; x += 0.2) {
    for (double y = -30.05; y < 30.0; y += 0.2) {
      if (contains(plan, {x, y})) addPoint({x, y, z}, {0.0, 0.0, up}, cloud);
    }
  }
}

inline Floorplan planOf(const Corners& outer, double yaw) {
  Floorplan plan;
  plan.components.push_back({ringOf(moved(outer, yaw, {1, 2})), {}});
  return plan;
}

// An L of height 4 under a tower up to 8, walls and roofs.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr building(double yaw = 0.0) {
  WallCloudOptions options;
  options.density = 25.0;
  options.noise = kNoise;
  options.z_max = 4.0;
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  addWalls(moved(kL, yaw, {1, 2}), options, *cloud);
  options.z_min = 4.0;
  options.z_max = 8.0;
  addWalls(moved(kTower, yaw, {1, 2}), options, *cloud);
  addCap(planOf(box(7, 0, 16, 6), yaw), 4.0, 1.0, *cloud);
  addCap(planOf(kTower, yaw), 8.0, 1.0, *cloud);
  cloud->header.frame_id = "building";
  cloud->header.stamp = 12345;
  cloud->header.seq = 7;
  return cloud;
}

// One floorplan a slice of thickness 0.5, with the scatter that lines of slices have.
inline std::vector<FloorplanLayer> slices(double yaw = 0.0) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<FloorplanLayer> result;
  for (int i = 0; i < 16; ++i) {
    FloorplanLayer layer{0.5 * i, 0.5 * (i + 1), planOf(i < 8 ? kL : kTower, yaw)};
    for (Eigen::Vector2d& v : layer.plan.components[0].outer.vertices) {
      v += Eigen::Vector2d(noise(random), noise(random));
    }
    result.push_back(layer);
  }
  result[5].plan = {};  // one slice gave none
  return result;
}

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<pcl::Vertices> polygons;

  explicit Mesh(const pcl::PolygonMesh& mesh) : polygons(mesh.polygons) {
    pcl::PointCloud<pcl::PointXYZ> cloud;
    pcl::fromPCLPointCloud2(mesh.cloud, cloud);
    for (const pcl::PointXYZ& p : cloud) vertices.emplace_back(p.x, p.y, p.z);
  }
};

// Every edge is run once in each sense, all indices are vertices.
inline void expectClosed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    const std::size_t n = polygon.vertices.size();
    EXPECT_EQ(n, 3U);
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(polygon.vertices[i]);
      const auto b = static_cast<std::uint32_t>(polygon.vertices[(i + 1) % n]);
      ASSERT_LT(a, mesh.vertices.size());
      ++edges[{a, b}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
}

inline double volumeOf(const Mesh& mesh) {
  double sum = 0.0;
  for (const pcl::Vertices& p : mesh.polygons) {
    const auto at = [&](std::size_t i) {
      return mesh.vertices[static_cast<std::size_t>(p.vertices[i])];
    };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum;
}

inline bool sameMesh(const pcl::PolygonMesh& a, const pcl::PolygonMesh& b) {
  return a.cloud.data == b.cloud.data &&
         std::equal(a.polygons.begin(), a.polygons.end(), b.polygons.begin(), b.polygons.end(),
                    [](const pcl::Vertices& x, const pcl::Vertices& y) {
                      return x.vertices == y.vertices;
                    });
}

}  // namespace storey::test
