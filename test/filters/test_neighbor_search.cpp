// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/neighbor_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace {

using storey::detail::DistinctPositions;
using storey::detail::MomentBatch;
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

// First and second moments of some positions about one of them, added in double.
std::array<double, 9> momentsAbout(const pcl::PointCloud<pcl::PointXYZ>& cloud, std::size_t origin,
                                   const pcl::Indices& ids) {
  std::array<double, 9> sums{};
  for (const pcl::index_t id : ids) {
    const Eigen::Vector3d d = cloud[static_cast<std::size_t>(id)].getVector3fMap().cast<double>() -
                              cloud[origin].getVector3fMap().cast<double>();
    const std::array<double, 9> terms = {d.x(),         d.y(),         d.z(),
                                         d.x() * d.x(), d.x() * d.y(), d.x() * d.z(),
                                         d.y() * d.y(), d.y() * d.z(), d.z() * d.z()};
    for (std::size_t s = 0; s < 9; ++s) sums[s] += terms[s];
  }
  return sums;
}

// A sum of k terms is off by less than k 2^-53 of the sum of their sizes, which for the products is
// their trace at most, and for the sums the root of k times that.
void expectMoments(const MomentBatch& batch, std::size_t lane,
                   const std::array<double, 9>& expected) {
  const auto k = static_cast<double>(batch.count);
  const double trace = expected[3] + expected[6] + expected[8];
  for (std::size_t s = 0; s < 9; ++s) {
    const double size = s < 3 ? std::sqrt(k * trace) : trace;
    ASSERT_NEAR(batch.moments[s][lane], expected[s], (k + 3.0) * std::ldexp(1.0, -53) * size);
  }
}

void expectExact(const Positions& positions, std::size_t k) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(positions);
  const pcl::PointCloud<pcl::PointXYZ>& cloud = *distinct.cloud;
  const NeighborSearch search(distinct.cloud);
  std::vector<pcl::Indices> nearest(cloud.size());
  NeighborSearch::Workspace workspace;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    nearest[i] = bruteForce(cloud, i, k);
    const Neighborhood found = search.nearest(static_cast<pcl::index_t>(i), k, workspace);
    ASSERT_EQ(pcl::Indices(found.ids, found.ids + found.count), nearest[i]) << i << ", k " << k;
  }
  std::vector<int> visits(cloud.size(), 0);
  search.forEachMoments(k, std::vector<char>(cloud.size(), 1), 2, [&](const MomentBatch& batch) {
    for (std::size_t lane = 0; lane < storey::detail::kLanes; ++lane) {
      if (batch.ids[lane] < 0) continue;
      const auto id = static_cast<std::size_t>(batch.ids[lane]);
      ++visits[id];
      const std::size_t origin = k < cloud.size() ? id : 0;
      expectMoments(batch, lane, momentsAbout(cloud, origin, nearest[id]));
    }
  });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<long>(cloud.size()));
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
  search.forEachMoments(30, {}, 1, [](const MomentBatch&) { FAIL(); });
}

// Whatever positions are searched together, and by how many threads: the same bytes for each.
TEST(NeighborSearch, VisitsTheWantedWithTheSameMomentsInAnyCompany) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(makeUneven());
  const NeighborSearch search(distinct.cloud);
  using Sums = std::array<double, 9>;
  const auto momentsOf = [&](std::size_t step, unsigned int threads) {
    std::vector<char> wanted(distinct.cloud->size(), 0);
    for (std::size_t i = 0; i < wanted.size(); i += step) wanted[i] = 1;
    std::vector<Sums> found(wanted.size());
    search.forEachMoments(30, wanted, threads, [&](const MomentBatch& batch) {
      for (std::size_t lane = 0; lane < storey::detail::kLanes; ++lane) {
        if (batch.ids[lane] < 0) continue;
        for (std::size_t s = 0; s < 9; ++s) {
          found[static_cast<std::size_t>(batch.ids[lane])][s] = batch.moments[s][lane];
        }
      }
    });
    return found;
  };
  const std::vector<Sums> all = momentsOf(1, 1);
  EXPECT_EQ(momentsOf(1, 3), all);
  const std::vector<Sums> some = momentsOf(7, 2);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(some[i], i % 7 == 0 ? all[i] : Sums{}) << i;
  }
}

float medianStep(const Positions& positions) {
  const DistinctPositions distinct = storey::detail::findDistinctPositions(positions);
  std::vector<float> steps;
  for (std::size_t i = 1; i < distinct.cloud->size(); ++i) {
    steps.push_back(
        ((*distinct.cloud)[i].getVector3fMap() - (*distinct.cloud)[i - 1].getVector3fMap()).norm());
  }
  std::nth_element(steps.begin(), steps.begin() + 10000, steps.end());
  return steps[10000];
}

// Far outliers leave the building one cell of a curve over everything; it must stay as fast.
TEST(NeighborSearch, OrdersABuildingAmongOutliersAsWithoutThem) {
  Positions near;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (int i = 0; i < 20000; ++i) near.emplace_back(uniform(random), uniform(random), 0.0f);
  Positions with = near;
  for (int i = 0; i < 5; ++i) with.emplace_back(1e9f * static_cast<float>(i - 2), 1e9f, 1e9f);
  EXPECT_NEAR(medianStep(with), medianStep(near), 0.2f * medianStep(near));
}

// Where all outliers lie on one side of a wall without thickness, its place is the end of a box
// that gets narrower until rounding moves the end past it.
TEST(NeighborSearch, OrdersAFlatWallWithOutliersOnOneSide) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (const float x : {9.7f, -6.0f, 103.15f, 0.0f}) {
    Positions near;
    for (int i = 0; i < 20000; ++i) near.emplace_back(x, uniform(random), uniform(random));
    for (const float far : {-1944037.0f, -25896366.0f, -48603.266f, 1944037.0f}) {
      Positions with = near;
      with.emplace_back(far, 0.5f, 0.5f);
      EXPECT_NEAR(medianStep(with), medianStep(near), 0.2f * medianStep(near)) << x << ' ' << far;
    }
  }
}

}  // namespace
