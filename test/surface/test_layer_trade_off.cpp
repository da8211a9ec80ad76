// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/layer_energy.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "layer_energies.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The least energy of all labelings with exactly so many labels in use.
std::map<std::size_t, double> leastByNumber(const LayerEnergy& e) {
  std::map<std::size_t, double> least;
  forAllLabelings(e, [&](const std::vector<int>& z) {
    const std::size_t count = std::set<int>(z.begin(), z.end()).size();
    const auto known = least.emplace(count, kInfinity).first;
    known->second = std::min(known->second, energyOf(e, z));
  });
  return least;
}

LayerEnergy withoutLabelCosts(LayerEnergy e) {
  e.label_cost.assign(e.num_labels, 0.0);
  return e;
}

TEST(LayerTradeOff, TheMinimumWithALimitIsThatOfAllLabelingsWithin) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const double scale = round % 3 == 0 ? 1.0 : round % 3 == 1 ? 1e12 : 1e-12;
    LayerEnergy e = randomEnergy(1 + random() % 6, 1 + random() % 5, random, scale);
    const auto least = leastByNumber(e);
    for (e.max_labels = 1; e.max_labels <= e.num_labels + 1; ++e.max_labels) {
      double expected = kInfinity;
      for (const auto& [number, energy] : least) {
        if (number <= e.max_labels) expected = std::min(expected, energy);
      }
      const LayerLabeling best = minimizeLayerEnergy(e);
      EXPECT_LE(std::set<int>(best.labels.begin(), best.labels.end()).size(), e.max_labels);
      EXPECT_TRUE(best.optimal);
      EXPECT_NEAR(best.energy, expected, 1e-8 * scale);
      EXPECT_NEAR(best.energy, energyOf(e, best.labels), 1e-12 * scale);
      const LayerLabeling expanded = expandLayerLabels(e);
      EXPECT_LE(std::set<int>(expanded.labels.begin(), expanded.labels.end()).size(), e.max_labels);
      EXPECT_GE(expanded.energy, best.energy - 1e-8 * scale);
    }
  }
}

TEST(LayerTradeOff, IsTheParetoFrontOfAllLabelings) {
  std::mt19937 random(2);
  std::map<std::size_t, int> sizes;
  for (int round = 0; round < 200; ++round) {
    const LayerEnergy e = randomEnergy(1 + random() % 6, 1 + random() % 5, random);
    std::vector<std::pair<std::size_t, double>> expected;
    for (const auto& [number, energy] : leastByNumber(withoutLabelCosts(e))) {
      if (expected.empty() || energy < expected.back().second - 1e-8) {
        expected.emplace_back(number, energy);
      }
    }
    const std::vector<LayerTradeOff> front = tradeOffLabels(e);
    ASSERT_EQ(front.size(), expected.size());
    ++sizes[front.size()];
    for (std::size_t i = 0; i < front.size(); ++i) {
      EXPECT_EQ(front[i].num_labels, expected[i].first);
      EXPECT_NEAR(front[i].labeling.energy, expected[i].second, 1e-8);
      EXPECT_NEAR(energyOf(withoutLabelCosts(e), front[i].labeling.labels), expected[i].second,
                  1e-8);
      EXPECT_TRUE(front[i].labeling.optimal);
    }
  }
  EXPECT_GE(sizes.size(), 3U) << "fronts of one or two points only: the test tests little";
}

TEST(LayerTradeOff, EndsAtTheLimitOfTheEnergy) {
  std::mt19937 random(3);
  LayerEnergy e = randomEnergy(6, 5, random);
  for (double& cost : e.pair) cost = 0.0;  // a label for each node is best
  const std::vector<LayerTradeOff> all = tradeOffLabels(e);
  ASSERT_GE(all.size(), 3U);
  e.max_labels = 2;
  const std::vector<LayerTradeOff> two = tradeOffLabels(e);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1].labeling.labels, all[1].labeling.labels);
}

