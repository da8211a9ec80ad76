// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/neighbor_search.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace {

using storey::detail::DistinctPositions;
using storey::detail::Neighborhood;
using storey::detail::NeighborSearch;
using Positions = std::vector<Eigen::Vector3f>;

// A noisy plane, a heap a thousand times as dense, a line, and outliers a million extents away.
Positions makeUneven() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::normal_distribution<float> normal(0.0f, 0.01f);
  Positions positions;
  for (int i = 0; i < 1500; ++i) {
    positions.emplace_back(10 * uniform(random), normal(random), 5 * uniform(random));
  }
  for (int i = 0; i < 500; ++i) {
    positions.emplace_back(3 + normal(random), 2 + normal(random), normal(random));
  }
  for (int i = 0; i < 300; ++i) positions.emplace_back(20 + 0.01f * static_cast<float>(i), 0, 0);
  positions.emplace_back(1e7f, 0, 0);
  positions.emplace_back(0, -1e7f, 3e6f);
  std::shuffle(positions.begin(), positions.end(), random);
  return positions;
}

// Equal distances everywhere.
Positions makeLattice() {
  Positions positions;
  for (int i = 0; i < 12 * 11 * 10; ++i) {
    positions.emplace_back(static_cast<float>(i % 12), static_cast<float>(i / 12 % 11),
                           static_cast<float>(i / 132));
  }
  return positions;
}

// Ids of the k nearest, ascending; of equally far ones the lower.
pcl::Indices bruteForce(const pcl::PointCloud<pcl::PointXYZ>& cloud, std::size_t query,
                        std::size_t k) {
  std::vector<std::pair<float, pcl::index_t>> order;
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    const float dx = cloud[j].x - cloud[query].x;
    const float dy = cloud[j].y - cloud[query].y;
    const float dz = cloud[j].z - cloud[query].z;
    order.emplace_back(dx * dx + dy * dy + dz * dz, static_cast<pcl::index_t>(j));
  }
  std::sort(order.begin(), order.end());
  pcl::Indices ids;
  for (std::size_t i = 0; i < std::min(k, order.size()); ++i) ids.push_back(order[i].second);
  std::sort(ids.begin(), ids.end());
  return ids;
}

void expectExact(const Positions& positions, std::size_t k) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(positions);
  const NeighborSearch search(distinct.cloud);
  const std::vector<char> all(distinct.cloud->size(), 1);
  std::vector<pcl::Indices> found(distinct.cloud->size());
  search.forEach(k, all, 2, [&](const Neighborhood& n) {
    found[static_cast<std::size_t>(n.id)].assign(n.ids, n.ids + n.count);
  });
  NeighborSearch::Workspace workspace;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const pcl::Indices expected = bruteForce(*distinct.cloud, i, k);
    ASSERT_EQ(found[i], expected) << "position " << i << ", k " << k;
    const Neighborhood alone = search.nearest(static_cast<pcl::index_t>(i), k, workspace);
    ASSERT_EQ(pcl::Indices(alone.ids, alone.ids + alone.count), expected) << i;
  }
}

TEST(NeighborSearch, IsExactWhereDensitiesDifferAThousandfold) {
  for (const std::size_t k : {1, 2, 16, 30, 200}) expectExact(makeUneven(), k);
}

TEST(NeighborSearch, TakesTheLowerIdsOfEquallyFarPositions) {
  for (const std::size_t k : {2, 5, 7, 30, 33}) expectExact(makeLattice(), k);
}

TEST(NeighborSearch, TakesAllWhereThereAreFewer) {
  for (const std::size_t n : {1, 2, 3, 8, 9, 17}) {
    Positions few = makeUneven();
    few.resize(n);
    expectExact(few, 30);
  }
}

TEST(NeighborSearch, VisitsNothingWithoutPositions) {
  const NeighborSearch search(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>());
  search.forEach(30, {}, 1, [](const Neighborhood&) { FAIL(); });
}

TEST(NeighborSearch, VisitsTheWantedOnly) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(makeUneven());
  std::vector<char> wanted(distinct.cloud->size(), 0);
  for (std::size_t i = 0; i < wanted.size(); i += 7) wanted[i] = 1;
  std::atomic<int> visits{0};
  NeighborSearch(distinct.cloud).forEach(30, wanted, 2, [&](const Neighborhood& n) {
    EXPECT_EQ(n.id % 7, 0);
    ++visits;
  });
  EXPECT_EQ(visits, std::count(wanted.begin(), wanted.end(), 1));
}

// Against sums in the plain order of the neighbours, about the same origin.
TEST(NeighborSearch, SumsMomentsAboutTheFirst) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(makeUneven());
  NeighborSearch::Workspace workspace;
  const Neighborhood n = NeighborSearch(distinct.cloud).nearest(100, 30, workspace);
  const auto at = [&](pcl::index_t id) -> Eigen::Vector3d {
    return (*distinct.cloud)[static_cast<std::size_t>(id)].getVector3fMap().cast<double>();
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < n.count; ++i) {
    const Eigen::Vector3d d = at(n.ids[i]) - at(n.ids[0]);
    sum += d;
    products += d * d.transpose();
  }
  const storey::detail::Moments moments = n.moments();
  EXPECT_EQ(moments.count, 30.0);
  const double scale = products.trace();
  const std::pair<int, int> places[] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(moments.sum[i], sum[static_cast<int>(i)], 1e-14 * sum.norm());
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(moments.products[i], products(places[i].first, places[i].second), 1e-14 * scale);
  }
}

// Far outliers leave the building one cell of a curve over everything; it must stay as fast.
TEST(NeighborSearch, OrdersABuildingAmongOutliersAsWithoutThem) {
  Positions near;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (int i = 0; i < 20000; ++i) near.emplace_back(uniform(random), uniform(random), 0.0f);
  Positions with = near;
  for (int i = 0; i < 5; ++i) with.emplace_back(1e9f * static_cast<float>(i - 2), 1e9f, 1e9f);
  const auto medianStep = [](const Positions& positions) {
    const DistinctPositions distinct = storey::detail::findDistinctPositions(positions);
    std::vector<float> steps;
    for (std::size_t i = 1; i < distinct.cloud->size(); ++i) {
      steps.push_back(
          ((*distinct.cloud)[i].getVector3fMap() - (*distinct.cloud)[i - 1].getVector3fMap())
              .norm());
    }
    std::nth_element(steps.begin(), steps.begin() + 10000, steps.end());
    return steps[10000];
  };
  EXPECT_NEAR(medianStep(with), medianStep(near), 0.2f * medianStep(near));
}

}  // namespace
