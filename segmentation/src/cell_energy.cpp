// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/cell_energy.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kForbidden = 10.0;  // of the sum of all costs: more than anything else is worth

bool holds(const PlanCell& cell, const Eigen::Vector2d& p) {
  const std::size_t n = cell.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d a = cell.corners[(i + 1) % n] - cell.corners[i];
    const Eigen::Vector2d b = p - cell.corners[i];
    if (a.x() * b.y() - a.y() * b.x() < 0.0) return false;
  }
  return true;
}

// The cell of each horizontal point, by a coarse grid of candidate cells.
std::vector<std::vector<const LevelPoint*>> pointsByCell(const LineArrangement& plan,
                                                         const std::vector<LevelPoint>& points) {
  std::vector<std::vector<const LevelPoint*>> by_cell(plan.cells.size());
  if (points.empty()) return by_cell;
  constexpr int kGrid = 128;
  Eigen::Vector2d low = plan.cells.front().corners.front();
  Eigen::Vector2d high = low;
  for (const PlanCell& cell : plan.cells) {
    for (const Eigen::Vector2d& corner : cell.corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const Eigen::Vector2d step = (high - low) / kGrid;
  const auto indexOf = [&](const Eigen::Vector2d& p, int axis) {
    return std::clamp(static_cast<int>((p[axis] - low[axis]) / step[axis]), 0, kGrid - 1);
  };
  std::vector<std::vector<int>> candidates(kGrid * kGrid);
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    Eigen::Vector2d a = plan.cells[c].corners.front();
    Eigen::Vector2d b = a;
    for (const Eigen::Vector2d& corner : plan.cells[c].corners) {
      a = a.cwiseMin(corner);
      b = b.cwiseMax(corner);
    }
    for (int y = indexOf(a, 1); y <= indexOf(b, 1); ++y) {
      for (int x = indexOf(a, 0); x <= indexOf(b, 0); ++x) {
        candidates[static_cast<std::size_t>(y * kGrid + x)].push_back(static_cast<int>(c));
      }
    }
  }
  for (const LevelPoint& p : points) {
    const auto g =
        static_cast<std::size_t>(indexOf(p.position, 1) * kGrid + indexOf(p.position, 0));
    for (const int c : candidates[g]) {
      if (!holds(plan.cells[static_cast<std::size_t>(c)], p.position)) continue;
      by_cell[static_cast<std::size_t>(c)].push_back(&p);
      break;
    }
  }
  return by_cell;
}

// A face up means solid below it and air above; a face down the reverse.
void addLevelTerms(const LineArrangement& plan,
                   const std::vector<std::vector<const LevelPoint*>>& by_cell, double z_low,
                   double z_high, double weight, CellTerms& terms) {
  double box_area = 0.0;
  for (const PlanCell& cell : plan.cells) box_area += cell.area;
  const double z = 0.5 * (z_low + z_high);
  const double scale = weight * (z_high - z_low) / (0.25 * std::sqrt(box_area));
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    double inside = 0.0;
    double outside = 0.0;
    for (const LevelPoint* p : by_cell[c]) ((p->z > z) == p->up ? inside : outside) += 1.0;
    if (inside + outside < 1.0) continue;
    terms.unary[c] += plan.cells[c].area * scale * (outside - inside) / (outside + inside);
  }
}

}  // namespace

void CellTerms::add(const CellTerms& other) {
  for (std::size_t i = 0; i < area.size(); ++i) {
    area[i] += other.area[i];
    signed_area[i] += other.signed_area[i];
  }
  for (std::size_t c = 0; c < unary.size(); ++c) unary[c] += other.unary[c];
}

