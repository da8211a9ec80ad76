// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "plans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::CellBlock;
using detail::CellEnergyOptions;
using detail::labelCells;
using detail::LevelPoint;
using detail::WallEvidence;

constexpr double kBin = 0.5;

// Confirmed shares of the area of each edge, one row a layer; negative: facing the other way.
using Shares = std::vector<std::vector<double>>;

WallEvidence evidenceOf(const LineArrangement& plan, const Shares& shares,
                        const std::vector<std::size_t>& levels) {
  WallEvidence evidence;
  evidence.bin = kBin;
  evidence.num_bins = levels.back();
  evidence.seen.assign(plan.edges.size() * evidence.num_bins, 0.0f);
  evidence.ahead = evidence.behind = evidence.seen;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      for (std::size_t b = levels[l]; b < levels[l + 1]; ++b) {
        evidence.seen[e * evidence.num_bins + b] =
            static_cast<float>(shares[l][e] * plan.edges[e].length() * kBin);
      }
    }
  }
  return evidence;
}

// Layers `first` .. `last` - 1 labelled `inside`: the energy as the header states it.
double energyOf(const LineArrangement& plan, const Shares& shares,
                const std::vector<std::size_t>& levels, std::size_t first, std::size_t last,
                double gap, const std::vector<char>& inside) {
  double sum = 0.0;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    double area = 0.0;
    double confirmed = 0.0;
    for (std::size_t l = first; l < last; ++l) {
      const double a = edge.length() * kBin * static_cast<double>(levels[l + 1] - levels[l]);
      area += a;
      confirmed += shares[l][e] * a;
    }
    const int ahead = inside[static_cast<std::size_t>(edge.ahead)];
    const int behind = inside[static_cast<std::size_t>(edge.behind)];
    sum += confirmed * (ahead - behind) + gap * (area - std::abs(confirmed)) * (ahead != behind);
  }
  return sum;
}

// Calls `visit` with every labelling of the cells that are not at the border.
template <typename Visit>
void forAllInsides(const LineArrangement& plan, const Visit& visit) {
  std::vector<std::size_t> free;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    if (plan.at_border[c] == 0) free.push_back(c);
  }
  std::vector<char> inside(plan.cells.size(), 0);
  for (unsigned mask = 0; mask < 1U << free.size(); ++mask) {
    for (std::size_t i = 0; i < free.size(); ++i) inside[free[i]] = (mask >> i & 1U) != 0 ? 1 : 0;
    visit(inside);
  }
}

double leastOfBlock(const LineArrangement& plan, const Shares& shares,
                    const std::vector<std::size_t>& levels, std::size_t first, std::size_t last,
                    double gap) {
  double least = std::numeric_limits<double>::infinity();
  forAllInsides(plan, [&](const std::vector<char>& inside) {
    least = std::min(least, energyOf(plan, shares, levels, first, last, gap, inside));
  });
  return least;
}

