// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>

#include <vector>

namespace storey::detail {

/// Simplifies the outlines of the blocks: what is in the model must earn what it adds to its
/// description. Lowers, step by step,
///
///     F = sum_blocks E(x) + cost (complexity(x) + lines(x))
///
/// where complexity(x) is `complexityOf` and lines(x) the number of lines that bound any block,
/// without those that were guessed. A step
/// - forbids one run of an outline in its block, or the runs that continue each other through
///   several blocks, or one line in all blocks, and cuts again: the new outline is the best of all
///   that do without it, wherever it then runs;
/// - or makes one block of two neighbours, also where F stays as it is.
/// Runs and lines with little to show are tried first; those that have seen clearly more than the
/// cost are not tried.
/// \param gap as in `CellEnergyOptions` \param cost in units of wall area \param may_vanish whether
/// nothing at all is an outcome, where nothing earns its cost \param threads 0: all cores; the
/// result is the same for any number
void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks, bool may_vanish = true,
                   unsigned int threads = 0);

}  // namespace storey::detail
