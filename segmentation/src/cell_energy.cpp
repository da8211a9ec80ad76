// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/segmentation/detail/cell_energy.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kForbidden = 10.0;  // of the sum of all costs: more than anything else is worth
constexpr double kUnits = 1e12;      // of the cut, that the sum of all costs makes

bool holds(const PlanCell& cell, const Eigen::Vector2d& p) {
  const std::size_t n = cell.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d a = cell.corners[(i + 1) % n] - cell.corners[i];
    const Eigen::Vector2d b = p - cell.corners[i];
    if (a.x() * b.y() - a.y() * b.x() < 0.0) return false;
  }
  return true;
}

// Heights of the horizontal points in a cell, ascending: of those that look down, and up.
using LevelHeights = std::array<std::vector<double>, 2>;

// Finds the cell that a place is in, by a coarse grid of candidate cells.
class CellFinder {
 public:
  explicit CellFinder(const LineArrangement& plan) : plan_(plan), candidates_(kGrid * kGrid) {
    std::vector<PlanBox> boxes;
    PlanBox all;
    for (const PlanCell& cell : plan.cells) {
      boxes.emplace_back();
      for (const Eigen::Vector2d& corner : cell.corners) boxes.back().extend(corner);
      all.extend(boxes.back());
    }
    low_ = all.min();
    step_ = all.sizes() / kGrid;
    for (std::size_t c = 0; c < boxes.size(); ++c) {
      const Eigen::Vector2d from = boxes[c].min();
      const Eigen::Vector2d to = boxes[c].max();
      for (int y = indexOf(from, 1); y <= indexOf(to, 1); ++y) {
        for (int x = indexOf(from, 0); x <= indexOf(to, 0); ++x) {
          candidates_[static_cast<std::size_t>(y * kGrid + x)].push_back(c);
        }
      }
    }
  }

  // The number of cells if it is in none.
  std::size_t cellOf(const Eigen::Vector2d& p) const {
    for (const std::size_t c :
         candidates_[static_cast<std::size_t>(indexOf(p, 1) * kGrid + indexOf(p, 0))]) {
      if (holds(plan_.cells[c], p)) return c;
    }
    return plan_.cells.size();
  }

 private:
  using PlanBox = Eigen::AlignedBox2d;
  static constexpr int kGrid = 128;

  int indexOf(const Eigen::Vector2d& p, int axis) const {
    return static_cast<int>(std::clamp((p[axis] - low_[axis]) / step_[axis], 0.0, kGrid - 1.0));
  }

  const LineArrangement& plan_;
  Eigen::Vector2d low_;
  Eigen::Vector2d step_;
  std::vector<std::vector<std::size_t>> candidates_;
};

std::vector<LevelHeights> heightsByCell(const LineArrangement& plan,
                                        const std::vector<LevelPoint>& points,
                                        unsigned int threads) {
  std::vector<LevelHeights> by_cell(plan.cells.size());
  if (points.empty()) return by_cell;
  const CellFinder finder(plan);
  std::vector<std::size_t> cell_of(points.size());
  forEachChunk(points.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cell_of[i] = finder.cellOf(points[i].position);
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cell_of[i] == plan.cells.size()) continue;
    by_cell[cell_of[i]][points[i].up ? 1 : 0].push_back(points[i].z);
  }
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 16)
  for (std::ptrdiff_t c = 0; c < static_cast<std::ptrdiff_t>(by_cell.size()); ++c) {
    for (std::vector<double>& list : by_cell[static_cast<std::size_t>(c)]) {
      std::sort(list.begin(), list.end());
    }
  }
  return by_cell;
}

