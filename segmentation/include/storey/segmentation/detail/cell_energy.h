// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_evidence.h>
#include <storey/segmentation/max_flow.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// A horizontal point: its place, height, and whether it faces up (roof, terrace, ground) or down.
struct LevelPoint {
  Eigen::Vector2d position;
  double z = 0.0;
  bool up = true;
};

/// What the points say about one layer, or several summed; in units of wall area.
struct CellTerms {
  /// A_e of each edge: its length times the height, twice just beyond an end of a wall
  std::vector<double> area;
  std::vector<double> signed_area;  ///< a_e in [-A_e, A_e], what its points confirm
  std::vector<double> unary;        ///< u_c of each cell, cost of being inside

  void add(const CellTerms& other);
};

/// What the walls say about the layer between two bins; nothing in `unary`.
CellTerms termsOfBins(const LineArrangement& plan, const WallEvidence& evidence, std::size_t first,
                      std::size_t last);

/// The terms of each layer. \param levels bins of the boundaries, ascending, at least two
/// \param level_weight of the horizontal points
std::vector<CellTerms> termsOfLayers(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<std::size_t>& levels,
                                     const std::vector<LevelPoint>& level_points,
                                     double level_weight, unsigned int threads = 0);

/// The energy of a labelling:
///
///     E(x) = sum_e [ a_e (x_ahead - x_behind) + gap (A_e - |a_e|) [x_ahead != x_behind] ]
///            + sum_c u_c x_c
///
/// \param gap cost of a wall where no points are, of its area \param inside one a cell
double energyOf(const LineArrangement& plan, const CellTerms& terms, double gap,
                const std::vector<char>& inside);

/// The sum of all costs, by which energies become integers; no less than that of any part of a sum.
double sumOfCosts(const CellTerms& terms);

/// The labelling of least energy, by a minimum cut, and those of least energy that do without some
/// walls. Cells at the border are outside. Of the labellings with the least energy it is the one
/// with the fewest cells inside.
class LabelCut {
 public:
  /// \param gap cost of a wall where no points are, of its area
  LabelCut(const LineArrangement& plan, const CellTerms& terms, double gap);

  /// In units for a sum of terms, of which these are one. \param total sum of all their costs
  LabelCut(const LineArrangement& plan, const CellTerms& terms, double gap, double total);

  /// From now on the labelling is that of the sum of two terms: `own`, those so far, and `others`,
  /// those of a cut in the same units. Of two that are solved only what they disagree on is solved
  /// again.
  void add(const LabelCut& other, const CellTerms& own, const CellTerms& others);

  /// From now on the edge must not separate inside from outside. Only what changes is solved again.
  void tie(std::size_t edge);
  bool tied(std::size_t edge) const { return tied_[edge] != 0; }

  /// \return of each cell: whether it is inside
  std::vector<char> solve();

 private:
  MaxFlow::Capacity integer(double value) const;

  const LineArrangement* plan_;
  double gap_;
  double total_;  // of all costs
  std::vector<char> tied_;
  MaxFlow flow_;  // edges numbered as those of the plan
};

/// The labelling of least energy. \param gap as in `LabelCut` \param inside one a cell
/// \return its energy
double minimumCut(const LineArrangement& plan, const CellTerms& terms, double gap,
                  std::vector<char>& inside);

}  // namespace storey::detail
