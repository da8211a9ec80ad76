// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/alpha_expansion.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace {

using storey::detail::PottsEdge;
using storey::detail::PottsProblem;
using Labels = std::vector<std::size_t>;

int uniform(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

PottsProblem randomProblem(std::mt19937& random, std::size_t nodes, std::size_t labels,
                           double weight) {
  std::uniform_real_distribution<double> real(0.0, 1.0);
  PottsProblem problem;
  problem.num_labels = labels;
  for (std::size_t i = 0; i < nodes * labels; ++i) {
    problem.data_costs.push_back(real(random));
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t j = i + 1; j < nodes; ++j) {
      if (real(random) < 0.5) {
        problem.edges.push_back({i, j, weight * real(random)});
      }
    }
  }
  return problem;
}

// Counts through all labellings.
double optimum(const PottsProblem& problem) {
  Labels labels(problem.numNodes(), 0);
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    least = std::min(least, pottsEnergy(problem, labels));
    std::size_t i = 0;
    while (i < labels.size() && ++labels[i] == problem.num_labels) {
      labels[i++] = 0;
    }
    if (i == labels.size()) {
      return least;
    }
  }
}

constexpr double kRounding = 1e-12;  // of the costs to integers, and of sums of doubles

TEST(AlphaExpansion, TwoLabelsReachTheOptimum) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const PottsProblem problem = randomProblem(random, 8, 2, 0.8);
    EXPECT_NEAR(pottsEnergy(problem, minimizePotts(problem)), optimum(problem), kRounding);
  }
}

TEST(AlphaExpansion, WithinTheBoundAndMostlyOptimal) {
  std::mt19937 random(3);
  int optimal = 0;
  for (int round = 0; round < 100; ++round) {
    const PottsProblem problem = randomProblem(random, 7, 4, 0.5);
    const double least = optimum(problem);
    const double energy = pottsEnergy(problem, minimizePotts(problem));
    EXPECT_GE(energy, least - kRounding);
    EXPECT_LE(energy, 2.0 * least + kRounding);
    optimal += energy <= least + kRounding ? 1 : 0;
  }
  EXPECT_GT(optimal, 50);  // an expansion that did nothing would leave the result of single nodes
}

TEST(AlphaExpansion, NoExpansionOfAnyLabelIsBetter) {
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round) {
    const PottsProblem problem = randomProblem(random, 10, 3, 0.6);
    const Labels labels = minimizePotts(problem);
    const double energy = pottsEnergy(problem, labels);
    for (std::size_t alpha = 0; alpha < 3; ++alpha) {
      for (unsigned int subset = 0; subset < 1U << 10; ++subset) {
        Labels expanded = labels;
        for (std::size_t i = 0; i < 10; ++i) {
          expanded[i] = (subset >> i & 1U) != 0 ? alpha : labels[i];
        }
        EXPECT_GE(pottsEnergy(problem, expanded), energy - kRounding);
      }
    }
  }
}

TEST(AlphaExpansion, NeverAboveTheNodesAlone) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    const PottsProblem problem = randomProblem(random, 60, 5, 0.1);
    Labels labels = cheapestLabels(problem);
    const double start = pottsEnergy(problem, labels);
    descendByNodes(problem, labels);
    const double descended = pottsEnergy(problem, labels);
    EXPECT_LE(descended, start + kRounding);
    EXPECT_LE(pottsEnergy(problem, minimizePotts(problem)), descended + kRounding);
  }
}

TEST(AlphaExpansion, MovingBoundariesNeverRaisesTheEnergy) {
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    const PottsProblem problem = randomProblem(random, 60, 5, 0.1);
    Labels labels(60);
    for (std::size_t& label : labels) {
      label = static_cast<std::size_t>(uniform(random, 0, 4));
    }
    double energy = pottsEnergy(problem, labels);
    for (const std::size_t reach : {0U, 1U, 2U, 60U}) {
      moveBoundaries(problem, reach, labels);
      EXPECT_LE(pottsEnergy(problem, labels), energy + kRounding);
      energy = pottsEnergy(problem, labels);
    }
  }
}

TEST(AlphaExpansion, ABoundaryMovesThroughNodesThatDoNotCare) {
  // a row of 8: the left end wants label 0, a weak link lies in the middle, and the boundary
  // starts at the right end, where single nodes gain nothing by a change
  PottsProblem problem;
  problem.num_labels = 2;
  problem.data_costs.assign(16, 0.0);
  problem.data_costs[1] = 9.0;   // node 0 pays 9 for label 1
  problem.data_costs[14] = 9.0;  // node 7 pays 9 for label 0
  for (std::size_t i = 0; i + 1 < 8; ++i) {
    problem.edges.push_back({i, i + 1, i == 3 ? 0.5 : 1.0});
  }
  Labels labels = {0, 0, 0, 0, 0, 0, 0, 1};
  descendByNodes(problem, labels);
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 0, 0, 0, 1}));
  moveBoundaries(problem, 2, labels);  // two nodes further there is nothing to gain
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 0, 0, 0, 1}));
  moveBoundaries(problem, 3, labels);
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(AlphaExpansion, PermutedNodesOfAChainHaveTheSameEnergy) {
  // weights so small that the optimum is found whatever the order of visits
  std::mt19937 random(6);
  PottsProblem problem = randomProblem(random, 40, 4, 0.02);
  Labels place(40);
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::shuffle(place.begin(), place.end(), random);
  PottsProblem permuted = problem;
  for (std::size_t i = 0; i < 40; ++i) {
    std::copy_n(problem.data_costs.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                permuted.data_costs.begin() + static_cast<std::ptrdiff_t>(4 * place[i]));
  }
  for (PottsEdge& edge : permuted.edges) {
    edge.a = place[edge.a];
    edge.b = place[edge.b];
  }
  EXPECT_NEAR(pottsEnergy(problem, minimizePotts(problem)),
              pottsEnergy(permuted, minimizePotts(permuted)), 40 * kRounding);
}

TEST(AlphaExpansion, GroupsKeepTheEnergyOfTheirLabellings) {
  std::mt19937 random(7);
  const PottsProblem problem = randomProblem(random, 12, 3, 0.5);
  Labels group(12);
  for (std::size_t& g : group) {
    g = static_cast<std::size_t>(uniform(random, 0, 3));
  }
  const PottsProblem grouped = aggregatePotts(problem, group, 4);
  EXPECT_LE(grouped.edges.size(), 6U);  // pairs among four groups, each once
  for (int round = 0; round < 20; ++round) {
    Labels label_of_group(4);
    for (std::size_t& l : label_of_group) {
      l = static_cast<std::size_t>(uniform(random, 0, 2));
    }
    Labels labels;
    for (const std::size_t g : group) {
      labels.push_back(label_of_group[g]);
    }
    EXPECT_NEAR(pottsEnergy(grouped, label_of_group), pottsEnergy(problem, labels), kRounding);
  }
}

TEST(AlphaExpansion, NothingAndOneLabel) {
  EXPECT_TRUE(minimizePotts(PottsProblem()).empty());
  PottsProblem one;
  one.num_labels = 1;
  one.data_costs = {3.0, 4.0};
  one.edges = {{0, 1, 1.0}};
  EXPECT_EQ(minimizePotts(one), (Labels{0, 0}));
}

}  // namespace
