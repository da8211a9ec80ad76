// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// An interval of rows or columns of a raster, in texels.
struct Band {
  double begin = 0.0;
  double end = 0.0;

  double length() const { return end - begin; }
  double middle() const { return 0.5 * (begin + end); }
  friend bool operator==(const Band& a, const Band& b) {
    return a.begin == b.begin && a.end == b.end;
  }
};

/// Windows at the crossings of bands of columns and of rows.
struct BandGrid {
  std::vector<Band> columns;  ///< from the left
  std::vector<Band> rows;     ///< from the top
};

/// The grid of rectangles that explains a labelling best. With X the labels (1 window, 0 wall) and
/// r, c indicators of the rows and columns that windows are in, |X - r c'|^2 is least, up to a
/// constant, where
///
///     sum_ij (2 X_ij - 1) r_i c_j  -  cost (number of bands in r and c)
///
/// is greatest: a rank-one approximation of the labels [Yang, Han, Quan, Tai, "Parsing facade with
/// rank-one approximation", CVPR 2012]. r and c are found in turns, each by dynamic programming
/// over where its bands begin and end, as in [Xiao, Meng, Wang, Pan,
/// "Facade labeling via explicit matrix factorization", 2014], the formulation that Sui et al. use;
/// no pitch is assumed, but
/// bands are 0.6 to 1.25 times as long as the marked window: ornaments between windows may look
/// like windows. Missing windows: where a band of rows crosses a band of columns, each row's
/// (column's) share of the sum counts no less than a quarter of what plain wall would, so that a
/// grid stands if a fifth of its cells are windows.
///
/// \param scores  2 X - 1, height x width; 0 where nothing is known
/// \param columns, rows bands of a window, to begin with
BandGrid fitBandGrid(const Eigen::ArrayXXf& scores, const Band& columns, const Band& rows);

}  // namespace storey::detail
