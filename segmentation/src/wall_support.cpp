// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGates[] = {6.0, 5.0, 4.5, 4.0};  // noise deviations, one a round
constexpr double kMinOccupancy = 0.3;              // of the expected points of a cell
constexpr int kMinFullNeighbors = 3;               // of eight
constexpr double kOn = 2.5;                        // noise deviations: nearly all points of a wall
constexpr double kBeside = 10.0;                   // noise deviations
constexpr double kMinOnShare = 0.4;  // of the points to either side; 0.25 of an even density
constexpr double kStray = 0.03;      // of the support, at either end
constexpr double kTilePoints = 50.0;
constexpr double kTileSpread = 0.5;             // noise deviations, relief that one wall may have
constexpr double kMaxInconsistentShare = 0.15;  // of the support
constexpr double kLeanDeviations = 4.0;         // of the slope of a run against the line
constexpr double kLean = 1.0;                   // noise deviations, over the length of the run
constexpr double kMinFlatShare = 0.7;           // of the support of a line with a locked direction
constexpr double kFlat = 0.6;     // noise deviations that the middle of a wall may be off its line
constexpr int kProfileBins = 24;  // along the wall, for the flatness

// Integer cells of (s, z) about a line, dense storage.
class CellGrid {
 public:
  CellGrid(double side, double s0, double s1, double z0, double z1)
      : side_(side),
        s0_(s0),
        z0_(z0),
        columns_(static_cast<std::ptrdiff_t>((s1 - s0) / side) + 1),
        rows_(static_cast<std::ptrdiff_t>((z1 - z0) / side) + 1) {}

  std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::ptrdiff_t columns() const { return columns_; }
  std::ptrdiff_t rows() const { return rows_; }
  std::size_t at(double s, double z) const {
    const auto c =
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((s - s0_) / side_), 0, columns_ - 1);
    const auto r =
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((z - z0_) / side_), 0, rows_ - 1);
    return static_cast<std::size_t>(r * columns_ + c);
  }
  double left(std::ptrdiff_t column) const { return s0_ + side_ * static_cast<double>(column); }

 private:
  double side_, s0_, z0_;
  std::ptrdiff_t columns_, rows_;
};

struct Box {
  double s0 = std::numeric_limits<double>::infinity();
  double s1 = -s0;
  double z0 = s0;
  double z1 = -s0;
};

Box boxOf(const std::vector<WallPoint>& points, const std::vector<int>& indices,
          const WallLine& line) {
  Box box;
  for (const int i : indices) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    const double s = line.along(p.position);
    box.s0 = std::min(box.s0, s);
    box.s1 = std::max(box.s1, s);
    box.z0 = std::min(box.z0, p.z);
    box.z1 = std::max(box.z1, p.z);
  }
  return box;
}

std::vector<int> withinGate(const std::vector<WallPoint>& points, const std::vector<int>& indices,
                            const WallLine& line, double gate) {
  std::vector<int> near;
  for (const int i : indices) {
    if (std::abs(line.across(points[static_cast<std::size_t>(i)].position)) < gate) {
      near.push_back(i);
    }
  }
  return near;
}

// Points in cells that are filled well enough and not alone.
std::vector<int> inFullCells(const std::vector<WallPoint>& points, const std::vector<int>& near,
                             const WallScale& scale, const WallLine& line) {
  if (near.empty()) return {};
  const Box box = boxOf(points, near, line);
  const double side = supportCellSize(scale);
  const CellGrid grid(side, box.s0, box.s1, box.z0, box.z1);
  std::vector<int> count(grid.size(), 0);
  for (const int i : near) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    ++count[grid.at(line.along(p.position), p.z)];
  }
  const double least = std::max(1.0, kMinOccupancy * scale.density * side * side);
  const auto full = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
    return c >= 0 && r >= 0 && c < grid.columns() && r < grid.rows() &&
           count[static_cast<std::size_t>(r * grid.columns() + c)] >= least;
  };
  std::vector<char> kept(grid.size(), 0);
  for (std::ptrdiff_t r = 0; r < grid.rows(); ++r) {
    for (std::ptrdiff_t c = 0; c < grid.columns(); ++c) {
      if (!full(c, r)) continue;
      int neighbors = -1;
      for (std::ptrdiff_t dr = -1; dr <= 1; ++dr) {
        for (std::ptrdiff_t dc = -1; dc <= 1; ++dc) neighbors += full(c + dc, r + dr) ? 1 : 0;
      }
      kept[static_cast<std::size_t>(r * grid.columns() + c)] = neighbors >= kMinFullNeighbors;
    }
  }
  std::vector<int> result;
  for (const int i : near) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    if (kept[grid.at(line.along(p.position), p.z)] != 0) result.push_back(i);
  }
  return result;
}

