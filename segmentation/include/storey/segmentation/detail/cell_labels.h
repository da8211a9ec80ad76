// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/floorplan.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Weights of the energy of a labelling, in units of wall area.
struct CellEnergyOptions {
  double gap = 0.5;     ///< gamma: cost of a wall where no points are, of its area
  double block = 0.0;   ///< K: cost of one more block
  double level = 0.25;  ///< weight of the horizontal points
};

/// The layers between two bins as one block, and the cells that are inside in it.
struct CellBlock {
  std::size_t first_bin = 0;
  std::size_t last_bin = 0;
  double energy = 0.0;
  std::vector<char> inside;      ///< one a cell
  CellTerms terms;               ///< of all its layers
  std::vector<double> coverage;  ///< one an edge: share of its area that points confirm, signed

  void measureCoverage();  ///< from the terms
};

/// Decides what is inside: for every block a minimum cut over the cells of the plan (`minimumCut`),
/// and the blocks themselves so that the sum E = sum_blocks (min E + block) is least.
///
/// A wall that is seen earns its area, one that is guessed costs `gap` of it, one whose points face
/// the other way costs all of it. A roof above a cell means inside, one below outside. The energy
/// is submodular, each cut is optimal, and dynamic programming over all partitions of the layers
/// makes the blocks so: these are the dominant floorplans of the building.
/// \param threads 0: all cores; the result is the same for any number
std::vector<CellBlock> labelCells(const LineArrangement& plan, const WallEvidence& evidence,
                                  const std::vector<std::size_t>& levels,
                                  const std::vector<LevelPoint>& level_points,
                                  const CellEnergyOptions& options, unsigned int threads = 0);

/// The outlines of the cells inside. `FloorplanEdge::wall` is 2 line + (0: outside is ahead of the
/// line, 1: behind it); an edge of which less than a third is confirmed is hypothetical.
/// \param tolerance corners nearer than this are one \param short_edge shorter edges go where their
/// neighbours meet nearby \param min_area of a component or courtyard
Floorplan outlineOf(const LineArrangement& plan, const CellBlock& block, double tolerance,
                    double short_edge, double min_area);

}  // namespace storey::detail