CellTerms termsOfBins(const LineArrangement& plan, const WallEvidence& evidence, std::size_t first,
                      std::size_t last) {
  CellTerms terms;
  const std::size_t n = plan.edges.size();
  terms.area.resize(n);
  terms.signed_area.assign(n, 0.0);
  terms.unary.assign(plan.cells.size(), 0.0);
  const double height = evidence.bin * static_cast<double>(last - first);
  for (std::size_t e = 0; e < n; ++e) {
    terms.area[e] = plan.edges[e].length() * height;
    double& seen = terms.signed_area[e];
    for (std::size_t b = first; b < last; ++b) {
      seen += static_cast<double>(evidence.seen[e * evidence.num_bins + b]);
    }
    seen = std::clamp(seen, -terms.area[e], terms.area[e]);  // sums are rounded
  }
  return terms;
}

std::vector<CellTerms> termsOfLayers(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<std::size_t>& levels,
                                     const std::vector<LevelPoint>& level_points,
                                     double level_weight) {
  const auto by_cell = pointsByCell(plan, level_points);
  std::vector<CellTerms> layers;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    layers.push_back(termsOfBins(plan, evidence, levels[l], levels[l + 1]));
    addLevelTerms(plan, by_cell, evidence.heightOf(levels[l]), evidence.heightOf(levels[l + 1]),
                  level_weight, layers.back());
  }
  return layers;
}

LabelCut::LabelCut(const LineArrangement& plan, const CellTerms& terms, double gap)
    : plan_(&plan), tied_(plan.edges.size(), 0), flow_(plan.cells.size()) {
  double total = 1e-300;
  for (const double a : terms.area) total += a;
  for (const double u : terms.unary) total += std::abs(u);
  const double scale = 1e12 / total;  // energies as integers: exact sums, the same on any machine
  const auto integer = [&](double value) {
    return static_cast<MaxFlow::Capacity>(std::llround(value * scale));
  };
  forbidden_ = integer(kForbidden * total);
  flow_.reserve(plan.edges.size());
  std::vector<double> unary = terms.unary;  // cost of being inside
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    unary[static_cast<std::size_t>(edge.ahead)] += terms.signed_area[e];
    unary[static_cast<std::size_t>(edge.behind)] -= terms.signed_area[e];
    const auto guess = integer(gap * (terms.area[e] - std::abs(terms.signed_area[e])));
    flow_.addEdge(static_cast<std::size_t>(edge.behind), static_cast<std::size_t>(edge.ahead),
                  guess, guess);
  }
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    // Source side = inside: pays `to_sink` there, `from_source` on the other side.
    const double cost = plan.at_border[c] != 0 ? kForbidden * total : unary[c];
    flow_.addTerminalCapacities(c, cost < 0.0 ? integer(-cost) : 0, cost > 0.0 ? integer(cost) : 0);
  }
}

void LabelCut::tie(std::size_t edge) {
  if (tied_[edge] != 0) return;
  tied_[edge] = 1;
  flow_.addEdge(static_cast<std::size_t>(plan_->edges[edge].behind),
                static_cast<std::size_t>(plan_->edges[edge].ahead), forbidden_, forbidden_);
}

std::vector<char> LabelCut::solve() {
  flow_.solve();
  std::vector<char> inside(plan_->cells.size());
  for (std::size_t c = 0; c < inside.size(); ++c) inside[c] = flow_.inSourceSide(c) ? 1 : 0;
  return inside;
}

double minimumCut(const LineArrangement& plan, const CellTerms& terms, double gap,
                  std::vector<char>& inside) {
  inside = LabelCut(plan, terms, gap).solve();
  return energyOf(plan, terms, gap, inside);
}

double energyOf(const LineArrangement& plan, const CellTerms& terms, double gap,
                const std::vector<char>& inside) {
  double energy = 0.0;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    if (inside[c] != 0) energy += terms.unary[c];
  }
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const int ahead = inside[static_cast<std::size_t>(plan.edges[e].ahead)];
    const int behind = inside[static_cast<std::size_t>(plan.edges[e].behind)];
    if (ahead == behind) continue;
    energy += terms.signed_area[e] * (ahead - behind) +
              gap * (terms.area[e] - std::abs(terms.signed_area[e]));
  }
  return energy;
}

}  // namespace storey::detail
