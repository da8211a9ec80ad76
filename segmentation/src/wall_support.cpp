// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_bends.h>
#include <storey/segmentation/detail/wall_flatness.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
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

// Square cells of (s, z) over the box of some points, which are not none.
class CellGrid {
 public:
  CellGrid(const LinePoints& points, double side)
      : CellGrid(rangeOf(points.s), rangeOf(points.z), side) {}
  // Of some of the points.
  CellGrid(const LinePoints& points, const std::vector<std::size_t>& some, double side)
      : CellGrid(rangeOf(points.s, some), rangeOf(points.z, some), side) {}

  CellGrid(const std::pair<double, double>& along, const std::pair<double, double>& up, double side)
      : side_(side) {
    std::tie(low_.x(), high_.x()) = along;
    std::tie(low_.y(), high_.y()) = up;
    columns_ = static_cast<std::ptrdiff_t>((high_.x() - low_.x()) / side) + 1;
    rows_ = static_cast<std::ptrdiff_t>((high_.y() - low_.y()) / side) + 1;
  }

  std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::ptrdiff_t columns() const { return columns_; }
  std::ptrdiff_t rows() const { return rows_; }
  bool holds(double s, double z) const {
    return s >= low_.x() && s <= high_.x() && z >= low_.y() && z <= high_.y();
  }
  std::size_t at(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  std::size_t of(double s, double z) const {  // that it holds
    return at(static_cast<std::ptrdiff_t>((s - low_.x()) / side_),
              static_cast<std::ptrdiff_t>((z - low_.y()) / side_));
  }
  // The cell of each of the points that the grid was made for.
  std::vector<std::size_t> cellsOf(const LinePoints& points) const {
    std::vector<std::size_t> cells(points.size());
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = of(points.s[k], points.z[k]);
    return cells;
  }

 private:
  double side_;
  Eigen::Array2d low_;
  Eigen::Array2d high_;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
};

// Of the points within the gate those in cells that are filled well enough and not alone.
LinePoints inFullCells(const LinePoints& pool, double gate, const WallScale& scale) {
  std::vector<std::size_t> near = pool.within(gate);
  if (near.empty()) return {};
  const double side = supportCellSize(scale);
  const CellGrid grid(pool, near, side);
  std::vector<std::size_t> cell_of;
  cell_of.reserve(near.size());
  std::vector<int> count(grid.size(), 0);
  for (const std::size_t k : near) {
    cell_of.push_back(grid.of(pool.s[k], pool.z[k]));
    ++count[cell_of.back()];
  }
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
  std::size_t end = 0;
  for (std::size_t n = 0; n < near.size(); ++n) {
    near[end] = near[n];
    end += static_cast<std::size_t>(kept[cell_of[n]]);
  }
  near.resize(end);
  return pool.only(near);
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
LinePoints inMainTiles(LinePoints support, const WallScale& scale, bool settled) {
  if (static_cast<double>(support.size()) < kMinTiles * kTilePoints) return support;
  const CellGrid grid(support, std::sqrt(kTilePoints / scale.density));
  const std::vector<std::size_t> cell_of = grid.cellsOf(support);
  std::vector<std::size_t> first(grid.size() + 1, 0);  // of each cell's points
  for (const std::size_t cell : cell_of) ++first[cell + 1];
  for (std::size_t c = 0; c < grid.size(); ++c) first[c + 1] += first[c];
  std::vector<double> residuals(support.size());  // cell by cell
  std::vector<std::size_t> next = first;
  for (std::size_t k = 0; k < support.size(); ++k) residuals[next[cell_of[k]]++] = support.d[k];
  std::vector<Tile> tiles;
  std::vector<std::size_t> tile_of(grid.size(), SIZE_MAX);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    const std::size_t held = first[c + 1] - first[c];
    if (held < kMinInTile) continue;
    const auto begin = residuals.begin() + static_cast<std::ptrdiff_t>(first[c]);
    const auto middle = begin + static_cast<std::ptrdiff_t>(held / 2);
    std::nth_element(begin, middle, begin + static_cast<std::ptrdiff_t>(held));
    tile_of[c] = tiles.size();
    tiles.push_back({*middle, held});
  }
  if (tiles.empty()) return support;
  const double reach = medianReach(kTilePoints, scale.noise);
  const double center = densestMedian(tiles, 2.0 * reach);
  std::vector<char> kept(grid.size(), 0);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    if (tile_of[c] == SIZE_MAX) continue;
    const Tile& tile = tiles[tile_of[c]];
    const double wide =
        settled ? medianReach(static_cast<double>(tile.size), scale.noise) : kUnsettled * reach;
    kept[c] = std::abs(tile.median - center) <= wide ? 1 : 0;
  }
  support.keepWhere([&](std::size_t k) { return kept[cell_of[k]] != 0; });
  return support;
}

