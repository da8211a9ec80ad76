// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/assignment.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace {

using storey::detail::solveAssignment;

double costOf(const std::vector<double>& cost, const std::vector<int>& columns) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sum += cost[i * columns.size() + static_cast<std::size_t>(columns[i])];
  }
  return sum;
}

double leastOfAllPermutations(const std::vector<double>& cost, int n) {
  std::vector<int> columns(static_cast<std::size_t>(n));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    least = std::min(least, costOf(cost, columns));
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

void expectPermutation(std::vector<int> columns, int n) {
  ASSERT_EQ(columns.size(), static_cast<std::size_t>(n));
  std::sort(columns.begin(), columns.end());
  for (int i = 0; i < n; ++i) EXPECT_EQ(columns[static_cast<std::size_t>(i)], i);
}

TEST(Assignment, IsTheBestOfAllPermutations) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> real(-5.0, 5.0);
  std::uniform_int_distribution<int> few(0, 2);  // many ties
  for (int round = 0; round < 400; ++round) {
    const int n = 1 + round % 7;
    std::vector<double> cost(static_cast<std::size_t>(n * n));
    for (double& c : cost) c = round % 2 == 0 ? real(random) : few(random);
    const std::vector<int> columns = solveAssignment(cost, n);
    expectPermutation(columns, n);
    EXPECT_NEAR(costOf(cost, columns), leastOfAllPermutations(cost, n), 1e-9);
  }
}

TEST(Assignment, OfNothingIsEmpty) { EXPECT_TRUE(solveAssignment({}, 0).empty()); }

TEST(Assignment, OfEqualCostsIsInOrder) {
  const std::vector<int> columns = solveAssignment(std::vector<double>(25, 3.0), 5);
  EXPECT_EQ(columns, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Assignment, OfAHiddenPermutationIsFoundAmong200) {
  // Diagonal of zeros, permuted: the one assignment of cost 0.
  constexpr int kSize = 200;
  std::vector<int> hidden(kSize);
  std::iota(hidden.begin(), hidden.end(), 0);
  std::mt19937 random(2);
  std::shuffle(hidden.begin(), hidden.end(), random);
  std::uniform_real_distribution<double> positive(1e-3, 1.0);
  std::vector<double> cost(kSize * kSize);
  for (double& c : cost) c = positive(random);
  for (std::size_t i = 0; i < kSize; ++i) {
    cost[i * kSize + static_cast<std::size_t>(hidden[i])] = 0.0;
  }
  EXPECT_EQ(solveAssignment(cost, kSize), hidden);
}

}  // namespace
