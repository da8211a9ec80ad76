// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/window_edges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

namespace storey::detail {
namespace {

/// An edge across the columns, seen in one photo at one window.
struct EdgeSight {
  std::size_t band;  // of the columns
  double side;       // -1: where the band begins, 1: where it ends
  double place;      // texels
  double sharpness;  // pixels a texel
};

/// Mean scores of each column over the middle four fifths of a window's rows; nothing if less than
/// nine tenths of them are seen.
std::optional<Eigen::ArrayXf> profileOf(const Eigen::ArrayXXf& scores, const Band& rows, int begin,
                                        int end) {
  constexpr double kRim = 0.1;        // of the window's height, at either end
  constexpr double kLeastSeen = 0.9;  // of the texels
  const int top = static_cast<int>(std::lround(rows.begin + kRim * rows.length()));
  const int count = std::max(1, static_cast<int>(std::lround((1.0 - 2.0 * kRim) * rows.length())));
  if (begin < 0 || top < 0 || end > scores.cols() || top + count > scores.rows() || end <= begin) {
    return std::nullopt;
  }
  const auto area = scores.block(top, begin, count, end - begin);
  if (static_cast<double>((area != 0.0f).count()) < kLeastSeen * static_cast<double>(area.size())) {
    return std::nullopt;
  }
  return area.colwise().mean().transpose();
}

/// Where a profile steps from wall to window, in texels from its start: first the cut that has the
/// most wall before and the most window behind it, then the balance of both about the cut.
std::optional<double> stepOf(const Eigen::ArrayXf& profile) {
  constexpr Eigen::Index kReach = 3;      // texels to either side: as far as an edge is blurred
  constexpr float kLeastContrast = 0.5f;  // between -1, all wall, and 1: of 2
  float gain = 0.0f;
  float best = 0.0f;
  Eigen::Index cut = 0;
  for (Eigen::Index i = 0; i < profile.size(); ++i) {
    gain -= profile[i];
    if (gain <= best) continue;
    best = gain;
    cut = i + 1;
  }
  if (cut < kReach || cut + kReach > profile.size()) return std::nullopt;
  const auto about = profile.segment(cut - kReach, 2 * kReach);
  const float before = about[0];
  const float behind = about[2 * kReach - 1];
  if (!(behind - before > kLeastContrast)) return std::nullopt;
  const float window = ((about - before) / (behind - before)).max(0.0f).min(1.0f).sum();
  return static_cast<double>(cut + kReach) - static_cast<double>(window);
}

/// The edges of one window at the crossing of a column and a row.
void measureWindow(const Eigen::ArrayXXf& scores, double sharpness, const BandGrid& grid,
                   std::size_t column, const Band& rows, std::vector<EdgeSight>& sights) {
  constexpr double kReach = 0.25;  // of the window's width: half way to a mullion
  const Band& band = grid.columns[column];
  const int reach = std::max(5, static_cast<int>(std::lround(kReach * band.length())));
  for (const double side : {-1.0, 1.0}) {
    const int edge = static_cast<int>(std::lround(side < 0.0 ? band.begin : band.end));
    auto profile = profileOf(scores, rows, edge - reach, edge + reach);
    if (!profile) continue;
    if (side > 0.0) profile->reverseInPlace();
    const std::optional<double> step = stepOf(*profile);
    if (step) sights.push_back({column, side, edge - side * (*step - reach), sharpness});
  }
}

/// Middles of the columns and, last, their width.
Eigen::VectorXd solve(const std::vector<EdgeSight>& sights, const Eigen::VectorXd& start) {
  constexpr int kIterations = 10;
  constexpr double kPrior = 1e-3;  // pixels: holds columns without edges where they are
  Eigen::VectorXd x = start;
  const Eigen::Index width = start.size() - 1;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd normal = kPrior * Eigen::MatrixXd::Identity(start.size(), start.size());
    Eigen::VectorXd right = kPrior * start;
    for (const EdgeSight& sight : sights) {
      const auto column = static_cast<Eigen::Index>(sight.band);
      const double half = 0.5 * sight.side;
      const double residual = sight.sharpness * (x[column] + half * x[width] - sight.place);
      const double weight = sight.sharpness * sight.sharpness / std::max(1.0, std::abs(residual));
      normal(column, column) += weight;
      normal(column, width) += weight * half;
      normal(width, column) += weight * half;
      normal(width, width) += weight * half * half;
      right[column] += weight * sight.place;
      right[width] += weight * half * sight.place;
    }
    x = normal.ldlt().solve(right);
  }
  return x;
}

std::vector<Band> fitColumns(const std::vector<RectifiedView>& views,
                             const std::vector<WindowScores>& scores, const BandGrid& grid) {
  std::vector<EdgeSight> sights;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (std::size_t column = 0; column < grid.columns.size(); ++column) {
      for (const Band& rows : grid.rows) {
        measureWindow(scores[k], views[k].sharpness, grid, column, rows, sights);
      }
    }
  }
  Eigen::VectorXd start(static_cast<Eigen::Index>(grid.columns.size()) + 1);
  std::vector<double> widths;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    start[static_cast<Eigen::Index>(i)] = grid.columns[i].middle();
    widths.push_back(grid.columns[i].length());
  }
  std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2),
                   widths.end());
  start[start.size() - 1] = widths[widths.size() / 2];
  const Eigen::VectorXd fitted = solve(sights, start);
  const double half = 0.5 * fitted[fitted.size() - 1];
  std::vector<Band> columns;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const double middle = fitted[static_cast<Eigen::Index>(i)];
    columns.push_back({middle - half, middle + half});
  }
  return columns;
}

}  // namespace

BandGrid fitEdges(const std::vector<RectifiedView>& views, const std::vector<WindowScores>& scores,
                  const BandGrid& grid) {
  BandGrid fitted;
  fitted.columns = fitColumns(views, scores, grid);
  std::vector<WindowScores> turned;
  for (const WindowScores& s : scores) turned.emplace_back(s.transpose());
  fitted.rows = fitColumns(views, turned, {grid.rows, grid.columns});
  return fitted;
}

}  // namespace storey::detail