// Two parallel walls a few deviations apart, at different places or heights, are told apart by the
// medians of tiles: keeps the points of the tiles whose medians agree with most others.
std::vector<int> inMainTiles(const std::vector<WallPoint>& points, const std::vector<int>& support,
                             const WallScale& scale, const WallLine& line) {
  if (static_cast<double>(support.size()) < 4.0 * kTilePoints) return support;
  const Box box = boxOf(points, support, line);
  const double side = std::sqrt(kTilePoints / scale.density);
  const CellGrid grid(side, box.s0, box.s1, box.z0, box.z1);
  std::vector<std::vector<double>> residuals(grid.size());
  for (const int i : support) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    residuals[grid.at(line.along(p.position), p.z)].push_back(line.across(p.position));
  }
  std::vector<double> medians(grid.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::pair<double, std::size_t>> sorted;  // median, points
  for (std::size_t t = 0; t < residuals.size(); ++t) {
    std::vector<double>& r = residuals[t];
    if (r.size() < 5) continue;
    std::nth_element(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(r.size() / 2), r.end());
    medians[t] = r[r.size() / 2];
    sorted.emplace_back(medians[t], r.size());
  }
  if (sorted.empty()) return support;
  std::sort(sorted.begin(), sorted.end());
  const double reach =
      scale.noise * (kTileSpread + 3.0 * 1.25 / std::sqrt(kTilePoints));  // of a median
  std::size_t best = 0;
  std::size_t held = 0;
  double center = 0.0;
  for (std::size_t i = 0, j = 0; i < sorted.size(); ++i) {
    for (; j < sorted.size() && sorted[j].first - sorted[i].first <= 2.0 * reach; ++j) {
      held += sorted[j].second;
    }
    if (held > best) {
      best = held;
      center = 0.5 * (sorted[i].first + sorted[j - 1].first);
    }
    held -= sorted[i].second;
  }
  std::vector<int> kept;
  for (const int i : support) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    if (std::abs(medians[grid.at(line.along(p.position), p.z)] - center) <= 1.5 * reach) {
      kept.push_back(i);
    }
  }
  return kept;
}

// Tukey-weighted least squares of d over s. The line turns about the centre of its points.
void fitLine(const std::vector<WallPoint>& points, const std::vector<int>& support, double cut,
             bool fit_direction, WallLine& line) {
  double w = 0.0, ws = 0.0, wd = 0.0, wss = 0.0, wsd = 0.0, wdd = 0.0;
  const Eigen::Vector2d origin = points[static_cast<std::size_t>(support.front())].position;
  for (const int i : support) {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)].position;
    const double d = line.across(p);
    const double u = d / cut;
    if (std::abs(u) >= 1.0) continue;
    const double weight = (1.0 - u * u) * (1.0 - u * u);
    const double s = line.along(p - origin);
    w += weight;
    ws += weight * s;
    wd += weight * d;
    wss += weight * s * s;
    wsd += weight * s * d;
    wdd += weight * d * d;
  }
  if (!(w > 0.0)) return;
  const double spread = wss - ws * ws / w;
  const double variance = std::max(0.0, wdd - wd * wd / w) / w;
  line.residual = std::sqrt(variance);
  line.angle_deviation = spread > 0.0 ? std::sqrt(variance / spread) : M_PI;
  const double slope = fit_direction && spread > 0.0 ? (wsd - ws * wd / w) / spread : 0.0;
  const Eigen::Vector2d center = origin + (ws / w) * line.tangent() +
                                 (line.offset + wd / w - line.normal.dot(origin)) * line.normal;
  line.normal = (line.normal - slope * line.tangent()).normalized();
  line.offset = line.normal.dot(center);
}

