// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <algorithm>

#include "bench/shown_truth.h"

namespace storey::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNoise = 0.05;
constexpr double kHeight = 3.0;
constexpr double kStep = 0.1;  // between the points of a wall, along it and up
constexpr double kDensity = 1.0 / (kStep * kStep);

// L-shaped; the last corner but one is reentrant.
const std::vector<Vector2d> kRing = {{0.0, 0.0}, {8.0, 0.0}, {8.0, 4.0},
                                     {3.0, 4.0}, {3.0, 6.0}, {0.0, 6.0}};

PolyhedralModel building() {
  FloorplanLayer layer;
  layer.z_max = kHeight;
  layer.plan.components.resize(1);
  layer.plan.components.front().outer.vertices = kRing;
  layer.plan.components.front().outer.edges.resize(kRing.size());
  return extrudeFloorplans({layer});
}

struct Points {
  std::vector<Vector3d> positions;
  std::vector<Vector3d> normals;
};

// A grid over one wall, or that far off it.
void addWall(std::size_t i, double off, Points& points) {
  const Vector2d a = kRing[i];
  const Vector2d b = kRing[(i + 1) % kRing.size()];
  const Vector2d t = (b - a).normalized();
  const Vector3d out(t.y(), -t.x(), 0.0);
  for (double s = 0.5 * kStep; s < (b - a).norm(); s += kStep) {
    for (double z = 0.5 * kStep; z < kHeight; z += kStep) {
      const Vector2d p = a + s * t;
      points.positions.push_back(Vector3d(p.x(), p.y(), z) + off * out);
      points.normals.push_back(out);
    }
  }
}

ShownTruth shownBy(const Points& points) {
  return findShownTruth(building(), points.positions, points.normals, kNoise, kDensity);
}

bool hasCorner(const ShownTruth& shown, const Vector2d& plan, double z) {
  return std::any_of(shown.corners.begin(), shown.corners.end(), [&](const Vector3d& c) {
    return (c - Vector3d(plan.x(), plan.y(), z)).norm() < 1e-6;
  });
}

TEST(ShownTruth, IsAllWhereAllWallsHavePoints) {
  Points points;
  for (std::size_t i = 0; i < kRing.size(); ++i) addWall(i, kNoise, points);
  const ShownTruth shown = shownBy(points);
  EXPECT_EQ(shown.hidden_walls, 0U);
  EXPECT_EQ(shown.corners.size(), 2 * kRing.size());
}

TEST(ShownTruth, EndsAtAWallWithoutPoints) {
  for (std::size_t hidden = 0; hidden < kRing.size(); ++hidden) {
    Points points;
    for (std::size_t i = 0; i < kRing.size(); ++i) {
      if (i != hidden) addWall(i, 0.0, points);
    }
    const ShownTruth shown = shownBy(points);
    EXPECT_EQ(shown.hidden_walls, 1U);
    EXPECT_EQ(shown.corners.size(), 2 * (kRing.size() - 2));
    for (std::size_t i = 0; i < kRing.size(); ++i) {
      const bool at_hidden = i == hidden || i == (hidden + 1) % kRing.size();
      EXPECT_EQ(hasCorner(shown, kRing[i], 0.0), !at_hidden);
      EXPECT_EQ(hasCorner(shown, kRing[i], kHeight), !at_hidden);
    }
  }
}

TEST(ShownTruth, TakesThreeInAHundredPoints) {
  for (const std::size_t thin : {10U, 60U}) {  // a tenth, a sixtieth of the points
    Points points;
    for (std::size_t i = 1; i < kRing.size(); ++i) addWall(i, 0.0, points);
    Points dense;
    addWall(0, 0.0, dense);
    for (std::size_t k = 0; k < dense.positions.size(); k += thin) {
      points.positions.push_back(dense.positions[k]);
      points.normals.push_back(dense.normals[k]);
    }
    EXPECT_EQ(shownBy(points).hidden_walls, thin > 33U ? 1U : 0U);
  }
}

TEST(ShownTruth, WantsPointsOnTheWallThatFaceItsWay) {
  Points points;
  for (std::size_t i = 1; i < kRing.size(); ++i) addWall(i, 0.0, points);
  Points off = points;
  addWall(0, 3.5 * kNoise, off);
  EXPECT_EQ(shownBy(off).hidden_walls, 1U);
  Points turned = points;
  addWall(0, 0.0, turned);
  for (std::size_t k = points.normals.size(); k < turned.normals.size(); ++k) {
    turned.normals[k] *= -1.0;
  }
  EXPECT_EQ(shownBy(turned).hidden_walls, 1U);
}

TEST(ShownTruth, IsNothingWithoutPoints) {
  const ShownTruth shown = shownBy({});
  EXPECT_EQ(shown.hidden_walls, kRing.size());
  EXPECT_TRUE(shown.corners.empty());
}

}  // namespace
}  // namespace storey::bench
