// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/cell_labels.h>
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kLeastDensity = 0.05;  // of the densest layer's

// What the points say about one layer, or several summed.
struct LayerTerms {
  std::vector<double> area;         // A_e
  std::vector<double> signed_area;  // a_e
  std::vector<double> unary;        // u_c

  void add(const LayerTerms& other) {
    for (std::size_t i = 0; i < area.size(); ++i) {
      area[i] += other.area[i];
      signed_area[i] += other.signed_area[i];
    }
    for (std::size_t c = 0; c < unary.size(); ++c) unary[c] += other.unary[c];
  }
};

// Density of the points on the walls of a layer: the median over the edges, weighted by points, so
// that it follows a density that falls with height.
double wallDensity(const std::vector<double>& difference, const std::vector<double>& area) {
  std::vector<std::pair<double, double>> values;  // density, weight
  double total = 0.0;
  for (std::size_t e = 0; e < area.size(); ++e) {
    const double d = std::abs(difference[e]);
    if (d <= 0.0 || area[e] <= 0.0) continue;
    values.emplace_back(d / area[e], d);
    total += d;
  }
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  for (const auto& [density, weight] : values) {
    sum += weight;
    if (sum >= 0.5 * total) return density;
  }
  return 0.0;
}

// Points ahead less points behind, for each edge over the bins.
std::vector<double> differences(const LineArrangement& plan, const WallEvidence& evidence,
                                std::size_t first, std::size_t last) {
  std::vector<double> difference(plan.edges.size(), 0.0);
  for (std::size_t e = 0; e < difference.size(); ++e) {
    for (std::size_t b = first; b < last; ++b) {
      difference[e] +=
          evidence.ahead[e * evidence.num_bins + b] - evidence.behind[e * evidence.num_bins + b];
    }
  }
  return difference;
}

// \param least_density below it points are outliers, not a sparse wall
LayerTerms wallTerms(const LineArrangement& plan, const WallEvidence& evidence, std::size_t first,
                     std::size_t last, double least_density) {
  LayerTerms terms;
  const std::size_t n = plan.edges.size();
  const std::vector<double> difference = differences(plan, evidence, first, last);
  terms.area.resize(n);
  terms.signed_area.resize(n);
  terms.unary.assign(plan.cells.size(), 0.0);
  const double height = evidence.bin * static_cast<double>(last - first);
  for (std::size_t e = 0; e < n; ++e) terms.area[e] = plan.edges[e].length() * height;
  const double density = std::max(least_density, wallDensity(difference, terms.area));
  for (std::size_t e = 0; e < n; ++e) {
    const double seen = density > 0.0 ? difference[e] / density : 0.0;
    terms.signed_area[e] = std::clamp(seen, -terms.area[e], terms.area[e]);
  }
  return terms;
}

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
                   double z_high, double weight, LayerTerms& terms) {
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

// The cheapest labelling of the cells; returns its energy.
double minimumCut(const LineArrangement& plan, const LayerTerms& terms, double gap,
                  std::vector<char>& inside) {
  double total = 1e-300;
  for (const double a : terms.area) total += a;
  for (const double u : terms.unary) total += std::abs(u);
  const double scale = 1e12 / total;  // energies as integers: exact sums, the same on any machine
  const auto integer = [&](double value) {
    return static_cast<MaxFlow::Capacity>(std::llround(value * scale));
  };
  const std::size_t n = plan.cells.size();
  std::vector<double> unary = terms.unary;  // cost of being inside
  MaxFlow flow(n);
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    unary[static_cast<std::size_t>(edge.ahead)] += terms.signed_area[e];
    unary[static_cast<std::size_t>(edge.behind)] -= terms.signed_area[e];
    const auto guess = integer(gap * (terms.area[e] - std::abs(terms.signed_area[e])));
    flow.addEdge(static_cast<std::size_t>(edge.behind), static_cast<std::size_t>(edge.ahead), guess,
                 guess);
  }
  for (std::size_t c = 0; c < n; ++c) {
    // Source side = inside: pays `to_sink` there, `from_source` on the other side.
    const double cost = plan.at_border[c] != 0 ? 10.0 * total : unary[c];
    flow.addTerminalCapacities(c, cost < 0.0 ? integer(-cost) : 0, cost > 0.0 ? integer(cost) : 0);
  }
  flow.solve();
  inside.resize(n);
  double energy = 0.0;
  for (std::size_t c = 0; c < n; ++c) {
    inside[c] = flow.inSourceSide(c) ? 1 : 0;
    if (inside[c] != 0) energy += unary[c];
  }
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    if (inside[static_cast<std::size_t>(edge.behind)] !=
        inside[static_cast<std::size_t>(edge.ahead)]) {
      energy += gap * (terms.area[e] - std::abs(terms.signed_area[e]));
    }
  }
  return energy;
}

}  // namespace

std::vector<CellBlock> labelCells(const LineArrangement& plan, const WallEvidence& evidence,
                                  const std::vector<std::size_t>& levels,
                                  const std::vector<LevelPoint>& level_points,
                                  const CellEnergyOptions& options) {
  if (levels.size() < 2) return {};
  const std::size_t num_layers = levels.size() - 1;
  const auto by_cell = pointsByCell(plan, level_points);
  // The density of the building as a whole, of which no layer of it has less than a small share.
  double overall = 0.0;
  for (std::size_t l = 0; l < num_layers; ++l) {
    const LayerTerms terms = wallTerms(plan, evidence, levels[l], levels[l + 1], 0.0);
    overall = std::max(
        overall, wallDensity(differences(plan, evidence, levels[l], levels[l + 1]), terms.area));
  }
  std::vector<LayerTerms> layers;
  for (std::size_t l = 0; l < num_layers; ++l) {
    layers.push_back(wallTerms(plan, evidence, levels[l], levels[l + 1], kLeastDensity * overall));
    addLevelTerms(plan, by_cell, evidence.heightOf(levels[l]), evidence.heightOf(levels[l + 1]),
                  options.level, layers.back());
  }
  // Dynamic programming over the partitions: best[k] is the least energy of the layers below k.
  std::vector<double> best(num_layers + 1, std::numeric_limits<double>::infinity());
  std::vector<CellBlock> last(num_layers + 1);
  std::vector<std::size_t> from(num_layers + 1, 0);
  best[0] = 0.0;
  for (std::size_t start = 0; start < num_layers; ++start) {
    LayerTerms sum = layers[start];
    for (std::size_t end = start + 1; end <= num_layers; ++end) {
      if (end > start + 1) sum.add(layers[end - 1]);
      std::vector<char> inside;
      const double energy =
          best[start] + options.block + minimumCut(plan, sum, options.gap, inside);
      if (energy >= best[end]) continue;
      best[end] = energy;
      from[end] = start;
      last[end] = {levels[start], levels[end], std::move(inside), {}};
      for (std::size_t e = 0; e < plan.edges.size(); ++e) {
        last[end].coverage.push_back(sum.area[e] > 0.0 ? sum.signed_area[e] / sum.area[e] : 0.0);
      }
    }
  }
  std::vector<CellBlock> blocks;
  for (std::size_t k = num_layers; k > 0; k = from[k]) blocks.push_back(std::move(last[k]));
  std::reverse(blocks.begin(), blocks.end());
  return blocks;
}

}  // namespace storey::detail
