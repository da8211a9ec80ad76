// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>

#include <vector>

namespace storey::detail {

/// Divides blocks between their neighbours where that lowers
///
///     F = sum_blocks E(x) + cost complexity(x)
///
/// (`complexityOf`): a change of the floorplan that falls inside a layer leaves a block of its own
/// there, with evidence of both outlines. The bins of such a block go to the block below up to the
/// best boundary and above it to the next, whose labels are kept.
/// \param gap as in `CellEnergyOptions` \param cost in units of wall area
void divideTransitions(const LineArrangement& plan, const WallEvidence& evidence, double gap,
                       double cost, std::vector<CellBlock>& blocks);

}  // namespace storey::detail
