// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/points_by_wall.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Divides walls that were taken for one although no line describes them: two that lie apart and a
/// little beside each other, in two components or on both sides of a recess, look like one that is
/// turned. The pieces of a wall are its stretches without a break. A line for each describes the
/// points better than one by a sum of squares that follows, if it is one wall, a chi-squared
/// distribution with two degrees of freedom a piece but for two; that has to exceed what chance
/// would give in one building of a hundred, and one of the pieces lies more than a noise deviation
/// off the line of the one with most points. Pieces of a wall that was refuted get ids of their
/// own. \param by_wall the points of the layers \param fits the walls' lines \return whether there
/// were any
bool divideWalls(const PointsByWall& by_wall, const std::map<int, WallFit>& fits, double noise,
                 unsigned int threads, std::vector<FloorplanLayer>& layers);

}  // namespace storey::detail
