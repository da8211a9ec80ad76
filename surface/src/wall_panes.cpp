// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/surface/detail/wall_panes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace storey::detail {
namespace {

constexpr double kStartDepths[] = {2.0, 4.0, -2.0, -4.0};
constexpr double kMinDepth = 1.2;  // deviations: below, two normals are like a wider one
constexpr double kMaxDepth = 8.0;
constexpr double kStartShare = 0.2;
constexpr double kMaxShare = 0.5;  // the wall is what most points are of
constexpr double kStartBackground = 0.05;
constexpr double kLeast = 1e-6;        // of shares, so that they can grow
constexpr double kPriorPoints = 20.0;  // a wall with few has the share that all have
constexpr double kMinDeviation = 0.3;  // noise deviations
constexpr double kConverged = 0.01;    // log-likelihood
constexpr int kMaxIterations = 300;
constexpr double kClear = 20.0;         // log-likelihood: panes that is really there,
constexpr double kClearPerWall = 2.0;   // beyond what chance gives each wall
constexpr double kRefuted = 5.0;        // log-likelihood: a wall that has its own scatter instead
constexpr std::ptrdiff_t kBeyond = 20;  // bins each side of the gate, where points are not seen
constexpr double kInvSqrt2Pi = 0.3989422804014327;

using Counts = ResidualHistogram;

// Densities of the three parts at a residual.
struct Parts {
  double wall, pane, background;
  double sum() const { return wall + pane + background; }
};

Parts partsAt(const WallPanes& panes, double u) {
  const double scale = 1.0 / panes.deviation;
  const double height = (1.0 - panes.background) * kInvSqrt2Pi * scale;
  const double of_wall = (u - panes.offset) * scale;
  const double of_pane = of_wall + panes.depth * scale;
  return {height * (1.0 - panes.share) * std::exp(-0.5 * of_wall * of_wall),
          panes.share > 0.0 ? height * panes.share * std::exp(-0.5 * of_pane * of_pane) : 0.0,
          panes.background / (2.0 * Counts::kGate)};
}

// Expected numbers and moments of the points of each part, and the likelihood of those seen.
struct Expectation {
  double wall = 0.0, wall_u = 0.0, wall_uu = 0.0;
  double pane = 0.0, pane_u = 0.0, pane_uu = 0.0;
  double background = 0.0;
  double likelihood = 0.0;

  void add(const Parts& parts, double u, double count) {
    const double scale = count / parts.sum();
    wall += scale * parts.wall;
    wall_u += scale * parts.wall * u;
    wall_uu += scale * parts.wall * u * u;
    pane += scale * parts.pane;
    pane_u += scale * parts.pane * u;
    pane_uu += scale * parts.pane * u * u;
    background += scale * parts.background;
  }
  double offset(double depth) const { return (wall_u + pane_u + depth * pane) / (wall + pane); }
  double squares(double a, double depth) const {
    const double b = a - depth;
    return wall_uu - 2.0 * a * wall_u + a * a * wall + pane_uu - 2.0 * b * pane_u + b * b * pane;
  }
};

constexpr auto kSeenBins = static_cast<std::ptrdiff_t>(Counts::kBins);
constexpr std::ptrdiff_t kAllBins = kSeenBins + 2 * kBeyond;

// exp(-((u - mean) / deviation)^2 / 2) in the middles of all bins. From one bin to the next the
// exponential changes by a ratio, and that by a constant one: so it takes few calls of exp.
class Bell {
 public:
  Bell(double mean, double deviation) {
    const double step = Counts::kWidth / deviation;
    const std::ptrdiff_t first =
        std::clamp(static_cast<std::ptrdiff_t>((mean + Counts::kGate) / Counts::kWidth) + kBeyond,
                   std::ptrdiff_t{0}, kAllBins - 1);
    const double off = (Counts::middleOf(first - kBeyond) - mean) / deviation;
    const double middle = std::exp(-0.5 * off * off);
    const double bend = std::exp(-step * step);
    double ratio = std::exp(-step * (off + 0.5 * step));
    double value = middle;
    for (std::ptrdiff_t b = first; b < kAllBins; ++b, ratio *= bend) {
      values_[static_cast<std::size_t>(b)] = value;
      value *= ratio;
    }
    ratio = std::exp(step * (off - 0.5 * step));
    value = middle;
    for (std::ptrdiff_t b = first; b-- > 0; ratio *= bend) {
      value *= ratio;
      values_[static_cast<std::size_t>(b)] = value;
    }
  }