// The least energy over all partitions of the layers and all labelings of the blocks.
double leastOfAll(const LineArrangement& plan, const Shares& shares,
                  const std::vector<std::size_t>& levels, const CellEnergyOptions& options) {
  const std::size_t n = levels.size() - 1;
  std::vector<std::vector<double>> block(n, std::vector<double>(n + 1, 0.0));
  for (std::size_t first = 0; first < n; ++first) {
    for (std::size_t last = first + 1; last <= n; ++last) {
      block[first][last] = leastOfBlock(plan, shares, levels, first, last, options.gap);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (unsigned cuts = 0; cuts < 1U << (n - 1); ++cuts) {
    double sum = 0.0;
    for (std::size_t first = 0, last = 1; last <= n; ++last) {
      if (last < n && (cuts >> (last - 1) & 1U) == 0) continue;
      sum += options.block + block[first][last];
      first = last;
    }
    least = std::min(least, sum);
  }
  return least;
}

// The walls around a random set of cells in every layer, most of them whole, some of them seen in
// part, not at all or from the wrong side, and a little where no wall is.
Shares randomShares(const LineArrangement& plan, std::size_t num_layers, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Shares shares;
  std::vector<char> inside(plan.cells.size(), 0);
  for (std::size_t l = 0; l < num_layers; ++l) {
    if (l == 0 || unit(random) < 0.6) {
      for (std::size_t c = 0; c < inside.size(); ++c) {
        inside[c] = plan.at_border[c] == 0 && unit(random) < 0.6 ? 1 : 0;
      }
    }
    std::vector<double> layer;
    for (const PlanEdge& edge : plan.edges) {
      const int wall = inside[static_cast<std::size_t>(edge.behind)] -
                       inside[static_cast<std::size_t>(edge.ahead)];
      const double luck = unit(random);
      const double part = 2.0 * unit(random) - 1.0;
      layer.push_back(wall != 0 ? (luck < 0.6   ? wall
                                   : luck < 0.9 ? wall * part
                                                : 0.0)
                                : (luck < 0.1 ? 0.4 * part : 0.0));
    }
    shares.push_back(layer);
  }
  return shares;
}

std::vector<std::size_t> randomLevels(std::size_t num_layers, std::mt19937& random) {
  std::vector<std::size_t> levels = {0};
  for (std::size_t l = 0; l < num_layers; ++l) levels.push_back(levels.back() + 1 + random() % 5);
  return levels;
}

LineArrangement smallPlan(int round, std::mt19937& random) {
  const Eigen::Vector2d low(0.0, 0.0);
  const Eigen::Vector2d high(12.0, 10.0);
  if (round % 2 == 0) return arrangeLines(gridLines({2, 4, 7, 10}, {1, 3, 6, 8}), low, high, 1e-9);
  // Up to 12 cells inside: lines of any direction.
  std::uniform_real_distribution<double> angle(0.0, M_PI);
  std::uniform_real_distribution<double> x(3.0, 9.0);
  std::uniform_real_distribution<double> y(3.0, 7.0);
  while (true) {
    PlanLines lines;
    for (int i = 0; i < 7; ++i) lines.push_back(lineThrough({x(random), y(random)}, angle(random)));
    const LineArrangement plan = arrangeLines(lines, low, high, 1e-9);
    const auto free = std::count(plan.at_border.begin(), plan.at_border.end(), 0);
    if (free >= 4 && free <= 11) return plan;
  }
}

TEST(LabelCells, IsTheMinimumOverAllLabelingsAndAllPartitions) {
  std::mt19937 random(1);
  std::vector<int> with_blocks(7, 0);
  for (int round = 0; round < 60; ++round) {
    const LineArrangement plan = smallPlan(round, random);
    const std::size_t num_layers = 1 + random() % 6;
    const std::vector<std::size_t> levels = randomLevels(num_layers, random);
    const Shares shares = randomShares(plan, num_layers, random);
    CellEnergyOptions options;
    options.gap = std::uniform_real_distribution<double>(0.1, 1.0)(random);
    options.block = std::uniform_real_distribution<double>(0.0, 20.0)(random);
    const auto blocks = labelCells(plan, evidenceOf(plan, shares, levels), levels, {}, options);
    ASSERT_FALSE(blocks.empty());
    ++with_blocks[blocks.size()];
    double energy = 0.0;
    std::size_t layer = 0;
    for (const CellBlock& block : blocks) {
      ASSERT_EQ(block.first_bin, levels[layer]);
      std::size_t last = layer;
      while (levels[last] != block.last_bin) ASSERT_LT(++last, levels.size());
      ASSERT_EQ(block.inside.size(), plan.cells.size());
      for (std::size_t c = 0; c < plan.cells.size(); ++c) {
        EXPECT_TRUE(plan.at_border[c] == 0 || block.inside[c] == 0);
      }
      const double own = energyOf(plan, shares, levels, layer, last, options.gap, block.inside);
      EXPECT_NEAR(block.energy, own, 1e-4);
      energy += options.block + own;
      layer = last;
    }
    EXPECT_EQ(layer, num_layers);
    const double least = leastOfAll(plan, shares, levels, options);
    // Seen areas are floats: good to 1e-7 of all wall area, some hundreds.
    EXPECT_NEAR(energy, least, 1e-4) << "round " << round;
  }
  EXPECT_GT(with_blocks[1], 0);
  EXPECT_GT(with_blocks[2], 0);
  EXPECT_GT(with_blocks[3], 0);
  EXPECT_GT(with_blocks[4] + with_blocks[5] + with_blocks[6], 0) << "few blocks: weak cases";
}

TEST(MinimumCut, IsTheMinimumOfAllLabelingsThatTiedEdgesAllow) {
  // Costs in small whole numbers: many labelings have the least energy.
  std::mt19937 random(2);
  int constrained = 0;
  for (int round = 0; round < 60; ++round) {
    const LineArrangement plan = smallPlan(round, random);
    detail::CellTerms terms;
    std::vector<char> tied;
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      terms.area.push_back(static_cast<double>(random() % 4));
      const auto part = static_cast<double>(random() % 3) - 1.0;
      terms.signed_area.push_back(part * terms.area[e]);
      tied.push_back(round % 3 == 0 && random() % 4 == 0 ? 1 : 0);
    }
    for (std::size_t c = 0; c < plan.cells.size(); ++c) {
      terms.unary.push_back(static_cast<double>(random() % 5) - 2.0);
    }
    double least = std::numeric_limits<double>::infinity();
    double least_untied = least;
    std::ptrdiff_t fewest = 0;
    forAllInsides(plan, [&](const std::vector<char>& inside) {
      double energy = 0.0;
      bool allowed = true;
      for (std::size_t c = 0; c < inside.size(); ++c) energy += inside[c] * terms.unary[c];
      for (std::size_t e = 0; e < plan.edges.size(); ++e) {
        const int ahead = inside[static_cast<std::size_t>(plan.edges[e].ahead)];
        const int behind = inside[static_cast<std::size_t>(plan.edges[e].behind)];
        energy += terms.signed_area[e] * (ahead - behind);
        if (ahead == behind) continue;
        energy += 0.5 * (terms.area[e] - std::abs(terms.signed_area[e]));
        allowed = allowed && tied[e] == 0;
      }
      least_untied = std::min(least_untied, energy);
      if (!allowed || energy > least) return;
      const auto count = std::count(inside.begin(), inside.end(), 1);
      fewest = energy < least ? count : std::min(fewest, count);
      least = energy;
    });
    detail::LabelCut cut(plan, terms, 0.5);
    if (round % 2 == 0) cut.solve();  // goes on from there, or starts with the ties
    for (std::size_t e = 0; e < tied.size(); ++e) {
      if (tied[e] != 0) cut.tie(e);
    }
    const std::vector<char> inside = cut.solve();
    EXPECT_NEAR(energyOf(plan, terms, 0.5, inside), least, 1e-6) << "round " << round;
    EXPECT_EQ(std::count(inside.begin(), inside.end(), 1), fewest) << "round " << round;
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      EXPECT_TRUE(tied[e] == 0 || inside[static_cast<std::size_t>(plan.edges[e].ahead)] ==
                                      inside[static_cast<std::size_t>(plan.edges[e].behind)]);
    }
    if (least > least_untied) ++constrained;
  }
  EXPECT_GT(constrained, 5) << "ties that bind nothing test nothing";
}

