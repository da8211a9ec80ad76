// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_bends.h>
#include <storey/segmentation/detail/wall_flatness.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGates[] = {6.0, 5.0, 4.5, 4.0};  // noise deviations, one a round
constexpr double kSettled = 5.0;                   // gates below: the line is nearly right
constexpr double kUnsettled = 1.5;                 // times the reach, before that
constexpr double kMinOccupancy = 0.3;              // of the expected points of a cell
constexpr int kMinFullNeighbors = 3;               // of eight
constexpr int kGrowths = 3;
constexpr double kTilePoints = 50.0;
constexpr double kMinTiles = 4.0;      // fewer tell no majority
constexpr std::size_t kMinInTile = 5;  // points, for a median
constexpr double kTileSpread = 0.5;    // noise deviations, relief that one wall may have
constexpr double kMinFlatShare = 0.7;  // of the support of a line with a locked direction
constexpr double kOn = 2.5;            // noise deviations: nearly all points of a wall
constexpr double kBeside = 10.0;       // noise deviations
constexpr double kMinOnShare = 0.4;    // of the points to either side; 0.25 of an even density
constexpr double kStray = 0.03;        // of the support, at either end

// Square cells of (s, z) about a line over the box of some points, which is not empty.
class CellGrid {
 public:
  CellGrid(const std::vector<WallPoint>& points, const std::vector<int>& indices,
           const WallLine& line, double side)
      : line_(line), side_(side) {
    for (const int i : indices) {
      const WallPoint& p = points[static_cast<std::size_t>(i)];
      const Eigen::Array2d at = placeOf(p);
      low_ = low_.min(at);
      high_ = high_.max(at);
    }
    columns_ = static_cast<std::ptrdiff_t>((high_.x() - low_.x()) / side) + 1;
    rows_ = static_cast<std::ptrdiff_t>((high_.y() - low_.y()) / side) + 1;
  }

  std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::ptrdiff_t columns() const { return columns_; }
  std::ptrdiff_t rows() const { return rows_; }
  bool holds(const WallPoint& p) const {
    const Eigen::Array2d at = placeOf(p);
    return (at >= low_).all() && (at <= high_).all();
  }
  std::size_t at(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  std::size_t at(const WallPoint& p) const {  // of a point that it holds
    const Eigen::Array2d cell = (placeOf(p) - low_) / side_;
    return at(static_cast<std::ptrdiff_t>(cell.x()), static_cast<std::ptrdiff_t>(cell.y()));
  }

 private:
  Eigen::Array2d placeOf(const WallPoint& p) const { return {line_.along(p.position), p.z}; }

  const WallLine& line_;
  double side_;
  Eigen::Array2d low_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high_ = -low_;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
};

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
  const double side = supportCellSize(scale);
  const CellGrid grid(points, near, line, side);
  std::vector<int> count(grid.size(), 0);
  for (const int i : near) ++count[grid.at(points[static_cast<std::size_t>(i)])];
  const double least = std::max(1.0, kMinOccupancy * scale.density * side * side);
  const auto full = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
    return c >= 0 && r >= 0 && c < grid.columns() && r < grid.rows() &&
           count[grid.at(c, r)] >= least;
  };
  std::vector<char> kept(grid.size(), 0);
  for (std::ptrdiff_t r = 0; r < grid.rows(); ++r) {
    for (std::ptrdiff_t c = 0; c < grid.columns(); ++c) {
      if (!full(c, r)) continue;
      int neighbors = -1;
      for (std::ptrdiff_t dr = -1; dr <= 1; ++dr) {
        for (std::ptrdiff_t dc = -1; dc <= 1; ++dc) neighbors += full(c + dc, r + dr) ? 1 : 0;
      }
      kept[grid.at(c, r)] = neighbors >= kMinFullNeighbors ? 1 : 0;
    }
  }
  std::vector<int> result;
  for (const int i : near) {
    if (kept[grid.at(points[static_cast<std::size_t>(i)])] != 0) result.push_back(i);
  }
  return result;
}

