// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/rank_one_grid.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr int kMaxTurns = 20;          // they settle after 3 or 4
constexpr float kMissingCost = 0.25f;  // of plain wall
constexpr double kBandCost = 0.04;     // of a band as long as a window, all window: mullions and
                                       // glazing bars up to a sixth of a window are bridged

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

/// The bands of greatest total gain less `cost` for each.
std::vector<Band> bestBands(const Eigen::ArrayXf& gains, double cost) {
  const auto size = static_cast<std::size_t>(gains.size());
  std::vector<char> entered(size);  // inside at i is best reached from outside
  std::vector<char> left(size);     // outside at i is best reached from inside
  double inside = -cost;            // best totals up to i, with i in a band or not
  double outside = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double before = inside;
    entered[i] = i == 0 || outside - cost > inside;
    left[i] = i > 0 && before > outside;
    inside = std::max(inside, outside - cost) + static_cast<double>(gains[static_cast<int>(i)]);
    outside = std::max(outside, i > 0 ? before : outside);
  }
  std::vector<Band> bands;
  bool in_band = inside > outside;
  if (in_band) bands.push_back({0.0, static_cast<double>(size)});
  for (std::size_t i = size; i-- > 0;) {
    if (in_band && entered[i] != 0) {
      bands.back().begin = static_cast<double>(i);
      in_band = false;
    } else if (!in_band && left[i] != 0) {
      bands.push_back({0.0, static_cast<double>(i)});
      in_band = true;
    }
  }
  std::reverse(bands.begin(), bands.end());
  return bands;
}

double medianLength(const std::vector<Band>& bands) {
  std::vector<double> lengths;
  for (const Band& band : bands) lengths.push_back(band.length());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// Leaves out what is no window's size: bands of less than half, or more than twice the usual.
std::vector<Band> usualBands(std::vector<Band> bands) {
  if (bands.empty()) return bands;
  const double usual = medianLength(bands);
  const auto odd = [usual](const Band& band) {
    return band.length() < 0.5 * usual || band.length() > 2.0 * usual;
  };
  bands.erase(std::remove_if(bands.begin(), bands.end(), odd), bands.end());
  return bands;
}

/// Bands of rows, given those of columns.
std::vector<Band> solveRows(const Eigen::ArrayXXf& scores, const std::vector<Band>& columns,
                            double& length) {
  double greatest = 0.0;
  const Eigen::ArrayXf gains = rowGains(scores, columns, greatest);
  const std::vector<Band> rows = usualBands(bestBands(gains, kBandCost * length * greatest));
  if (!rows.empty()) length = medianLength(rows);
  return rows;
}

}  // namespace

BandGrid fitBandGrid(const Eigen::ArrayXXf& scores, const Band& columns, const Band& rows) {
  const Eigen::ArrayXXf turned = scores.transpose();
  BandGrid grid{{columns}, {rows}};
  double height = rows.length();
  double width = columns.length();
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const BandGrid before = grid;
    grid.rows = solveRows(scores, grid.columns, height);
    grid.columns = solveRows(turned, grid.rows, width);
    if (grid.rows == before.rows && grid.columns == before.columns) break;
  }
  return grid;
}

}  // namespace storey::detail
