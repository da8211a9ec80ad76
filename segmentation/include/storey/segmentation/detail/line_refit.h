// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

/// The lines that bound any block, each shifted to the points of the runs where it does: a point
/// belongs to the nearest run at its place and height that its normal confirms. So a line is fitted
/// to what is a wall only, with all the points, where it was found with a part of them and with
/// what else lies along it. Directions are kept. Robust by Tukey's weights. \return in the order of
/// `plan.lines`; lines that nothing tells of are as they were
std::vector<PlanLine> refitUsedLines(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<CellBlock>& blocks,
                                     const std::vector<WallPoint>& points, double noise,
                                     unsigned int threads = 0);

}  // namespace storey::detail
