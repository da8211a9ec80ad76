// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::test {

using Corners = std::vector<Eigen::Vector2d>;

/// One layer with one ring, whose edges have their numbers as wall ids.
inline std::vector<FloorplanLayer> layerOf(const Corners& corners) {
  FloorplanLayer layer;
  layer.z_max = 3.0;
  layer.plan.components.resize(1);
  FloorplanRing& ring = layer.plan.components.front().outer;
  ring.vertices = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) ring.edges.push_back({static_cast<int>(i)});
  return {layer};
}

inline const FloorplanRing& ringOf(const std::vector<FloorplanLayer>& layers) {
  return layers.front().plan.components.front().outer;
}

/// The lines of the edges, each moved outwards.
inline std::map<int, WallFit> fitsOf(const Corners& corners, const std::vector<double>& shifts) {
  std::map<int, WallFit> fits;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - corners[i];
    WallFit& fit = fits[static_cast<int>(i)];
    fit.normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    fit.offset = fit.normal.dot(corners[i]) + shifts[i];
  }
  return fits;
}

inline std::vector<int> idsOf(const FloorplanRing& ring) {
  std::vector<int> ids;
  for (const FloorplanEdge& edge : ring.edges) ids.push_back(edge.wall);
  return ids;
}

inline void expectCorners(const FloorplanRing& ring, const Corners& expected) {
  ASSERT_EQ(ring.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((ring.vertices[i] - expected[i]).norm(), 1e-12) << i;
  }
}

}  // namespace storey::test
