// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/detail/cell_neighbors.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// A stretch of a line that bounds the inside from one side without a break: an edge of an outline.
struct OutlineRun {
  std::size_t first = 0;  ///< edges of the plan, one after the other along their line
  std::size_t last = 0;
  int side = 0;       ///< +1: the inside is behind the line, -1: ahead of it
  double seen = 0.0;  ///< area that points confirm
};

/// The runs of one block's outline, by line and then along it.
std::vector<OutlineRun> runsOf(const LineArrangement& plan, const CellTerms& terms,
                               const std::vector<char>& inside);

/// One block of a stack: its labels and their runs.
struct BlockOutline {
  const std::vector<char>* inside;
  const std::vector<OutlineRun>* runs;
};

/// Number of walls of a stack, given the runs of each block: those of neighbouring blocks that meet
/// are one, and a run may go on in several of the next block, and several in one.
std::size_t countWalls(const std::vector<const std::vector<OutlineRun>*>& blocks);

/// Number of faces of the solid that stands on the outlines, bottom to top: the runs, those of
/// neighbouring blocks that meet being one, and the connected parts of what one block covers and
/// its neighbour does not.
std::size_t countFaces(const LineArrangement& plan, const std::vector<BlockOutline>& blocks);

/// Number of connected parts of all blocks but the lowest that rest on nothing of the block below.
std::size_t countFloating(const LineArrangement& plan, const std::vector<BlockOutline>& blocks);

/// What a stack of outlines costs to describe, in faces: `countFaces`, and more for each part that
/// floats, which no building has.
double complexityOf(const LineArrangement& plan, const std::vector<BlockOutline>& blocks);

/// The part of `complexityOf` that two neighbouring blocks alone decide, all but the walls.
/// \param lower, upper their labels; null: there is no block
double jointComplexity(const CellNeighbors& neighbors, const std::vector<char>* lower,
                       const std::vector<char>* upper);

}  // namespace storey::detail
