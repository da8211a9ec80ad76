// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>

#include <vector>

namespace storey::detail {

/// Simplifies the outlines of the blocks: a wall must earn what it adds to the description of the
/// building. Lowers, step by step,
///
///     F = sum_blocks [ E(x) + cost runs(x) ] + cost lines(x)
///
/// where a run is a stretch of a line that bounds the inside from one side without a break (an edge
/// of the outline), and lines(x) counts the lines with a run in any block. A step forbids one run in
/// its block, or one line in all blocks, and cuts again: the new outline is the best of all that do
/// without it, wherever it then runs. Runs and lines with little to show are tried first; those
/// that have seen clearly more than the cost are not tried.
/// \param gap as in `CellEnergyOptions` \param cost in units of wall area
void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks);

}  // namespace storey::detail
