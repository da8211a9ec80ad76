// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/place_order.h>
#include <storey/segmentation/detail/point_blocks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace {

using namespace storey::detail;

pcl::PointCloud<pcl::PointXYZ> randomCloud(std::size_t size) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-20.0f, 50.0f);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (std::size_t i = 0; i < size; ++i) {
    cloud.emplace_back(place(random), place(random), place(random));
  }
  return cloud;
}

pcl::Indices allOf(std::size_t size) {
  pcl::Indices indices(size);
  for (std::size_t i = 0; i < size; ++i) indices[i] = static_cast<pcl::index_t>(i);
  return indices;
}

std::vector<WallPoint> toWallPoints(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                                    const pcl::Indices& order) {
  std::vector<WallPoint> points;
  for (const pcl::index_t i : order) {
    const pcl::PointXYZ& p = cloud[static_cast<std::size_t>(i)];
    points.push_back({{p.x, p.y}, p.z, {1.0, 0.0}});
  }
  return points;
}

TEST(PlaceOrder, HoldsEveryFinitePointOnce) {
  pcl::PointCloud<pcl::PointXYZ> cloud = randomCloud(5000);
  cloud[7].y = std::numeric_limits<float>::quiet_NaN();
  cloud[8].x = std::numeric_limits<float>::infinity();
  pcl::Indices expected = allOf(cloud.size());
  expected.erase(expected.begin() + 7, expected.begin() + 9);
  pcl::Indices order = orderByPlace(cloud, allOf(cloud.size()), 2);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, expected);
  EXPECT_TRUE(orderByPlace(cloud, {}, 2).empty());
  EXPECT_EQ(orderByPlace(cloud, {3, 3}, 2), (pcl::Indices{3, 3}));  // all at one place
}

TEST(PlaceOrder, PointsOneAfterTheOtherAreNear) {
  // 5000 points over 64 x 64 columns of 1.1: the next one is in the same column or the one beside.
  // Two random points of a square of side L are 0.52 L apart in the mean.
  const pcl::PointCloud<pcl::PointXYZ> cloud = randomCloud(5000);
  const auto points = toWallPoints(cloud, orderByPlace(cloud, allOf(cloud.size()), 2));
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += (points[i].position - points[i - 1].position).norm();
  }
  EXPECT_LT(sum / static_cast<double>(points.size()), 0.1 * 0.52 * 70.0);
}

// Random points are half of the extent apart; those of a column of cells half a cell.
TEST(PlaceOrder, IsSeenWhereItIs) {
  pcl::PointCloud<pcl::PointXYZ> cloud = randomCloud(500000);
  EXPECT_FALSE(areByPlace(cloud, allOf(cloud.size())));
  const pcl::Indices order = orderByPlace(cloud, allOf(cloud.size()), 2);
  EXPECT_TRUE(areByPlace(cloud, order));
  cloud[static_cast<std::size_t>(order[0])].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(areByPlace(cloud, order));
  for (pcl::PointXYZ& p : cloud) p.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(areByPlace(cloud, order));
  EXPECT_FALSE(areByPlace(cloud, {}));
}

TEST(PointBlocks, NoPointNearALineIsPassedOver) {
  const pcl::PointCloud<pcl::PointXYZ> cloud = randomCloud(300000);  // a block of 64 a column
  const auto points = toWallPoints(cloud, orderByPlace(cloud, allOf(cloud.size()), 2));
  const PointBlocks blocks(points);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t passed = 0, total = 0, covered = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const double angle = 2.0 * M_PI * unit(random);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const double offset = normal.dot(Eigen::Vector2d(15, 15)) + 40.0 * (unit(random) - 0.5);
    covered = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b, ++total) {
      covered += blocks.end(b) - blocks.begin(b);
      if (blocks.mayBeNear(b, normal, offset, 0.5)) continue;
      ++passed;
      for (std::size_t i = blocks.begin(b); i < blocks.end(b); ++i) {
        ASSERT_GE(std::abs(normal.dot(points[i].position) - offset), 0.5);
      }
    }
  }
  EXPECT_EQ(covered, points.size());
  EXPECT_GT(2 * passed, total);  // or the blocks are of no use
}

TEST(PointBlocks, AllPointsInAStripAreInTheBlocksThatAreTold) {
  const pcl::PointCloud<pcl::PointXYZ> cloud = randomCloud(100000);
  const auto points = toWallPoints(cloud, orderByPlace(cloud, allOf(cloud.size()), 2));
  const PointBlocks blocks(points);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t told = 0, held = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const double angle = 2.0 * M_PI * unit(random);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    const Eigen::Vector2d middle(30.0 * unit(random), 30.0 * unit(random));
    const PlanStrip strip{normal, normal.dot(middle), 0.5, tangent.dot(middle) - 3.0,
                          tangent.dot(middle) + 3.0};
    std::vector<char> is_told(blocks.size(), 0);
    std::size_t next = 0;
    blocks.forEachIn(strip, [&](std::size_t b) {
      EXPECT_GE(b, next);
      next = b + 1;
      is_told[b] = 1;
      ++told;
    });
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      for (std::size_t i = blocks.begin(b); i < blocks.end(b); ++i) {
        const double s = tangent.dot(points[i].position);
        const double d = normal.dot(points[i].position) - strip.offset;
        if (std::abs(d) >= strip.reach || s < strip.s_min || s > strip.s_max) continue;
        ++held;
        ASSERT_EQ(is_told[b], 1);
      }
    }
  }
  EXPECT_GT(held, 0U);
  EXPECT_LT(10 * told, 20 * blocks.size());  // or they are of no use
}

TEST(GridCells, NumbersAreThoseOfAMap) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> along(-12, 12);
  GridCells cells;
  std::map<GridCell, std::size_t> expected;
  EXPECT_EQ(cells.find({0, 0, 0}), GridCells::kNone);
  for (int i = 0; i < 20000; ++i) {
    const GridCell cell{along(random), along(random), along(random)};
    const auto [known, added] = expected.emplace(cell, expected.size());
    ASSERT_EQ(cells.add(cell), known->second);
    ASSERT_EQ(cells[known->second], cell);
  }
  EXPECT_EQ(cells.size(), expected.size());
  for (const auto& [cell, number] : expected) ASSERT_EQ(cells.find(cell), number);
  EXPECT_EQ(cells.find({13, 0, 0}), GridCells::kNone);
}

TEST(GridCells, ACellReachesFromItsLowerSideOn) {
  for (const double at : {-2.0, -1.75, -0.5, 0.0, 0.25, 3.5, 4.0}) {
    EXPECT_EQ(cellAlong(at, 0.5), static_cast<std::int64_t>(std::floor(at / 0.5)));
  }
}

}  // namespace