  double operator[](std::ptrdiff_t bin) const {  // from -kBeyond on
    return values_[static_cast<std::size_t>(bin + kBeyond)];
  }

 private:
  std::array<double, static_cast<std::size_t>(kAllBins)> values_;
};

Expectation expect(const Counts& histogram, const WallPanes& panes) {
  const double height = (1.0 - panes.background) * kInvSqrt2Pi / panes.deviation;
  const Bell of_wall(panes.offset, panes.deviation);
  const Bell of_pane(panes.offset - panes.depth, panes.deviation);
  const double background = panes.background / (2.0 * Counts::kGate);
  Expectation sum;
  double seen = 0.0;
  for (std::ptrdiff_t b = 0; b < kSeenBins; ++b) {
    const double count = histogram.counts()[static_cast<std::size_t>(b)];
    const Parts parts{height * (1.0 - panes.share) * of_wall[b], height * panes.share * of_pane[b],
                      background};
    seen += parts.sum() * Counts::kWidth;
    if (count == 0.0) continue;
    sum.add(parts, Counts::middleOf(b), count);
    sum.likelihood += count * std::log(parts.sum());
  }
  sum.likelihood -= histogram.total() * std::log(seen);
  // Points beyond the gate are as many as the model says.
  const auto addUnseen = [&](std::ptrdiff_t b) {
    const Parts parts{height * (1.0 - panes.share) * of_wall[b], height * panes.share * of_pane[b],
                      0.0};
    if (parts.sum() < kLeast) return;
    sum.add(parts, Counts::middleOf(b), histogram.total() * parts.sum() * Counts::kWidth / seen);
  };
  for (std::ptrdiff_t b = 1; b <= kBeyond; ++b) {
    addUnseen(-b);
    addUnseen(kSeenBins - 1 + b);
  }
  return sum;
}

// One normal over the background: offset, deviation and background by EM. \return its likelihood
double fitNormal(const Counts& histogram, WallPanes& panes) {
  panes = WallPanes();
  panes.background = kStartBackground;
  double before = -INFINITY;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Expectation sum = expect(histogram, panes);
    if (sum.likelihood < before + kConverged) return sum.likelihood;
    before = sum.likelihood;
    panes.offset = sum.offset(0.0);
    panes.deviation = std::max(kMinDeviation, std::sqrt(sum.squares(panes.offset, 0.0) / sum.wall));
    panes.background = std::max(kLeast, sum.background / (sum.background + sum.wall));
  }
  return before;
}

// All walls with common depth and deviation.
struct Building {
  std::vector<WallPanes> walls;
  std::vector<double> likelihoods;

  double likelihood() const {
    double sum = 0.0;
    for (const double l : likelihoods) sum += l;
    return sum;
  }
};

// One step of EM: the wall's own values from its points, the common ones from all.
void improve(const std::vector<Expectation>& sums, Building& building) {
  double points = 0.0, panes = 0.0, set_back = 0.0, squares = 0.0;
  for (const Expectation& sum : sums) points += sum.wall + sum.pane, panes += sum.pane;
  const double common_share = panes / points;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    WallPanes& wall = building.walls[k];
    wall.offset = sums[k].offset(wall.depth);
    wall.share = std::clamp(
        (sums[k].pane + kPriorPoints * common_share) / (sums[k].pane + sums[k].wall + kPriorPoints),
        kLeast, kMaxShare);
    const double all = sums[k].wall + sums[k].pane + sums[k].background;
    wall.background = std::max(kLeast, sums[k].background / all);
    set_back += wall.offset * sums[k].pane - sums[k].pane_u;
  }
  const double sign = building.walls.front().depth < 0.0 ? -1.0 : 1.0;
  const double depth =
      sign * std::clamp(sign * set_back / std::max(panes, kLeast), kMinDepth, kMaxDepth);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    squares += sums[k].squares(building.walls[k].offset, depth);
  }
  const double deviation = std::max(kMinDeviation, std::sqrt(squares / points));
  for (WallPanes& wall : building.walls) wall.depth = depth, wall.deviation = deviation;
}