// --- single cases -------------------------------------------------------------------------------

const Eigen::Vector2d kLow(0.0, 0.0);
const Eigen::Vector2d kHigh(14.0, 14.0);

// The walls around the cells that `inside` holds for, whole.
template <typename Inside>
std::vector<double> wallsAround(const LineArrangement& plan, const Inside& inside) {
  std::vector<double> shares;
  for (const PlanEdge& edge : plan.edges) {
    const auto at = [&](int cell) {
      return inside(middleOf(plan.cells[static_cast<std::size_t>(cell)])) ? 1.0 : 0.0;
    };
    shares.push_back(at(edge.behind) - at(edge.ahead));
  }
  return shares;
}

std::vector<char> cellsWhere(const LineArrangement& plan,
                             const std::function<bool(const Eigen::Vector2d&)>& inside) {
  std::vector<char> cells;
  for (const PlanCell& cell : plan.cells) cells.push_back(inside(middleOf(cell)) ? 1 : 0);
  return cells;
}

TEST(LabelCells, AMissingWallIsClosedAndItsCoverageIsZero) {
  const LineArrangement plan = arrangeLines(gridLines({2, 12}, {2, 12}), kLow, kHigh, 1e-9);
  const auto in_box = [](const Eigen::Vector2d& p) {
    return (p.array() > 2.0).all() && (p.array() < 12.0).all();
  };
  std::vector<double> shares = wallsAround(plan, in_box);
  std::size_t missing = 0;
  while (shares[missing] == 0.0) ++missing;
  shares[missing] = 0.0;
  const std::vector<std::size_t> levels = {0, 8};
  const auto blocks = labelCells(plan, evidenceOf(plan, {shares}, levels), levels, {}, {});
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].inside, cellsWhere(plan, in_box));
  ASSERT_EQ(blocks[0].coverage.size(), plan.edges.size());
  for (std::size_t e = 0; e < shares.size(); ++e) {
    EXPECT_NEAR(blocks[0].coverage[e], shares[e], 1e-6);
  }
}

