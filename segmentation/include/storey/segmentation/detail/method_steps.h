// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::detail {

/// The steps of the default method that it can do without, for experiments: which of them matter is
/// measured by `storey_accuracy ablation`. All are on.
struct MethodSteps {
  // The search for wall lines.
  bool locked_directions = true;  ///< the pass with the directions that the lines share
  bool thin_heights = true;       ///< passes for heights with much fewer points than the rest
  bool thin_facades = true;       ///< passes for facades with much fewer points than the rest
  bool main_tiles = true;         ///< parallel walls told apart by the medians of tiles
  bool setbacks = true;           ///< storeys set back by a few deviations told apart
  bool flatness = true;           ///< points that are not of one flat wall cut off, along it
  bool bends = true;              ///< walls ended where they bend
  bool surface_test = true;       ///< lines about which points lie evenly refused
  bool short_walls = true;        ///< jambs and the like searched in what no line took
  bool leftovers = true;          ///< lines that others explain dropped
  // The labelling of the cells.
  bool hypotheses = true;       ///< lines for walls that were not seen
  bool wall_ends = true;        ///< walls not taken beyond where they end beside one not seen
  bool saturated_tiles = true;  ///< evidence in tiles that are full at half the density; else sums
  bool pruning = true;          ///< outlines simplified
  bool transitions = true;      ///< blocks that straddle a change divided
  bool second_pass = true;      ///< all again with the lines in use, refitted
  // The fits.
  bool panes = true;              ///< windows that are set back taken as a mode of their own
  bool shared_directions = true;  ///< walls that agree share one direction
  bool divided_walls = true;      ///< walls that one line does not describe divided
  bool upright = true;            ///< the points turned by what walls lean by together
  bool unseen_walls = true;       ///< walls without points put where their neighbours end
  bool facets = true;             ///< walls taken for two united, edges of noise dropped
};

}  // namespace storey::detail