// Mean residuals along the wall; a wall is flat if few points lie where the mean is off.
struct Profile {
  std::vector<double> sum;
  std::vector<double> count;
  double s0 = 0.0;
  double step = 1.0;
};

bool isFlat(const Profile& profile, double noise, int first, int last) {
  // Flat about a line of its own: the mean level of the window is taken out.
  double total = 0.0;
  double level = 0.0;
  for (int b = first; b < last; ++b) {
    total += profile.count[static_cast<std::size_t>(b)];
    level += profile.sum[static_cast<std::size_t>(b)];
  }
  if (!(total > 0.0)) return false;
  level /= total;
  double off = 0.0;
  for (int b = first; b < last; ++b) {
    const double n = profile.count[static_cast<std::size_t>(b)];
    if (n < 1.0) continue;
    const double mean = profile.sum[static_cast<std::size_t>(b)] / n - level;
    if (std::abs(mean) > noise * (kFlat + 3.0 / std::sqrt(n))) off += n;
  }
  return off <= kMaxInconsistentShare * total;
}

std::vector<int> flatStretch(const std::vector<WallPoint>& points, const std::vector<int>& support,
                             const WallScale& scale, const WallLine& line) {
  const Box box = boxOf(points, support, line);
  Profile profile;
  profile.s0 = box.s0;
  profile.step = std::max((box.s1 - box.s0) / kProfileBins, 1e-12);
  profile.sum.assign(kProfileBins, 0.0);
  profile.count.assign(kProfileBins, 0.0);
  const auto binOf = [&](int i) {
    const double s = line.along(points[static_cast<std::size_t>(i)].position);
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>((s - profile.s0) / profile.step), 0, kProfileBins - 1));
  };
  for (const int i : support) {
    profile.sum[binOf(i)] += line.across(points[static_cast<std::size_t>(i)].position);
    profile.count[binOf(i)] += 1.0;
  }
  if (isFlat(profile, scale.noise, 0, kProfileBins)) return support;
  for (const int parts : {2, 3, 4, 6, 8, 12}) {
    const int width = kProfileBins / parts;
    double best = 0.0;
    int best_first = -1;
    for (int first = 0; first + width <= kProfileBins; ++first) {
      if (!isFlat(profile, scale.noise, first, first + width)) continue;
      double held = 0.0;
      for (int b = first; b < first + width; ++b)
        held += profile.count[static_cast<std::size_t>(b)];
      if (held > best) {
        best = held;
        best_first = first;
      }
    }
    if (best_first < 0) continue;
    std::vector<int> kept;
    for (const int i : support) {
      const int b = static_cast<int>(binOf(i));
      if (b >= best_first && b < best_first + width) kept.push_back(i);
    }
    return kept;
  }
  return {};
}

