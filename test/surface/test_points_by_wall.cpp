// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/points_by_wall.h>

#include <cmath>
#include <random>
#include <tuple>

#include "named_layers.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::PointsByWall;
using detail::WallPlace;

struct Places {
  std::vector<WallPlace> all;

  Places& operator+=(const Places& other) {
    all.insert(all.end(), other.all.begin(), other.all.end());
    return *this;
  }
};

std::vector<Places> placesOf(const PointsByWall& by_wall, unsigned int threads) {
  return by_wall.sum<Places>(
      threads, [](std::size_t, const WallPlace* begin, const WallPlace* end, Places& places) {
        places.all.insert(places.all.end(), begin, end);
      });
}

bool operator==(const Places& a, const Places& b) {
  return std::equal(a.all.begin(), a.all.end(), b.all.begin(), b.all.end(),
                    [](const WallPlace& p, const WallPlace& q) {
                      return std::tie(p.along, p.across, p.height) ==
                             std::tie(q.along, q.across, q.height);
                    });
}

// Points all over the building and beside it, normals all over the sphere.
FitPoints anyPoints(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  FitPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.positions.emplace_back(-1.0F + 22.0F * unit(random), -1.0F + 17.0F * unit(random),
                                  -1.0F + 12.0F * unit(random));
    points.normals.emplace_back(normal(random), normal(random), normal(random));
  }
  return points;
}

// The wall of a point as the class describes it, of a single layer whose walls have ids 0, 1, ...
int wallOf(const FloorplanLayer& layer, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  if (std::abs(n.z()) > n.head<2>().norm() || p.z() < layer.z_min || p.z() >= layer.z_max) {
    return -1;
  }
  const FloorplanRing& ring = layer.plan.components[0].outer;
  int best = -1;
  double nearest = 4.0 * kSigma;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring.vertices[i];
    const Eigen::Vector2d side = ring.vertices[(i + 1) % ring.size()] - a;
    const Eigen::Vector2d tangent = side.normalized();
    const Eigen::Vector2d outwards(tangent.y(), -tangent.x());
    if (outwards.dot(n.head<2>()) < 0.35) continue;  // 70 degrees, for a horizontal normal
    const double along = tangent.dot(p.head<2>() - a);
    const double margin = std::min(1.5 * kSigma, 0.25 * side.norm());
    if (along < margin || along > side.norm() - margin) continue;
    const double across = std::abs(outwards.dot(p.head<2>() - a));
    if (across > nearest) continue;
    nearest = across;
    best = ring.edges[i].wall;
  }
  return best;
}

TEST(PointsByWall, HoldEveryPointOfEveryWallInItsFrame) {
  const FitPoints points = anyPoints(50000);
  PointsByWall by_wall;
  ASSERT_TRUE(by_wall.gather(lShape(), points, kSigma, 2));
  const std::vector<Places> places = placesOf(by_wall, 2);
  ASSERT_EQ(places.size(), 6U);
  std::vector<std::size_t> next(6, 0);
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3d p = points.positions[i].cast<double>();
    const int wall = wallOf(lShape()[0], p, points.normals[i].cast<double>());
    if (wall < 0) continue;
    const auto k = static_cast<std::size_t>(wall);
    ASSERT_LT(next[k], places[k].all.size());
    const WallPlace& place = places[k].all[next[k]++];
    const detail::WallFrame& frame = by_wall.frames()[k];
    EXPECT_EQ(frame.id, wall);
    const Eigen::Vector2d back =
        frame.reference + place.along * frame.tangent() + place.across * frame.normal;
    EXPECT_LT((back - p.head<2>()).norm(), 1e-5);
    EXPECT_NEAR(place.height, p.z() - 5.0, 1e-5);  // the middle of the building
  }
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(next[k], places[k].all.size());
}

TEST(PointsByWall, AreTheSameForAnyNumberOfThreads) {
  const FitPoints points = anyPoints(50000);
  PointsByWall one, four;
  one.gather(lShape(), points, kSigma, 1);
  four.gather(lShape(), points, kSigma, 4);
  EXPECT_EQ(placesOf(one, 1), placesOf(four, 4));
}

TEST(PointsByWall, AreGatheredAgainWhereTheLayersHaveChanged) {
  const FitPoints points = anyPoints(1000);
  const auto isAnew = [&](const std::vector<FloorplanLayer>& layers) {
    PointsByWall by_wall;
    by_wall.gather(lShape(), points, kSigma, 1);
    return by_wall.gather(layers, points, kSigma, 1);
  };
  EXPECT_FALSE(isAnew(lShape()));
  for (const double shift : {0.2 * kSigma, 0.3 * kSigma}) {
    const bool far = shift > 0.25 * kSigma;
    std::vector<FloorplanLayer> layers = lShape();
    layers[0].plan.components[0].outer.vertices[2].x() += shift;
    EXPECT_EQ(isAnew(layers), far);
    layers = lShape();
    layers[0].z_max -= shift;
    EXPECT_EQ(isAnew(layers), far);
  }
  std::vector<FloorplanLayer> layers = lShape();
  layers[0].plan.components[0].outer.edges[3].wall = 0;
  EXPECT_TRUE(isAnew(layers));
  layers = {layer(0, 5, {rectangle(0, 0, 20, 8)}), layer(5, 10, {rectangle(0, 0, 20, 8)})};
  EXPECT_TRUE(isAnew(named(layers)));
}

}  // namespace
