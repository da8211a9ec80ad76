// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_points.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

/// Where the points bend, as those of two walls do that meet at a small angle, the side with more
/// of them; the whole support where they do not. A bend is the place where two lines that meet
/// describe the points clearly better than one, and where their normals turn the same way: panes
/// that are set back move places alone. \param support of `points`, in the line's coordinates
LinePoints onOneSideOfBend(const std::vector<WallPoint>& points, LinePoints support,
                           const WallScale& scale, const WallLine& line);

}  // namespace storey::detail