// Tukey-weighted least squares of d over s. The line turns about the centre of its points, which
// are then in its coordinates again.
void fitLine(LinePoints& support, double cut, bool fit_direction, WallLine& line) {
  double w = 0.0, ws = 0.0, wd = 0.0, wss = 0.0, wsd = 0.0, wdd = 0.0;
  const Eigen::Vector2d origin = support.position.front();
  for (std::size_t k = 0; k < support.size(); ++k) {
    const double d = support.d[k];
    const double u = d / cut;
    const double inside = std::max(0.0, 1.0 - u * u);
    const double weight = inside * inside;
    const double s = line.along(support.position[k] - origin);
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
  support.moveTo(line);
}

// The part of the support that is one flat wall. A line whose direction is free is taken by the
// part that is; one whose direction is locked takes it only where it does not turn against it.
LinePoints flatPart(const std::vector<WallPoint>& points, LinePoints support,
                    const WallScale& scale, const SupportOptions& options, const WallLine& line) {
  LinePoints flat = withoutLeaningRuns(points, std::move(support), scale, line, options.by_normals);
  if (!options.fit_direction) return flat;
  return flatStretch(alongMainHalf(std::move(flat), scale.noise), scale.noise);
}

// A free line again, among all its candidates: what it was cut down to is as short as the panes at
// its ends made it, and turned by them. Where the points bend, another wall goes on.
LinePoints grownAlong(const std::vector<WallPoint>& points, const std::vector<int>& candidates,
                      double cut, const WallScale& scale, const SupportOptions& options,
                      WallLine& line) {
  LinePoints pool(points, candidates, line);
  LinePoints support;
  for (int round = 0; round < kGrowths; ++round) {
    support = inFullCells(pool, cut, scale);
    if (options.steps.main_tiles) support = inMainTiles(std::move(support), scale, true);
    if (options.steps.bends) support = onOneSideOfBend(points, std::move(support), scale, line);
    if (support.empty()) return support;
    fitLine(support, cut, true, line);
    pool.moveTo(line);
  }
  return flatPart(points, std::move(support), scale, options, line);
}

// A locked direction may be that of another wall, whose line would lean over this one; or the line
// meets another wall further on, maybe at a small angle.
LinePoints endedAlong(const std::vector<WallPoint>& points, LinePoints support, double cut,
                      const WallScale& scale, const SupportOptions& options, WallLine& line) {
  const auto size = static_cast<double>(support.size());
  support = flatStretch(std::move(support), scale.noise);
  if (static_cast<double>(support.size()) < kMinFlatShare * size) return {};
  fitLine(support, cut, false, line);
  if (!options.steps.bends) return support;
  support = onOneSideOfBend(points, std::move(support), scale, line);
  if (!support.empty()) fitLine(support, cut, false, line);
  return support;
}

std::vector<char> seenCells(const LinePoints& support, const CellGrid& grid) {
  std::vector<char> seen(grid.size(), 0);
  for (std::size_t k = 0; k < support.size(); ++k) seen[grid.of(support.s[k], support.z[k])] = 1;
  return seen;
}

// Whether the points keep to the line. Tree crowns and other clutter fill the space about it
// evenly.
bool isSurface(const LinePoints& support, const LinePoints& candidates, const WallScale& scale) {
  const CellGrid grid(support, supportCellSize(scale));
  const std::vector<char> seen = seenCells(support, grid);
  double on = 0.0;
  double beside = 0.0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const double d = std::abs(candidates.d[k]) / scale.noise;
    const double s = candidates.s[k];
    const double z = candidates.z[k];
    if (d < kBeside && grid.holds(s, z) && seen[grid.of(s, z)] != 0) {
      (d < kOn ? on : beside) += 1.0;
    }
  }
  return on >= kMinOnShare * (on + beside);
}

// The heights without the few points at either end that may be of walls below and above.
std::pair<double, double> mainHeights(std::vector<double> heights) {
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
void describeSupport(const LinePoints& support, const WallScale& scale, WallLine& line) {
  const double side = supportCellSize(scale);
  const std::vector<char> seen = seenCells(support, CellGrid(support, side));
  line.support = support.size();
  line.support_area = static_cast<double>(std::count(seen.begin(), seen.end(), 1)) * side * side;
  std::tie(line.z_min, line.z_max) = mainHeights(support.z);
  line.runs = runsAlong(support, scale);
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
  LinePoints support;
  LinePoints pool(points, candidates, line);
  for (const double gate : kGates) {
    const double cut = gate * scale.noise;
    support = inFullCells(pool, cut, scale);
    if (options.steps.setbacks) support = atMainHeights(std::move(support), scale.noise);
    if (options.steps.main_tiles) {
      support = inMainTiles(std::move(support), scale, gate < kSettled);
    }
    if (support.empty()) return {};
    fitLine(support, cut, free, line);
    if (options.steps.flatness) {
      const std::size_t size = support.size();
      support = flatPart(points, std::move(support), scale, options, line);
      if (support.empty()) return {};
      const bool cut_off = support.size() < size;
      if (cut_off) fitLine(support, cut, free, line);
      if (cut_off && free) {
        pool = support;  // what was cut off must not turn the line again
        continue;
      }
    }
    pool.moveTo(line);
  }
  if (options.steps.flatness) {
    const double cut = kGates[std::size(kGates) - 1] * scale.noise;
    if (free) {
      describeSupport(support, scale, line);
      if (line.support_area < options.min_area) return {};  // clutter would only grow into a wall
    }
    support = free ? grownAlong(points, candidates, cut, scale, options, line)
                   : endedAlong(points, std::move(support), cut, scale, options, line);
    if (support.empty()) return {};
  }
  if (options.steps.surface_test &&
      !isSurface(support, LinePoints(points, candidates, line), scale)) {
    return {};
  }
  describeSupport(support, scale, line);
  return std::move(support.number);
}

}  // namespace storey::detail