Building fitBuilding(const std::vector<Counts>& histograms, Building building) {
  double before = -INFINITY;
  for (int i = 0; i < kMaxIterations; ++i) {
    std::vector<Expectation> sums;
    building.likelihoods.clear();
    for (std::size_t k = 0; k < histograms.size(); ++k) {
      sums.push_back(expect(histograms[k], building.walls[k]));
      building.likelihoods.push_back(sums.back().likelihood);
    }
    if (building.likelihood() < before + kConverged) break;
    before = building.likelihood();
    improve(sums, building);
  }
  return building;
}

Building fitFrom(const std::vector<Counts>& histograms, const std::vector<WallPanes>& alone,
                 double depth) {
  Building start;
  start.walls = alone;
  for (WallPanes& wall : start.walls) {
    wall.share = kStartShare;
    wall.depth = depth;
    wall.offset += kStartShare * depth;
    wall.deviation = 1.0;
  }
  return fitBuilding(histograms, std::move(start));
}

// Fisher's information on offset and share, from the points themselves.
void setInformation(const Counts& histogram, WallPanes& panes) {
  double offset = 0.0, share = 0.0, both = 0.0;
  for (std::size_t b = 0; b < Counts::kBins; ++b) {
    const double u = Counts::middleOf(static_cast<std::ptrdiff_t>(b)) - panes.offset;
    const Parts parts = partsAt(panes, u + panes.offset);
    const double by_offset = (parts.wall * u + parts.pane * (u + panes.depth)) /
                             (parts.sum() * panes.deviation * panes.deviation);
    const double by_share =
        (parts.pane / panes.share - parts.wall / (1.0 - panes.share)) / parts.sum();
    offset += histogram.counts()[b] * by_offset * by_offset;
    share += histogram.counts()[b] * by_share * by_share;
    both += histogram.counts()[b] * by_offset * by_share;
  }
  panes.information = offset;
  panes.offset_deviation = 1.0 / std::sqrt(offset - both * both / share);
}

}  // namespace

void ResidualHistogram::add(double residual) {
  if (!(std::abs(residual) < kGate)) return;
  const auto bin = static_cast<std::size_t>((residual + kGate) / kWidth);
  counts_[std::min(bin, kBins - 1)] += 1.0;
  total_ += 1.0;
}

ResidualHistogram& ResidualHistogram::operator+=(const ResidualHistogram& other) {
  for (std::size_t b = 0; b < kBins; ++b) counts_[b] += other.counts_[b];
  total_ += other.total_;
  return *this;
}

WallPanes::Expected WallPanes::expected(double residual) const {
  const Parts parts = partsAt(*this, residual);
  const double own = parts.wall + parts.pane;
  if (!(own > 0.0)) return {0.0, residual};
  return {own / parts.sum(), residual + depth * parts.pane / own};
}

std::vector<WallPanes> fitPanes(const std::vector<ResidualHistogram>& walls, unsigned int threads) {
  if (walls.empty()) return {};
  std::vector<WallPanes> alone(walls.size());
  std::vector<double> likelihoods;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    likelihoods.push_back(fitNormal(walls[k], alone[k]));
  }
  std::array<Building, std::size(kStartDepths)> buildings;
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(buildings.size()); ++i) {
    const auto k = static_cast<std::size_t>(i);
    buildings[k] = fitFrom(walls, alone, kStartDepths[k]);
  }
  Building best;
  for (Building& building : buildings) {
    if (best.walls.empty() || building.likelihood() > best.likelihood()) best = std::move(building);
  }
  // Walls that are rough in their own way must not blur what the others have in common.
  std::vector<std::size_t> alike;
  std::vector<Counts> histograms;
  Building rest;
  for (std::size_t k = 0; k < best.walls.size(); ++k) {
    if (best.likelihoods[k] < likelihoods[k] - kRefuted) continue;
    alike.push_back(k);
    histograms.push_back(walls[k]);
    rest.walls.push_back(best.walls[k]);
  }
  if (alike.empty()) return {};
  rest = fitBuilding(histograms, std::move(rest));
  double gain = 0.0;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    gain += rest.likelihoods[i] - likelihoods[alike[i]];
    alone[alike[i]] = rest.walls[i];
    alone[alike[i]].in_use = true;
    setInformation(walls[alike[i]], alone[alike[i]]);
  }
  if (gain < kClear + kClearPerWall * static_cast<double>(alike.size())) return {};
  return alone;
}

}  // namespace storey::detail