struct Tile {
  double median;
  std::size_t size;  // points
};

// The middle of the range of this width that holds the tiles with most points.
double densestMedian(std::vector<Tile> tiles, double width) {
  std::sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) {
    return a.median != b.median ? a.median < b.median : a.size < b.size;
  });
  std::size_t best = 0;
  std::size_t held = 0;
  double center = 0.0;
  for (std::size_t i = 0, j = 0; i < tiles.size(); ++i) {
    for (; j < tiles.size() && tiles[j].median - tiles[i].median <= width; ++j) {
      held += tiles[j].size;
    }
    if (held > best) {
      best = held;
      center = 0.5 * (tiles[i].median + tiles[j - 1].median);
    }
    held -= tiles[i].size;
  }
  return center;
}

// How far the median of some points of one wall may be off: that of a median is 1.25 times the
// deviation of a mean.
double medianReach(double points, double noise) {
  return noise * (kTileSpread + 3.0 * 1.25 / std::sqrt(points));
}

// Two parallel walls a few deviations apart, at different places or heights, are told apart by the
// medians of tiles, and so are panes: keeps the points of the tiles whose medians agree with most
// others. A line that is not settled yet is crossed by its wall, so that more has to be kept.
std::vector<int> inMainTiles(const std::vector<WallPoint>& points, const std::vector<int>& support,
                             const WallScale& scale, const WallLine& line, bool settled) {
  if (static_cast<double>(support.size()) < kMinTiles * kTilePoints) return support;
  const CellGrid grid(points, support, line, std::sqrt(kTilePoints / scale.density));
  std::vector<std::vector<double>> residuals(grid.size());
  for (const int i : support) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    residuals[grid.at(p)].push_back(line.across(p.position));
  }
  std::vector<Tile> tiles;
  std::vector<std::size_t> tile_of(grid.size(), SIZE_MAX);
  for (std::size_t t = 0; t < residuals.size(); ++t) {
    std::vector<double>& r = residuals[t];
    if (r.size() < kMinInTile) continue;
    std::nth_element(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(r.size() / 2), r.end());
    tile_of[t] = tiles.size();
    tiles.push_back({r[r.size() / 2], r.size()});
  }
  if (tiles.empty()) return support;
  const double reach = medianReach(kTilePoints, scale.noise);
  const double center = densestMedian(tiles, 2.0 * reach);
  std::vector<int> kept;
  for (const int i : support) {
    const std::size_t t = tile_of[grid.at(points[static_cast<std::size_t>(i)])];
    if (t == SIZE_MAX) continue;
    const double wide =
        settled ? medianReach(static_cast<double>(tiles[t].size), scale.noise) : kUnsettled * reach;
    if (std::abs(tiles[t].median - center) <= wide) kept.push_back(i);
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

// The part of the support that is one flat wall. A line whose direction is free is taken by the
// part that is; one whose direction is locked takes it only where it does not turn against it.
std::vector<int> flatPart(const std::vector<WallPoint>& points, const std::vector<int>& support,
                          const WallScale& scale, const SupportOptions& options,
                          const WallLine& line) {
  std::vector<int> flat = withoutLeaningRuns(points, support, scale, line, options.by_normals);
  if (!options.fit_direction) return flat;
  return flatStretch(points, alongMainHalf(points, flat, scale, line), scale, line);
}

// A free line again, among all its candidates: what it was cut down to is as short as the panes at
// its ends made it, and turned by them. Where the points bend, another wall goes on.
std::vector<int> grownAlong(const std::vector<WallPoint>& points,
                            const std::vector<int>& candidates, double cut, const WallScale& scale,
                            const SupportOptions& options, WallLine& line) {
  std::vector<int> support;
  for (int round = 0; round < kGrowths; ++round) {
    support = inFullCells(points, withinGate(points, candidates, line, cut), scale, line);
    if (options.steps.main_tiles) support = inMainTiles(points, support, scale, line, true);
    support = onOneSideOfBend(points, support, scale, line);
    if (support.empty()) return {};
    fitLine(points, support, cut, true, line);
  }
  return flatPart(points, support, scale, options, line);
}

// A locked direction may be that of another wall, whose line would lean over this one; or the line
// meets another wall further on, maybe at a small angle.
std::vector<int> endedAlong(const std::vector<WallPoint>& points, const std::vector<int>& support,
                            double cut, const WallScale& scale, WallLine& line) {
  std::vector<int> flat = flatStretch(points, support, scale, line);
  if (static_cast<double>(flat.size()) < kMinFlatShare * static_cast<double>(support.size())) {
    return {};
  }
  fitLine(points, flat, cut, false, line);
  flat = onOneSideOfBend(points, flat, scale, line);
  if (!flat.empty()) fitLine(points, flat, cut, false, line);
  return flat;
}

std::vector<char> seenCells(const std::vector<WallPoint>& points, const std::vector<int>& support,
                            const CellGrid& grid) {
  std::vector<char> seen(grid.size(), 0);
  for (const int i : support) seen[grid.at(points[static_cast<std::size_t>(i)])] = 1;
  return seen;
}

// Whether the points keep to the line. Tree crowns and other clutter fill the space about it
// evenly.
bool isSurface(const std::vector<WallPoint>& points, const std::vector<int>& support,
               const std::vector<int>& candidates, const WallScale& scale, const WallLine& line) {
  const CellGrid grid(points, support, line, supportCellSize(scale));
  const std::vector<char> seen = seenCells(points, support, grid);
  double on = 0.0;
  double beside = 0.0;
  for (const int i : candidates) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    const double d = std::abs(line.across(p.position)) / scale.noise;
    if (d < kBeside && grid.holds(p) && seen[grid.at(p)] != 0) (d < kOn ? on : beside) += 1.0;
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
  const double side = supportCellSize(scale);
  const std::vector<char> seen = seenCells(points, support, CellGrid(points, support, line, side));
  line.support = support.size();
  line.support_area = static_cast<double>(std::count(seen.begin(), seen.end(), 1)) * side * side;
  std::tie(line.z_min, line.z_max) = mainHeights(points, support);
  line.runs = runsAlong(points, support, scale, line);
  line.s_min = line.runs.front().first;
  line.s_max = line.runs.back().second;
}

}  // namespace

