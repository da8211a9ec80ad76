// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// The residuals of the points of one wall, across it and in noise deviations, positive outside.
/// Those beyond the gate are not seen: they are of other walls.
class ResidualHistogram {
 public:
  static constexpr double kGate = 4.0;
  static constexpr double kWidth = 0.2;  // of a bin; raises the variance by kWidth^2 / 12 = 0.3 %
  static constexpr std::size_t kBins = 40;

  void add(double residual);
  ResidualHistogram& operator+=(const ResidualHistogram& other);

  const std::array<double, kBins>& counts() const { return counts_; }
  double total() const { return total_; }
  static double middleOf(std::ptrdiff_t bin) {
    return (static_cast<double>(bin) + 0.5) * kWidth - kGate;
  }

 private:
  std::array<double, kBins> counts_{};
  double total_ = 0.0;
};

/// A wall with panes set back (or frames that stand out) by much the same depth. Its residuals
/// have the density
///     (1 - background) [(1 - share) N(offset, deviation) + share N(offset - depth, deviation)]
/// and, spread evenly over the gate, a background of strays and heavy tails. In noise deviations.
struct WallPanes {
  double offset = 0.0;
  double share = 0.0;
  double depth = 0.0;  ///< negative: it stands out
  double deviation = 1.0;
  double background = 0.0;
  bool in_use = false;            ///< false: the wall is better described by one normal
  double information = 0.0;       ///< Fisher's on the offset, the share known
  double offset_deviation = 0.0;  ///< of the offset, the share not known

  struct Expected {
    double weight;    ///< probability that the point is of the wall or its panes
    double residual;  ///< where it would lie if nothing were set back
  };
  Expected expected(double residual) const;
};

/// Fits all walls of a building, each with points, at once by maximum likelihood: depth and
/// deviation are common to all, offset, share and background are each wall's own. \return parallel
/// to `walls`; empty if two modes do not describe the building decisively better than one normal a
/// wall
std::vector<WallPanes> fitPanes(const std::vector<ResidualHistogram>& walls,
                                unsigned int threads = 0);

}  // namespace storey::detail
