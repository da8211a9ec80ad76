// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/planar_patches.h>
#include <storey/segmentation/detail/wall_support.h>

#include <cmath>
#include <vector>

#include "faces.h"

namespace storey::detail {
namespace {

const WallScale kScale{0.05, 100.0};
const double kCell = 2.0 * supportCellSize(kScale);

PlanarPatches patchesOf(const std::vector<OrientedPoint>& points) {
  return findPlanarPatches(points, std::vector<char>(points.size(), 1), kScale);
}

TEST(PlanarPatches, AFaceIsOnePatchHoweverItIsTurned) {
  for (const double turn : {0.0, 0.3, 0.8}) {
    std::vector<OrientedPoint> points;
    const Eigen::Vector3d a(4.0 * std::cos(turn), 4.0 * std::sin(turn), 0.0);
    addFace(points, {1, 2, 3}, a, {0, 0, 4});
    const PlanarPatches patches = patchesOf(points);
    ASSERT_EQ(patches.area.size(), 1u);
    for (const std::size_t patch : patches.of) EXPECT_EQ(patch, 0u);
    EXPECT_GT(patches.area[0], 0.7 * 16.0);  // cells that it cuts near a corner may hold too few
    EXPECT_LT(patches.area[0], (4.0 + 2.0 * kCell) * (4.0 + 2.0 * kCell));
  }
}

TEST(PlanarPatches, FacesThatMeetAreTwo) {
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {4, 0, 0}, {0, 0, 4});
  const std::size_t first = points.size();
  addFace(points, {4, 0, 0}, {0, 4, 0}, {0, 0, 4});
  const PlanarPatches patches = patchesOf(points);
  ASSERT_EQ(patches.area.size(), 2u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(patches.of[i] == patches.of[0], i < first) << i;
  }
}

TEST(PlanarPatches, HaveAShareOfThePointsAtTheirPlace) {
  // Over half of it as many points off the plane as on it, in the same cells.
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {8, 0, 0}, {0, 0, 8});
  const std::size_t on_plane = points.size();
  for (std::size_t i = 0; i < on_plane; ++i) {
    OrientedPoint off = points[i];
    if (off.position.x() < 4.0f) continue;
    off.position.y() += 0.2f * static_cast<float>(kCell);
    off.normal = Eigen::Vector3f(0.8f, 0.6f, 0.0f);  // 53 degrees from that of the plane
    points.push_back(off);
  }
  const PlanarPatches patches = patchesOf(points);
  const std::size_t face = patches.of[0];
  ASSERT_NE(face, PlanarPatches::kNone);
  EXPECT_NEAR(patches.share[face], 2.0 / 3.0, 1e-12);
}

TEST(PlanarPatches, WhatDoesNotCountIsOfNone) {
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {4, 0, 0}, {0, 0, 4});
  std::vector<char> counts(points.size(), 1);
  counts[5] = 0;
  const PlanarPatches patches = findPlanarPatches(points, counts, kScale);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(patches.of[i] == PlanarPatches::kNone, i == 5) << i;
  }
}

TEST(PlanarPatches, AreTheSameForAnyNumberOfThreads) {
  std::vector<OrientedPoint> points;
  for (int wall = 0; wall < 6; ++wall) {  // several chunks, and rows of cells
    addFace(points, {0, 3.0 * wall, 0}, {12, 0.4 * wall, 0}, {0, 0, 9});
  }
  const std::vector<char> counts(points.size(), 1);
  const PlanarPatches expected = findPlanarPatches(points, counts, kScale, 1);
  for (const unsigned int threads : {2u, 3u}) {
    const PlanarPatches patches = findPlanarPatches(points, counts, kScale, threads);
    EXPECT_EQ(patches.of, expected.of);
    EXPECT_EQ(patches.area, expected.area);
    EXPECT_EQ(patches.share, expected.share);
  }
}

}  // namespace
}  // namespace storey::detail