TEST(LayerTradeOff, TwoLabelsThatHelpOnlyTogetherAreFound) {
  // One label, 0, for all: 4 x 1. With 1 or 2 beside it two steps of 3 make it worse; 1 and 2 fit
  // two nodes each, and only the step between them is cheap: 0.5. So two labels do, without 0.
  LayerEnergy e;
  e.num_nodes = 4;
  e.num_labels = 3;
  e.data = {1, 0, 9, 1, 0, 9, 1, 9, 0, 1, 9, 0};
  e.pair = {0, 3, 3, 3, 0, 0.5, 3, 0.5, 0};
  e.label_cost = {1, 1, 1};
  const std::vector<LayerTradeOff> front = tradeOffLabels(e);
  ASSERT_EQ(front.size(), 2U);
  EXPECT_EQ(front[0].labeling.labels, (std::vector<int>{0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(front[0].labeling.energy, 4.0);
  EXPECT_EQ(front[1].labeling.labels, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_DOUBLE_EQ(front[1].labeling.energy, 0.5);
}

TEST(LayerTradeOff, AHundredSlicesAreSolvedForEveryNumber) {
  // Five runs of 20 nodes with a label each (cost 0.1 there), and 30 labels that fit one node.
  // Elsewhere a label costs 0.6; a step costs 0.1: a label for a single node gains 0.1 and costs
  // two steps. Each run less costs 20 x 0.5 and saves a step, as its neighbour takes it over.
  const LayerEnergy e = runsOfLabels(100, 5, 30, 0.1);
  const std::vector<LayerTradeOff> front = tradeOffLabels(e);
  ASSERT_EQ(front.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(front[k].num_labels, k + 1);
    EXPECT_TRUE(front[k].labeling.optimal) << k + 1;
    const auto missing = static_cast<double>(4 - k);
    EXPECT_NEAR(front[k].labeling.energy, 100 * 0.1 + 20 * 0.5 * missing + 0.1 * (4.0 - missing),
                1e-9);
  }
}

TEST(LayerTradeOff, TheBoundHoldsWhenTheWorkRunsOut) {
  std::mt19937 random(4);
  int cut_short = 0;
  for (int round = 0; round < 40; ++round) {
    LayerEnergy e = withoutLabelCosts(randomEnergy(7, 5, random));
    e.max_labels = 2;
    double least = kInfinity;
    for (const auto& [number, energy] : leastByNumber(e)) {
      if (number <= 2) least = std::min(least, energy);
    }
    for (const std::size_t limit : {1U, 2U, 200U}) {
      const LayerLabeling result = minimizeLayerEnergy(e, limit);
      EXPECT_LE(result.lower_bound, least + 1e-8);
      EXPECT_GE(result.energy, least - 1e-8);
      EXPECT_LE(std::set<int>(result.labels.begin(), result.labels.end()).size(), 2U);
      if (!result.optimal) ++cut_short;
    }
  }
  EXPECT_GT(cut_short, 0) << "the limit was never met: the test tests nothing";
}

TEST(LayerTradeOff, AllNumbersOfLabelsShareTheWork) {
  constexpr std::size_t kLimit = 300;
  constexpr std::size_t kSlack = 3 * 122;  // branches that are begun are ended
  std::mt19937 random(6);
  const LayerEnergy e = randomEnergy(60, 40, random);
  const std::vector<LayerTradeOff> front = tradeOffLabels(e, kLimit);
  ASSERT_FALSE(front.empty());
  std::size_t work = 0;
  for (const LayerTradeOff& point : front) work += point.labeling.work;
  EXPECT_LE(work, kLimit + kSlack);
  EXPECT_LT(front.size(), 40U) << "the limit was never met: the test tests nothing";
}

TEST(LayerTradeOff, NothingAndBadCostsGiveNoPoints) {
  EXPECT_TRUE(tradeOffLabels({}).empty());
  std::mt19937 random(5);
  LayerEnergy bad = randomEnergy(3, 2, random);
  bad.data.pop_back();
  EXPECT_TRUE(tradeOffLabels(bad).empty());
}

}  // namespace
