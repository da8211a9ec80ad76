// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/divided_walls.h>

#include <cmath>

#include "ring_fits.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kNoise = 0.1;
constexpr std::size_t kPoints = 4000;  // of each wall
constexpr std::size_t kLeft = 0;       // the edges beside the recess
constexpr std::size_t kRight = 4;

// A front with a recess in its middle; what is right of it stands a little back.
Corners front(double set_back) {
  return {{0.0, 0.0},       {8.0, 0.0},       {8.0, 5.0},   {12.0, 5.0},
          {12.0, set_back}, {20.0, set_back}, {20.0, 10.0}, {0.0, 10.0}};
}

struct Front {
  std::vector<FloorplanLayer> layers;  // both parts of the front are one wall
  FitPoints points;
  FitOptions options;
  detail::PointsByWall by_wall;
  std::map<int, WallFit> fits;

  Front(double set_back, unsigned int seed) : layers(layerOf(front(0.0))) {
    layers.front().plan.components.front().outer.edges[kRight].wall = kLeft;
    WallSampler sampler(kNoise, seed);
    const Corners truth = front(set_back);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      sampler.addWall(truth[i], truth[(i + 1) % truth.size()], 0.0, layers.front().z_max, kPoints,
                      points);
    }
    options.noise = kNoise;
    fit();
  }

  void fit() { fits = detail::fitWalls(layers, points, options, by_wall); }
  bool divide(unsigned int threads = 1) {
    return detail::divideWalls(by_wall, fits, kNoise, threads, layers);
  }
  int wallOf(std::size_t edge) const { return ringOf(layers).edges[edge].wall; }
};

TEST(DivideWalls, TwoWallsThatOneTurnedLinePassesGetLinesOfTheirOwn) {
  for (const double set_back : {-2.5 * kNoise, 2.5 * kNoise}) {
    Front front(set_back, 1);
    EXPECT_GT(std::abs(front.fits.at(kLeft).normal.x()), 0.5 * std::abs(set_back) / 12.0);
    ASSERT_TRUE(front.divide());
    EXPECT_NE(front.wallOf(kLeft), front.wallOf(kRight));
    front.fit();
    EXPECT_FALSE(front.divide());
    for (const std::size_t edge : {kLeft, kRight}) {
      const WallFit& fit = front.fits.at(front.wallOf(edge));
      const double y = edge == kLeft ? 0.0 : set_back;
      const double middle = edge == kLeft ? 4.0 : 16.0;
      // Of a mean, and of a slope over 8 with points all along.
      const double deviation = kNoise / std::sqrt(static_cast<double>(kPoints));
      EXPECT_NEAR(fit.normal.x() * middle + fit.normal.y() * y, fit.offset, 5.0 * deviation);
      EXPECT_NEAR(fit.normal.x(), 0.0, 5.0 * deviation * std::sqrt(12.0) / 8.0);
    }
  }
}

TEST(DivideWalls, TheOtherWallsKeepTheirIds) {
  Front front(2.5 * kNoise, 2);
  const std::vector<int> before = idsOf(ringOf(front.layers));
  ASSERT_TRUE(front.divide());
  const std::vector<int> after = idsOf(ringOf(front.layers));
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i == kLeft || i == kRight) continue;
    EXPECT_EQ(after[i], before[i]) << i;
  }
}

TEST(DivideWalls, OneWallBesideARecessStays) {
  for (unsigned int seed = 1; seed <= 30; ++seed) {
    Front front(0.0, seed);
    EXPECT_FALSE(front.divide()) << seed;
    EXPECT_EQ(front.wallOf(kLeft), front.wallOf(kRight)) << seed;
  }
}

TEST(DivideWalls, AWallWithoutABreakStaysWhateverItsPointsSay) {
  Front front(0.0, 3);
  for (auto& p : front.points.positions) {
    if (p.y() > 8.0F && p.x() > 10.0F) p.y() += static_cast<float>(2.5 * kNoise);
  }
  front.by_wall = {};
  front.fit();
  EXPECT_FALSE(front.divide());
}

TEST(DivideWalls, TheSameForAnyNumberOfThreads) {
  Front one(2.5 * kNoise, 4);
  Front many = one;
  EXPECT_EQ(one.divide(1), many.divide(4));
  EXPECT_EQ(idsOf(ringOf(one.layers)), idsOf(ringOf(many.layers)));
}

}  // namespace
