// SPDX-License-Identifier: BSD-3-Clause
// The checker that other tests rely on finds what is wrong with a solid, and nothing else.
#include <gtest/gtest.h>

#include "export/delaunay_flips.h"
#include "export/iso_solid.h"

namespace storey::test {
namespace {

using Errors = std::set<IsoError>;

constexpr double kPlanarity = 1.0;

/// Appends the eight corners of a box of size `s` and gives its shell.
IntegerSolid::Shell addBox(IntegerSolid& solid, std::int64_t x, std::int64_t y, std::int64_t z,
                           std::int64_t s) {
  const int o = static_cast<int>(solid.vertices.size());
  for (int i = 0; i < 8; ++i) {
    solid.vertices.push_back({x + (i & 1) * s, y + ((i >> 1) & 1) * s, z + ((i >> 2) & 1) * s});
  }
  IntegerSolid::Shell shell;
  for (const std::vector<int>& ring : std::vector<std::vector<int>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    shell.push_back({{}});
    for (const int i : ring) shell.back()[0].push_back(o + i);
  }
  return shell;
}

IntegerSolid box() {
  IntegerSolid solid;
  solid.shells = {addBox(solid, 0, 0, 0, 100)};
  return solid;
}

IntegerSolid::Shell insideOut(IntegerSolid::Shell shell) {
  for (IntegerSolid::Polygon& polygon : shell) {
    for (std::vector<int>& ring : polygon) std::reverse(ring.begin(), ring.end());
  }
  return shell;
}

TEST(IsoSolid, ABoxIsValid) {
  EXPECT_EQ(checkSolid(box(), kPlanarity), Errors{});
  EXPECT_DOUBLE_EQ(volumeOf(box()), 1e6);
}

TEST(IsoSolid, ABoxWithACavityIsValid) {
  IntegerSolid solid = box();
  solid.shells.push_back(insideOut(addBox(solid, 40, 40, 40, 20)));
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{});
  EXPECT_DOUBLE_EQ(volumeOf(solid), 1e6 - 8000.0);
}

TEST(IsoSolid, SliversGiveWayToFans) {
  // A square whose lower side bulges by one unit in its middle: no triangle needs to lie along it.
  const std::vector<detail::GridPoint> points = {
      {0, 0}, {1000, -1}, {2000, 0}, {2000, 2000}, {0, 2000}};
  std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  flipToDelaunay(triangles, points);
  ASSERT_EQ(triangles.size(), 3u);
  std::int64_t twice_area = 0;
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
    EXPECT_GT(orient(at(a), at(b), at(c)), 1000 * 1000);
    twice_area += orient(at(a), at(b), at(c));
  }
  EXPECT_EQ(twice_area, 2 * 2000 * 2000 + 2000);
}

TEST(IsoSolid, FindsBadRings) {
  IntegerSolid solid = box();
  solid.shells[0][0][0] = {0, 2, 2, 3, 1};
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::RepeatedPoint});
  solid.shells[0][0][0] = {0, 2};
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::TooFewPoints});
  solid.shells[0][0][0] = {0, 3, 2, 1};  // a bow tie, here of no area
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::NotAPolygon});
}

TEST(IsoSolid, FindsPolygonsThatAreNotPlanar) {
  IntegerSolid solid = box();
  solid.vertices[7] = {100, 100, 101};
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{});
  solid.vertices[7] = {100, 100, 110};
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::NotPlanar});
}

TEST(IsoSolid, FindsOpenShells) {
  IntegerSolid solid = box();
  solid.shells[0].pop_back();
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::NotClosed});
}

TEST(IsoSolid, FindsFlippedPolygons) {
  IntegerSolid solid = box();
  std::reverse(solid.shells[0][0][0].begin(), solid.shells[0][0][0].end());
  EXPECT_EQ(checkSolid(solid, kPlanarity).count(IsoError::Orientation), 1u);
}

TEST(IsoSolid, FindsShellsInsideOut) {
  IntegerSolid solid = box();
  solid.shells[0] = insideOut(solid.shells[0]);
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::WrongSense});
}

TEST(IsoSolid, FindsShellsOfSeveralComponents) {
  IntegerSolid solid = box();
  const IntegerSolid::Shell other = addBox(solid, 300, 0, 0, 100);
  solid.shells[0].insert(solid.shells[0].end(), other.begin(), other.end());
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::SeveralComponents});
}

TEST(IsoSolid, FindsEdgesAndVerticesThatPartsTouchIn) {
  for (const std::int64_t z : {0, 100}) {  // an edge, then a vertex in common
    IntegerSolid solid = box();
    IntegerSolid::Shell other = addBox(solid, 100, 100, z, 100);
    for (IntegerSolid::Polygon& polygon : other) {
      for (int& i : polygon[0]) {  // with the vertices of the first box where they are the same
        for (int first = 0; first < 8; ++first) {
          if (solid.vertices[static_cast<std::size_t>(first)] ==
              solid.vertices[static_cast<std::size_t>(i)]) {
            i = first;
          }
        }
      }
    }
    solid.shells[0].insert(solid.shells[0].end(), other.begin(), other.end());
    EXPECT_EQ(checkSolid(solid, kPlanarity).count(IsoError::NonManifold), 1u) << z;
  }
}

TEST(IsoSolid, FindsSelfIntersections) {
  IntegerSolid solid = box();
  // The right side pulled through the left one: planar, closed, but crossed.
  for (const std::size_t i : {1u, 5u}) solid.vertices[i][0] = -50;
  EXPECT_EQ(checkSolid(solid, kPlanarity).count(IsoError::SelfIntersection) +
                checkSolid(solid, kPlanarity).count(IsoError::NotAPolygon),
            1u);
}

TEST(IsoSolid, FindsCavitiesThatAreNotInside) {
  IntegerSolid solid = box();
  solid.shells.push_back(insideOut(addBox(solid, 240, 40, 40, 20)));
  EXPECT_EQ(checkSolid(solid, kPlanarity), Errors{IsoError::InnerOutside});
  solid = box();
  solid.shells.push_back(insideOut(addBox(solid, 90, 40, 40, 20)));
  EXPECT_EQ(checkSolid(solid, kPlanarity).count(IsoError::ShellsMeet), 1u);
}

}  // namespace
}  // namespace storey::test
