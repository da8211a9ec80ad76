// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_ends.h>
#include <storey/segmentation/detail/wall_evidence.h>

#include <vector>

namespace storey::detail {

/// Notes as `WallEvidence::beyond` where walls do not go on, over the heights at which they end and
/// for some length. Nothing is seen there, as where something hides a wall; but that has any
/// outline, and the wall would have to end along it by chance. Without this, the least unseen area
/// decides how neighbours of a missing wall are closed, and two that meet in an obtuse corner need
/// hardly more than a wall between their ends.
/// \param reach how far beyond an end \param apart most distance of a wall from its line
void noteEnds(const LineArrangement& plan, const std::vector<WallEnd>& ends, double reach,
              double apart, WallEvidence& evidence);

}  // namespace storey::detail