double supportCellSize(const WallScale& scale) {
  return std::max(3.0 * scale.noise, std::sqrt(6.0 / scale.density));
}

std::vector<int> fitToSupport(const std::vector<WallPoint>& points,
                              const std::vector<int>& candidates, const WallScale& scale,
                              const SupportOptions& options, WallLine& line) {
  const bool free = options.fit_direction;
  std::vector<int> support;
  std::vector<int> pool = candidates;
  double cut = 0.0;
  for (const double gate : kGates) {
    cut = gate * scale.noise;
    const std::vector<int> near = withinGate(points, pool, line, cut);
    support = inFullCells(points, near, scale, line);
    if (options.steps.setbacks) support = atMainHeights(points, support, scale, line);
    if (options.steps.main_tiles)
      support = inMainTiles(points, support, scale, line, gate < kSettled);
    if (support.empty()) return {};
    fitLine(points, support, cut, free, line);
    if (!options.steps.flatness) continue;
    std::vector<int> flat = flatPart(points, support, scale, options, line);
    if (flat.empty()) return {};
    if (flat.size() == support.size()) continue;
    support = std::move(flat);
    if (free) pool = support;  // what was cut off must not turn the line again
    fitLine(points, support, cut, free, line);
  }
  if (options.steps.flatness) {
    if (free) {
      describeSupport(points, support, scale, line);
      if (line.support_area < options.min_area) return {};  // clutter would only grow into a wall
    }
    support = free ? grownAlong(points, candidates, cut, scale, options, line)
                   : endedAlong(points, support, cut, scale, line);
    if (support.empty()) return {};
  }
  if (options.steps.surface_test && !isSurface(points, support, candidates, scale, line)) return {};
  describeSupport(points, support, scale, line);
  return support;
}

}  // namespace storey::detail
