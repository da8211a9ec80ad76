// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "plans.h"

/// Blocks of cells and what is seen of their walls, for the tests of what simplifies them.
namespace storey::test {

using detail::CellBlock;

constexpr double kGap = 0.5;
constexpr double kExact = 1e-6;  // of areas of some hundreds: energies are cut as integers

using Shape = std::function<bool(const Eigen::Vector2d&)>;

/// The walls around a shape as they are seen: +1 where its outside is ahead of the line.
inline std::vector<double> wallsAround(const LineArrangement& plan, const Shape& shape) {
  std::vector<double> shares;
  for (const PlanEdge& edge : plan.edges) {
    const auto in = [&](int cell) {
      return shape(middleOf(plan.cells[static_cast<std::size_t>(cell)])) ? 1.0 : 0.0;
    };
    shares.push_back(in(edge.behind) - in(edge.ahead));
  }
  return shares;
}

inline std::vector<char> cellsOf(const LineArrangement& plan, const Shape& shape) {
  std::vector<char> inside;
  for (const PlanCell& cell : plan.cells) inside.push_back(shape(middleOf(cell)) ? 1 : 0);
  return inside;
}

inline Shape rectangle(double x0, double y0, double x1, double y1) {
  return [=](const Eigen::Vector2d& p) {
    return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1;
  };
}

/// A block whose edges are confirmed by these shares of their area, cut.
inline CellBlock blockOf(const LineArrangement& plan, const std::vector<double>& shares,
                         std::size_t first_bin, std::size_t last_bin, double bin) {
  CellBlock block;
  block.first_bin = first_bin;
  block.last_bin = last_bin;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const double area = plan.edges[e].length() * bin * static_cast<double>(last_bin - first_bin);
    block.terms.area.push_back(area);
    block.terms.signed_area.push_back(shares[e] * area);
  }
  block.terms.unary.assign(plan.cells.size(), 0.0);
  block.energy = detail::minimumCut(plan, block.terms, kGap, block.inside);
  block.measureCoverage();
  return block;
}

inline bool bounds(const PlanEdge& edge, const std::vector<char>& inside) {
  return inside[static_cast<std::size_t>(edge.behind)] !=
         inside[static_cast<std::size_t>(edge.ahead)];
}

/// E(x) as its header states it.
inline double energyOf(const LineArrangement& plan, const detail::CellTerms& terms,
                       const std::vector<char>& inside) {
  double sum = 0.0;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    if (!bounds(edge, inside)) continue;
    const double sign = inside[static_cast<std::size_t>(edge.ahead)] != 0 ? 1.0 : -1.0;
    sum += sign * terms.signed_area[e] + kGap * (terms.area[e] - std::abs(terms.signed_area[e]));
  }
  for (std::size_t c = 0; c < inside.size(); ++c) sum += inside[c] * terms.unary[c];
  return sum;
}

/// Stacks of blocks whose walls are those around random cells, seen in part.
inline std::vector<CellBlock> randomStack(const LineArrangement& plan, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<CellBlock> blocks;
  std::vector<char> inside(plan.cells.size(), 0);
  std::size_t bin = 0;
  for (std::size_t b = 0; b < 1 + random() % 3; ++b) {
    for (std::size_t c = 0; c < inside.size(); ++c) {
      const bool drawn = b == 0 || unit(random) < 0.3;
      if (drawn) inside[c] = plan.at_border[c] == 0 && unit(random) < 0.7 ? 1 : 0;
    }
    std::vector<double> shares;
    for (const PlanEdge& edge : plan.edges) {
      const int wall = inside[static_cast<std::size_t>(edge.behind)] -
                       inside[static_cast<std::size_t>(edge.ahead)];
      shares.push_back(wall * unit(random) + (unit(random) < 0.2 ? 0.3 * unit(random) - 0.15 : 0));
      shares.back() = std::clamp(shares.back(), -1.0, 1.0);
    }
    const std::size_t height = 1 + random() % 4;
    blocks.push_back(blockOf(plan, shares, bin, bin + height, 1.0));
    bin += height;
  }
  return blocks;
}

}  // namespace storey::test
