// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/stacked_walls.h>

#include "ring_fits.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kApart = 0.1;

// Two storeys, squares whose walls have the ids 0 to 3 and 4 to 7, and the lines of both.
struct Storeys {
  std::vector<FloorplanLayer> layers;
  std::map<int, WallFit> fits;

  Storeys(const Corners& lower, const Corners& upper) : layers(layerOf(lower)) {
    const std::vector<double> where_they_are(4, 0.0);
    fits = fitsOf(lower, where_they_are);
    FloorplanLayer top = layerOf(upper).front();
    top.z_min = layers.front().z_max;
    top.z_max = 2.0 * top.z_min;
    for (FloorplanEdge& edge : top.plan.components.front().outer.edges) edge.wall += 4;
    layers.push_back(top);
    for (const auto& [id, fit] : fitsOf(upper, where_they_are)) fits[id + 4] = fit;
    for (auto& [id, fit] : fits) fit.support = id < 4 ? 1000 : 100;
  }

  std::vector<int> upperIds() const { return idsOf(layers.back().plan.components.front().outer); }
};

Corners rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(UniteStackedWalls, LinesOfOneWallAreOneAndSetBackOnesStay) {
  Storeys s(rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.09, 0.11, 10.0, 9.0));
  EXPECT_TRUE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
  EXPECT_EQ(s.upperIds(), (std::vector<int>{4, 1, 6, 3}));
  EXPECT_EQ(idsOf(ringOf(s.layers)), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_FALSE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
}

TEST(UniteStackedWalls, WallsBesideEachOtherStay) {
  // The second one stands on the first one's line, further on.
  Storeys s(rectangle(0.0, 0.0, 10.0, 10.0), rectangle(11.0, 0.0, 20.0, 10.0));
  EXPECT_FALSE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
}

TEST(UniteStackedWalls, WallsThatFaceEachOtherStay) {
  // The upper one begins where the lower one ends: their walls there face opposite ways.
  Storeys s(rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 2.0, 20.0, 8.0));
  EXPECT_FALSE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
}

TEST(UniteStackedWalls, TheDirectionOfTheOneWithFewerPointsCountsLess) {
  // Its edge, 1 long, turns by 0.05; the other's line, followed by its own, would be 0.45 off.
  Storeys s(rectangle(0.0, 0.0, 10.0, 10.0), {{0.0, 0.0}, {1.0, 0.05}, {1.0, 3.0}, {0.3, 3.0}});
  EXPECT_TRUE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
  EXPECT_EQ(s.upperIds().front(), 0);
}

TEST(UniteStackedWalls, WallsThatNothingWasSeenOfStay) {
  Storeys s(rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.0, 0.0, 10.0, 10.0));
  for (int id = 4; id < 8; ++id) s.fits[id].support = 0;
  EXPECT_FALSE(detail::uniteStackedWalls(s.fits, kApart, s.layers));
}

}  // namespace