TEST(LabelCells, RoofsDecideWhereWallsDoNot) {
  // One wall of four was seen: closing the cell costs 3 x 0.5 walls and gains one.
  const LineArrangement plan = arrangeLines(gridLines({2, 12}, {2, 12}), kLow, kHigh, 1e-9);
  const std::size_t middle = cellAt(plan, {7.0, 7.0});
  std::vector<double> shares(plan.edges.size(), 0.0);
  for (std::size_t e = 0; e < shares.size(); ++e) {
    if (plan.edges[e].behind == static_cast<int>(middle)) shares[e] = 1.0;
    if (shares[e] != 0.0) break;
  }
  const std::vector<std::size_t> levels = {0, 8};
  const WallEvidence evidence = evidenceOf(plan, {shares}, levels);
  const auto insideWith = [&](double z, bool up) {
    std::vector<LevelPoint> points;
    for (int i = 0; i < 100; ++i) points.push_back({{3.0 + 0.08 * i, 7.0}, z, up});
    CellEnergyOptions options;
    options.level = 1.0;
    const auto blocks = labelCells(plan, evidence, levels, points, options);
    return blocks.size() == 1 && blocks[0].inside[middle] != 0;
  };
  const auto blocks = labelCells(plan, evidence, levels, {}, {});
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].inside[middle], 0);
  EXPECT_TRUE(insideWith(8 * kBin, true));    // a roof above
  EXPECT_FALSE(insideWith(0.0, true));        // a terrace below
  EXPECT_TRUE(insideWith(0.0, false));        // the underside of what is above
  EXPECT_FALSE(insideWith(8 * kBin, false));  // an overhang
}

TEST(LabelCells, ABlockMustExplainMoreWallThanItCosts) {
  // A tower of 4 on half of a box of 4. As one block either the wall between, seen above alone, or
  // those of the other half, seen below alone, are not explained: 40 in area and more.
  const LineArrangement plan = arrangeLines(gridLines({2, 7, 12}, {2, 12}), kLow, kHigh, 1e-9);
  const auto below = [](const Eigen::Vector2d& p) {
    return (p.array() > 2.0).all() && (p.array() < 12.0).all();
  };
  const auto above = [&](const Eigen::Vector2d& p) { return below(p) && p.x() < 7.0; };
  const Shares shares = {wallsAround(plan, below), wallsAround(plan, above)};
  const std::vector<std::size_t> levels = {0, 8, 16};
  const WallEvidence evidence = evidenceOf(plan, shares, levels);
  CellEnergyOptions options;
  options.block = 1.0;
  const auto cheap = labelCells(plan, evidence, levels, {}, options);
  ASSERT_EQ(cheap.size(), 2U);
  EXPECT_EQ(cheap[0].inside, cellsWhere(plan, below));
  EXPECT_EQ(cheap[1].inside, cellsWhere(plan, above));
  EXPECT_EQ(cheap[0].last_bin, 8U);
  EXPECT_EQ(cheap[1].first_bin, 8U);
  options.block = 1000.0;
  EXPECT_EQ(labelCells(plan, evidence, levels, {}, options).size(), 1U);
}

TEST(LabelCells, NoLayersGiveNoBlocks) {
  const LineArrangement plan = arrangeLines(gridLines({2, 12}, {2, 12}), kLow, kHigh, 1e-9);
  EXPECT_TRUE(labelCells(plan, {}, {}, {}, {}).empty());
  EXPECT_TRUE(labelCells(plan, {}, {0}, {}, {}).empty());
}

}  // namespace
