// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/found_line.h>
#include <storey/segmentation/detail/wall_density.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <vector>

namespace storey::detail {

/// Adds walls that are too short for the votes, as the jambs of a notch: where points that no line
/// explains lie on a line of a known direction so densely that chance hardly does it
/// (`findDensePlaces`), as densely as walls do at these heights, and support the least area of a
/// wall.
/// \param angles of the outward normals that walls may have, rad
/// \param free of each point, whether it is of no line yet
void extractShortWalls(const std::vector<WallPoint>& points, const WallScale& scale,
                       const HeightDensity& density, const WallLineOptions& options,
                       const std::vector<double>& angles, std::vector<char>& free,
                       std::vector<FoundLine>& lines);

}  // namespace storey::detail
