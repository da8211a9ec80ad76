// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/point_cubes.h>

#include <cmath>
#include <map>
#include <random>

namespace storey::detail {
namespace {

constexpr double kSide = 0.3;

std::vector<OrientedPoint> randomPoints(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> along(-2.0f, 2.0f);
  std::vector<OrientedPoint> points(count);
  for (OrientedPoint& point : points) {
    for (float& coordinate : point.position) coordinate = along(random);
  }
  return points;
}

GridCell floorOf(const Eigen::Vector3f& p) {
  GridCell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<double>(p[static_cast<Eigen::Index>(axis)]);
    cell[axis] = static_cast<std::int64_t>(std::floor(along / kSide));
  }
  return cell;
}

// The points of several chunks share cubes, which are numbered as if there were one.
TEST(PointCubes, AreNumberedAsTheyComeForAnyNumberOfThreads) {
  const std::vector<OrientedPoint> points = randomPoints(50000);
  const auto counts = [](std::size_t i) { return i % 3 != 0; };
  std::map<GridCell, std::uint32_t> number_of;
  std::vector<std::uint32_t> expected;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!counts(i)) {
      expected.push_back(PointCubes::kNone);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(number_of.size());
    expected.push_back(number_of.try_emplace(floorOf(points[i].position), next).first->second);
  }
  for (const unsigned int threads : {1u, 2u, 3u}) {
    const PointCubes cubes = sortIntoCubes(points, kSide, counts, threads);
    EXPECT_EQ(cubes.of, expected);
    ASSERT_EQ(cubes.cells.size(), number_of.size());
    for (const auto& [cell, number] : number_of) EXPECT_EQ(cubes.cells[number], cell);
  }
}

TEST(PointCubes, OfNoPointsAreNone) {
  const PointCubes cubes = sortIntoCubes(
      {}, kSide, [](std::size_t) { return true; }, 2);
  EXPECT_EQ(cubes.cells.size(), 0u);
  EXPECT_TRUE(cubes.of.empty());
}

}  // namespace
}  // namespace storey::detail
