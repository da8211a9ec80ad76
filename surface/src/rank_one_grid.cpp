// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/rank_one_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr int kMaxTurns = 20;          // they settle after 3 or 4
constexpr float kMissingCost = 0.25f;  // of plain wall
constexpr double kBandCost = 0.1;      // of a band as long as the mark, all window
constexpr double kShortest = 0.6;      // of the mark, which may be drawn loosely
constexpr double kLongest = 1.25;      // of the mark

/// What each row gains if it is in a band, windows being in `columns`; and the greatest gain.
Eigen::ArrayXf rowGains(const Eigen::ArrayXXf& scores, const std::vector<Band>& columns,
                        double& greatest) {
  Eigen::ArrayXf gains = Eigen::ArrayXf::Zero(scores.rows());
  greatest = 0.0;
  for (const Band& band : columns) {
    const auto begin = static_cast<Eigen::Index>(band.begin);
    const auto length = static_cast<Eigen::Index>(band.length());
    const Eigen::ArrayXf cells = scores.middleCols(begin, length).rowwise().sum();
    gains += cells.max(-kMissingCost * static_cast<float>(length));
    greatest += static_cast<double>(length);
  }
  return gains;
}

/// The bands of greatest total gain less `cost` for each, of lengths like a window's.
std::vector<Band> bestBands(const Eigen::ArrayXf& gains, double cost, double length) {
  const auto shortest = static_cast<std::size_t>(std::max(1.0, std::floor(kShortest * length)));
  const auto longest = static_cast<std::size_t>(std::ceil(kLongest * length));
  const auto size = static_cast<std::size_t>(gains.size());
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::vector<double> total(size + 1, 0.0);      // of the gains before i
  std::vector<double> inside(size + 1, kNever);  // best if a band ends at i
  std::vector<double> outside(size + 1, 0.0);    // best if none does
  std::vector<std::size_t> begin(size + 1, 0);   // of the band that ends at i
  for (std::size_t i = 1; i <= size; ++i) {
    total[i] = total[i - 1] + static_cast<double>(gains[static_cast<Eigen::Index>(i - 1)]);
    outside[i] = std::max(outside[i - 1], inside[i - 1]);
    for (std::size_t n = shortest; n <= std::min(longest, i); ++n) {
      const double value = outside[i - n] + total[i] - total[i - n] - cost;
      if (value <= inside[i]) continue;
      inside[i] = value;
      begin[i] = i - n;
    }
  }
  std::vector<Band> bands;
  bool ends = inside[size] > outside[size];
  for (std::size_t i = size; i > 0;) {
    if (ends) {
      bands.push_back({static_cast<double>(begin[i]), static_cast<double>(i)});
      i = begin[i];
      ends = false;
    } else {
      ends = inside[i - 1] > outside[i - 1];
      --i;
    }
  }
  std::reverse(bands.begin(), bands.end());
  return bands;
}

/// Bands of rows, given those of columns.
std::vector<Band> solveRows(const Eigen::ArrayXXf& scores, const std::vector<Band>& columns,
                            double length) {
  double greatest = 0.0;
  const Eigen::ArrayXf gains = rowGains(scores, columns, greatest);
  return bestBands(gains, kBandCost * length * greatest, length);
}

}  // namespace

BandGrid fitBandGrid(const Eigen::ArrayXXf& scores, const Band& columns, const Band& rows) {
  const Eigen::ArrayXXf turned = scores.transpose();
  BandGrid grid{{columns}, {rows}};
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const BandGrid before = grid;
    grid.rows = solveRows(scores, grid.columns, rows.length());
    grid.columns = solveRows(turned, grid.rows, columns.length());
    if (grid.rows == before.rows && grid.columns == before.columns) break;
  }
  return grid;
}

}  // namespace storey::detail