// Walls of nearly the same direction further on lie near the line too, and turn it by their long
// lever. Keeps the points of the bins that agree with the line through the fuller half of them.
std::vector<int> alongMainHalf(const std::vector<WallPoint>& points,
                               const std::vector<int>& support, const WallScale& scale,
                               const WallLine& line) {
  struct Bin {
    double n = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0;
    void add(const Bin& b) { n += b.n, s += b.s, d += b.d, ss += b.ss, sd += b.sd; }
  };
  const Box box = boxOf(points, support, line);
  const double step = std::max((box.s1 - box.s0) / kProfileBins, 1e-12);
  std::array<Bin, kProfileBins> bins;
  const auto binOf = [&](int i) {
    const double s = line.along(points[static_cast<std::size_t>(i)].position) - box.s0;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(s / step), 0, kProfileBins - 1));
  };
  for (const int i : support) {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)].position;
    const double s = line.along(p) - box.s0;
    const double d = line.across(p);
    bins[binOf(i)].add({1.0, s, d, s * s, s * d});
  }
  Bin main;
  for (std::size_t first = 0; first + kProfileBins / 2 <= kProfileBins; ++first) {
    Bin half;
    for (std::size_t b = first; b < first + kProfileBins / 2; ++b) half.add(bins[b]);
    if (half.n > main.n) main = half;
  }
  const double spread = main.ss - main.s * main.s / main.n;
  if (!(spread > 0.0)) return support;
  const double slope = (main.sd - main.s * main.d / main.n) / spread;
  std::array<bool, kProfileBins> agrees;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (bins[b].n < 1.0) continue;
    const double lever = bins[b].s / bins[b].n - main.s / main.n;
    const double off = std::abs(bins[b].d / bins[b].n - main.d / main.n - slope * lever);
    const double variance = 1.0 / bins[b].n + 1.0 / main.n + lever * lever / spread;
    agrees[b] = off <= scale.noise * (kFlat + 3.0 * std::sqrt(variance));
  }
  std::vector<int> kept;
  for (const int i : support) {
    if (agrees[binOf(i)]) kept.push_back(i);
  }
  return kept;
}

using Runs = std::vector<std::pair<double, double>>;

// Stretches along the line without a gap in the support.
Runs runsOf(const std::vector<WallPoint>& points, const std::vector<int>& support,
            const WallScale& scale, const WallLine& line) {
  const Box box = boxOf(points, support, line);
  const double side = supportCellSize(scale);
  std::vector<char> seen(static_cast<std::size_t>((box.s1 - box.s0) / side) + 1, 0);
  for (const int i : support) {
    const double s = line.along(points[static_cast<std::size_t>(i)].position);
    seen[std::min(seen.size() - 1, static_cast<std::size_t>((s - box.s0) / side))] = 1;
  }
  Runs runs;
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (seen[c] == 0) continue;
    const double left = box.s0 + side * static_cast<double>(c);
    const double right = std::min(left + side, box.s1);
    if (c > 0 && seen[c - 1] != 0) {
      runs.back().second = right;
    } else {
      runs.emplace_back(left, right);
    }
  }
  return runs;
}

// Points of a wall that the line only crosses, flat enough to hold many of them, run against it.
// Without the runs that turn against the line by more than their noise explains.
std::vector<int> withoutLeaningRuns(const std::vector<WallPoint>& points,
                                    const std::vector<int>& support, const WallScale& scale,
                                    const WallLine& line) {
  struct Moments {
    double n = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0;
  };
  const Runs runs = runsOf(points, support, scale, line);
  const auto runOf = [&](double s) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const auto& r) { return s <= r.second; });
    return static_cast<std::size_t>(std::min(run, runs.end() - 1) - runs.begin());
  };
  std::vector<Moments> moments(runs.size());
  for (const int i : support) {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)].position;
    const std::size_t r = runOf(line.along(p));
    const double s = line.along(p) - runs[r].first;
    const double d = line.across(p);
    Moments& m = moments[r];
    m.n += 1.0, m.s += s, m.d += d, m.ss += s * s, m.sd += s * d;
  }
  std::vector<char> leans(runs.size(), 0);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Moments& m = moments[r];
    const double spread = m.ss - m.s * m.s / std::max(m.n, 1.0);
    if (!(spread > 0.0)) continue;
    const double slope = std::abs(m.sd - m.s * m.d / m.n) / spread;
    leans[r] = slope > kLeanDeviations * scale.noise / std::sqrt(spread) &&
               slope * (runs[r].second - runs[r].first) > kLean * scale.noise;
  }
  std::vector<int> kept;
  for (const int i : support) {
    if (leans[runOf(line.along(points[static_cast<std::size_t>(i)].position))] == 0) {
      kept.push_back(i);
    }
  }
  return kept;
}

