// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_evidence.h>
#include <storey/segmentation/floorplan.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// A horizontal point: its place, height, and whether it faces up (roof, terrace, ground) or down.
struct LevelPoint {
  Eigen::Vector2d position;
  double z = 0.0;
  bool up = true;
};

/// Weights of the energy of a labelling, in units of wall area.
struct CellEnergyOptions {
  double gap = 0.5;     ///< gamma: cost of a wall where no points are, of its area
  double block = 0.0;   ///< K: cost of one more block
  double level = 0.25;  ///< weight of the horizontal points
};

/// Layers `first` .. `last` - 1 of the levels as one block, and the cells that are inside in it.
struct CellBlock {
  std::size_t first_bin = 0;
  std::size_t last_bin = 0;
  std::vector<char> inside;      ///< one a cell
  std::vector<double> coverage;  ///< one an edge: share of its area that points confirm, signed
};

/// Decides what is inside: for every block a minimum cut over the cells of the plan, and the blocks
/// themselves so that the sum is least.
///
///     E(x) = sum_e [ a_e (x_ahead - x_behind) + gap (A_e - |a_e|) [x_ahead != x_behind] ]
///            + sum_c u_c x_c,      E = sum_blocks (min E + block)
///
/// A_e is the area of an edge, length times height of the block; a_e in [-A_e, A_e] the signed area
/// that its points confirm: points with normals along the line's minus those against it, over the
/// density of the layer. So a wall that is seen costs -A, one that is guessed gap A, one whose
/// points face the other way A. u_c is the evidence of horizontal points: a roof above means
/// inside, one below outside. Cells at the border are outside. The energy is submodular, each cut
/// is optimal, and dynamic programming over all partitions of the layers makes the blocks so: these
/// are the dominant floorplans of the building.
std::vector<CellBlock> labelCells(const LineArrangement& plan, const WallEvidence& evidence,
                                  const std::vector<std::size_t>& levels,
                                  const std::vector<LevelPoint>& level_points,
                                  const CellEnergyOptions& options);

/// The outlines of the cells inside. `FloorplanEdge::wall` is 2 line + (0: outside is ahead of the
/// line, 1: behind it); an edge of which less than a third is confirmed is hypothetical.
/// \param tolerance corners nearer than this are one \param short_edge shorter edges go where their
/// neighbours meet nearby \param min_area of a component or courtyard
Floorplan outlineOf(const LineArrangement& plan, const CellBlock& block, double tolerance,
                    double short_edge, double min_area);

}  // namespace storey::detail
