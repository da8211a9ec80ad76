// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/surface/floorplan_grammar.h>
#include <storey/surface/layer_energy.h>

#include <cstddef>
#include <vector>

namespace storey {

/// Parameters of the energy (11)-(15) of [Sui et al. 2016].
struct DominantFloorplanOptions {
  FloorplanGrammar::Encoding encoding = FloorplanGrammar::Encoding::Walls;
  double length_tolerance = 0.0;  ///< see FloorplanGrammar::setLengthTolerance; > 0
  double smoothness = 0.1;  ///< eta1; the paper names no value. With 0.1 a floorplan that differs
                            ///< wholly from its neighbours is worth a change from two slices on
  double label_cost = 0.5;  ///< eta2; the paper names no value. With 1, the fourth floorplan of its
                            ///< third synthetic building explains less than it costs
  double small_change = 3.0;      ///< k1, between types with 0 < NEdist <= zeta
  double large_change = 9.0;      ///< k2 = 3 k1, between all other types
  double change_threshold = 0.5;  ///< zeta
  bool exact = true;              ///< branch and bound; false: alpha-expansion as in the paper
  std::size_t max_types = 0;      ///< no more types than this; 0: no limit
};

struct DominantFloorplans {
  std::vector<FloorplanLayer> blocks;  ///< runs of slices with the same type, bottom to top;
                                       ///< edges of one wall share their id
  std::vector<int> types;              ///< type of each block, counted from 0 in order of height
  std::vector<int> slice_types;        ///< the same for each slice; -1: no floorplan, skipped
  int num_types = 0;                   ///< types in use
  int num_candidates = 0;  ///< types that were chosen among: different strings of slices
  std::size_t dictionary_size = 0;
  LayerLabeling labeling;  ///< energy, bound, whether it is optimal; labels are candidates
  std::vector<LayerTradeOff> trade_off;  ///< fit against number of types, if minimised exactly
  /// Polygons of the solid over the floorplans of each point of the trade-off, not yet fitted.
  std::vector<std::size_t> trade_off_faces;
};

/// Chooses the dominant floorplans among those of the slices and gives each slice one of them, by
/// minimising (11); then merges neighbouring slices of one type into blocks. Empty floorplans are
/// skipped: they take part in nothing, and a gap of skipped slices between two blocks is shared
/// half and half.
/// \param slices bottom to top
/// \return no blocks if no slice has a floorplan or, after a PCL_ERROR, a tolerance is not positive
DominantFloorplans selectDominantFloorplans(const std::vector<FloorplanLayer>& slices,
                                            const DominantFloorplanOptions& options);

}  // namespace storey
