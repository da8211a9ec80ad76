// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/layer_energy.h>

#include <limits>
#include <random>
#include <vector>

#include "layer_energies.h"

namespace {

using namespace storey;
using namespace storey::test;

TEST(LayerEnergy, EvaluatesTheSum) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    const LayerEnergy e = randomEnergy(5, 3, random);
    std::vector<int> z;
    for (int i = 0; i < 5; ++i) z.push_back(static_cast<int>(random() % 3));
    EXPECT_NEAR(e.evaluate(z), energyOf(e, z), 1e-12);
  }
}

TEST(LayerEnergy, TheMinimumIsThatOfAllLabelings) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const std::size_t nodes = 1 + random() % 6;
    const std::size_t labels = 1 + random() % 4;
    // Also with huge and tiny costs: what counts as rounding must follow.
    const double scale = round % 3 == 0 ? 1.0 : round % 3 == 1 ? 1e12 : 1e-12;
    const LayerEnergy e = randomEnergy(nodes, labels, random, scale);
    const LayerLabeling best = minimizeLayerEnergy(e);
    ASSERT_EQ(best.labels.size(), nodes);
    EXPECT_TRUE(best.optimal);
    EXPECT_NEAR(best.energy, leastOfAllLabelings(e), 1e-8 * scale);
    EXPECT_NEAR(best.energy, energyOf(e, best.labels), 1e-12 * scale);
    EXPECT_LE(best.lower_bound, best.energy);
    EXPECT_NEAR(best.lower_bound, best.energy, 1e-8 * scale);
  }
}

TEST(LayerEnergy, ExpansionIsNeverBetterAndNeverWorseThanTheBestSingleLabel) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    const LayerEnergy e = randomEnergy(1 + random() % 12, 1 + random() % 6, random);
    const LayerLabeling expanded = expandLayerLabels(e);
    EXPECT_NEAR(expanded.energy, energyOf(e, expanded.labels), 1e-9);
    EXPECT_GE(expanded.energy, minimizeLayerEnergy(e).energy - 1e-8);
    for (std::size_t t = 0; t < e.num_labels; ++t) {
      EXPECT_LE(expanded.energy,
                energyOf(e, std::vector<int>(e.num_nodes, static_cast<int>(t))) + 1e-9);
    }
  }
}

TEST(LayerEnergy, ExpansionStaysWhereTheMinimumNeedsTwoNewLabelsAtOnce) {
  // Two nodes, three labels. All 0 costs 2. The minimum (1, 2) costs 1.2, a step from 1 to 2 is
  // cheap, but from 0 to either is dear: a single expansion gives (1, 0) or (0, 2), 1 + 5, or
  // (1, 1) or (2, 2), 9.
  LayerEnergy e;
  e.num_nodes = 2;
  e.num_labels = 3;
  e.data = {1.0, 0.0, 9.0,  //
            1.0, 9.0, 0.0};
  e.pair = {0.0, 5.0, 5.0,  //
            5.0, 0.0, 1.2,  //
            5.0, 1.2, 0.0};
  e.label_cost = {0.0, 0.0, 0.0};
  const LayerLabeling exact = minimizeLayerEnergy(e);
  EXPECT_EQ(exact.labels, (std::vector<int>{1, 2}));
  EXPECT_NEAR(exact.energy, 1.2, 1e-12);
  const LayerLabeling expanded = expandLayerLabels(e);
  EXPECT_EQ(expanded.labels, (std::vector<int>{0, 0}));
  EXPECT_NEAR(expanded.energy, 2.0, 1e-12);
}

TEST(LayerEnergy, TheBoundHoldsWhenTheWorkRunsOut) {
  std::mt19937 random(4);
  int cut_short = 0;
  for (int round = 0; round < 60; ++round) {
    LayerEnergy e = randomEnergy(7, 5, random);
    for (double& cost : e.label_cost) cost *= 3.0;
    const double least = leastOfAllLabelings(e);
    for (const std::size_t limit : {1U, 2U, 200U, 500U}) {
      const LayerLabeling result = minimizeLayerEnergy(e, limit);
      ASSERT_EQ(result.labels.size(), 7U);
      EXPECT_LE(result.work, limit + 122U);
      EXPECT_LE(result.lower_bound, least + 1e-8);
      EXPECT_GE(result.energy, least - 1e-8);
      EXPECT_NEAR(result.energy, energyOf(e, result.labels), 1e-9);
      if (result.optimal) {
        EXPECT_NEAR(result.energy, least, 1e-8);
      } else {
        EXPECT_LT(result.lower_bound, result.energy);
        ++cut_short;
      }
    }
  }
  EXPECT_GT(cut_short, 0) << "the limit was never met: the test tests nothing";
}

TEST(LayerEnergy, AHundredSlicesOfFiveTypesAreSolved) {
  // Five runs of 20 nodes, each with its own label and 30 candidates that fit one node each.
  constexpr std::size_t kNodes = 100;
  LayerEnergy e = runsOfLabels(kNodes, 5, 30, 0.3);
  e.label_cost.assign(e.num_labels, 0.9);
  const LayerLabeling best = minimizeLayerEnergy(e);
  EXPECT_TRUE(best.optimal);
  for (std::size_t i = 0; i < kNodes; ++i) EXPECT_EQ(best.labels[i], static_cast<int>(i / 20));
  EXPECT_NEAR(best.energy, 100 * 0.1 + 4 * 0.3 + 5 * 0.9, 1e-9);
}

TEST(LayerEnergy, NothingToLabelIsNoLabels) {
  EXPECT_TRUE(minimizeLayerEnergy({}).labels.empty());
  EXPECT_TRUE(expandLayerLabels({}).labels.empty());
}

TEST(LayerEnergy, WrongSizesAndCostsGiveNoLabels) {
  std::mt19937 random(5);
  const LayerEnergy good = randomEnergy(3, 2, random);
  std::vector<LayerEnergy> bad(5, good);
  bad[0].data.pop_back();
  bad[1].pair.pop_back();
  bad[2].label_cost.push_back(1.0);
  bad[3].data[1] = -1.0;
  bad[4].pair[1] = std::numeric_limits<double>::quiet_NaN();
  for (const LayerEnergy& e : bad) {
    EXPECT_TRUE(minimizeLayerEnergy(e).labels.empty());
    EXPECT_TRUE(expandLayerLabels(e).labels.empty());
  }
}

}  // namespace