// Whether the points keep to the line. Tree crowns and other clutter fill the space about it
// evenly.
bool isSurface(const std::vector<WallPoint>& points, const std::vector<int>& support,
               const std::vector<int>& candidates, const WallScale& scale, const WallLine& line) {
  const Box box = boxOf(points, support, line);
  const CellGrid grid(supportCellSize(scale), box.s0, box.s1, box.z0, box.z1);
  std::vector<char> seen(grid.size(), 0);
  for (const int i : support) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    seen[grid.at(line.along(p.position), p.z)] = 1;
  }
  double on = 0.0;
  double beside = 0.0;
  for (const int i : candidates) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    const double s = line.along(p.position);
    if (s < box.s0 || s > box.s1 || p.z < box.z0 || p.z > box.z1) continue;
    const double d = std::abs(line.across(p.position)) / scale.noise;
    if (d < kBeside && seen[grid.at(s, p.z)] != 0) (d < kOn ? on : beside) += 1.0;
  }
  return on >= kMinOnShare * (on + beside);
}

// The heights without the few points at either end that may be of walls below and above.
std::pair<double, double> mainHeights(const std::vector<WallPoint>& points,
                                      const std::vector<int>& support) {
  std::vector<double> heights;
  for (const int i : support) heights.push_back(points[static_cast<std::size_t>(i)].z);
  const auto quantile = [&](double share) {
    const auto place = heights.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), place, heights.end());
    return *place;
  };
  const double low = quantile(kStray);
  return {low, quantile(1.0 - kStray)};
}

// Ends, heights, area and runs of the support.
void describeSupport(const std::vector<WallPoint>& points, const std::vector<int>& support,
                     const WallScale& scale, WallLine& line) {
  const Box box = boxOf(points, support, line);
  const double side = supportCellSize(scale);
  const CellGrid grid(side, box.s0, box.s1, box.z0, box.z1);
  std::vector<char> seen(grid.size(), 0);
  for (const int i : support) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    seen[grid.at(line.along(p.position), p.z)] = 1;
  }
  line.support = support.size();
  line.s_min = box.s0;
  line.s_max = box.s1;
  std::tie(line.z_min, line.z_max) = mainHeights(points, support);
  line.support_area = static_cast<double>(std::count(seen.begin(), seen.end(), 1)) * side * side;
  line.runs = runsOf(points, support, scale, line);
}

}  // namespace

double supportCellSize(const WallScale& scale) {
  return std::max(3.0 * scale.noise, std::sqrt(6.0 / scale.density));
}

std::vector<int> fitToSupport(const std::vector<WallPoint>& points,
                              const std::vector<int>& candidates, const WallScale& scale,
                              const SupportOptions& options, WallLine& line) {
  std::vector<int> support;
  std::vector<int> pool = candidates;
  for (const double gate : kGates) {
    const std::vector<int> near = withinGate(points, pool, line, gate * scale.noise);
    support = inFullCells(points, near, scale, line);
    if (support.empty()) return {};
    support = inMainTiles(points, support, scale, line);
    if (support.empty()) return {};
    fitLine(points, support, gate * scale.noise, options.fit_direction, line);
    std::vector<int> flat = withoutLeaningRuns(points, support, scale, line);
    if (options.fit_direction && !flat.empty()) {
      flat = flatStretch(points, alongMainHalf(points, flat, scale, line), scale, line);
    }
    if (flat.empty()) return {};
    if (flat.size() == support.size()) continue;
    support = flat;
    if (options.fit_direction) pool = flat;
    fitLine(points, support, gate * scale.noise, options.fit_direction, line);
  }
  if (!options.fit_direction) {
    // A locked direction may be that of another wall, whose line would lean over this one; or the
    // line meets another wall further on.
    const std::vector<int> flat = flatStretch(points, support, scale, line);
    if (static_cast<double>(flat.size()) < kMinFlatShare * static_cast<double>(support.size())) {
      return {};
    }
    if (flat.size() < support.size()) {
      support = flat;
      fitLine(points, support, kGates[std::size(kGates) - 1] * scale.noise, false, line);
    }
  }
  if (!isSurface(points, support, candidates, scale, line)) return {};
  describeSupport(points, support, scale, line);
  return support;
}

}  // namespace storey::detail