// A face up means solid below it and air above; a face down the reverse.
void addLevelTerms(const LineArrangement& plan, const std::vector<LevelHeights>& by_cell,
                   double z_low, double z_high, double weight, CellTerms& terms) {
  double box_area = 0.0;
  for (const PlanCell& cell : plan.cells) box_area += cell.area;
  const double z = 0.5 * (z_low + z_high);
  const double scale = weight * (z_high - z_low) / (0.25 * std::sqrt(box_area));
  const auto below = [z](const std::vector<double>& heights) {
    return static_cast<double>(std::upper_bound(heights.begin(), heights.end(), z) -
                               heights.begin());
  };
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const auto& [down, up] = by_cell[c];
    const auto all = static_cast<double>(down.size() + up.size());
    if (all < 1.0) continue;
    const double outside = static_cast<double>(down.size()) - below(down) + below(up);
    terms.unary[c] += plan.cells[c].area * scale * (2.0 * outside - all) / all;
  }
}

}  // namespace

double sumOfCosts(const CellTerms& terms) {
  double total = 1e-300;
  for (const double a : terms.area) total += a;
  for (const double u : terms.unary) total += std::abs(u);
  return total;
}

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
    if (evidence.beyond.empty()) continue;
    for (std::size_t b = first; b < last; ++b) {
      terms.area[e] += static_cast<double>(evidence.beyond[e * evidence.num_bins + b]);
    }
  }
  return terms;
}

std::vector<CellTerms> termsOfLayers(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<std::size_t>& levels,
                                     const std::vector<LevelPoint>& level_points,
                                     double level_weight, unsigned int threads) {
  const auto by_cell = heightsByCell(plan, level_points, threads);
  std::vector<CellTerms> layers(levels.size() - 1);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(layers.size()); ++i) {
    const auto l = static_cast<std::size_t>(i);
    layers[l] = termsOfBins(plan, evidence, levels[l], levels[l + 1]);
    addLevelTerms(plan, by_cell, evidence.heightOf(levels[l]), evidence.heightOf(levels[l + 1]),
                  level_weight, layers[l]);
  }
  return layers;
}

LabelCut::LabelCut(const LineArrangement& plan, const CellTerms& terms, double gap)
    : LabelCut(plan, terms, gap, sumOfCosts(terms)) {}

LabelCut::LabelCut(const LineArrangement& plan, const CellTerms& terms, double gap, double total)
    : plan_(&plan),
      gap_(gap),
      total_(total),
      tied_(plan.edges.size(), 0),
      flow_(plan.cells.size()) {
  std::vector<double> unary = terms.unary;  // cost of being inside
  flow_.reserve(plan.edges.size());
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const auto behind = static_cast<std::size_t>(plan.edges[e].behind);
    const auto ahead = static_cast<std::size_t>(plan.edges[e].ahead);
    const auto guess = integer(gap * (terms.area[e] - std::abs(terms.signed_area[e])));
    unary[ahead] += terms.signed_area[e];
    unary[behind] -= terms.signed_area[e];
    flow_.addEdge(behind, ahead, guess, guess);
  }
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    // Source side = inside: pays `to_sink` there, `from_source` on the other side.
    const auto cost = integer(plan.at_border[c] != 0 ? kForbidden * total : unary[c]);
    flow_.addTerminalCapacities(c, std::max<MaxFlow::Capacity>(-cost, 0),
                                std::max<MaxFlow::Capacity>(cost, 0));
  }
}

// Energies as integers: exact sums, the same on any machine.
MaxFlow::Capacity LabelCut::integer(double value) const {
  return static_cast<MaxFlow::Capacity>(std::llround(value * (kUnits / total_)));
}

void LabelCut::add(const LabelCut& other, const CellTerms& own, const CellTerms& others) {
  flow_.add(other.flow_);
  for (std::size_t e = 0; e < tied_.size(); ++e) {
    const double a = own.signed_area[e];
    const double b = others.signed_area[e];
    if (!(a * b < 0.0)) continue;  // what is seen adds up, and so does what is not
    const auto more = integer(gap_ * (std::abs(a) + std::abs(b) - std::abs(a + b)));
    flow_.raiseEdge(e, more, more);
  }
}

void LabelCut::tie(std::size_t edge) {
  if (tied_[edge] != 0) return;
  tied_[edge] = 1;
  const MaxFlow::Capacity forbidden = integer(kForbidden * total_);
  flow_.raiseEdge(edge, forbidden, forbidden);
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
