// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes CityJSON 2.0: a Building or, where the model has several solids, a Building of
/// BuildingParts. Each is a Solid of LoD 2.2, its surfaces WallSurface, RoofSurface, GroundSurface
/// and OuterCeilingSurface with wall, hypothetical and, of models that were fitted to points,
/// support, coverage, residual and deviation (null: not known); and one of LoD 1.2, the block over
/// all that it covers in plan. The attribute `storeys` holds heights and areas of the floorplans.
///
/// Vertices are integers. Where `local_to_input` does not turn, they are the model's own lattice,
/// on which `checkModel` holds exactly. Else the scale is a tenth of the grid: rounding moves
/// vertices by less than 0.09 grid units, and none lies within half a unit of an edge of its
/// shell that it is not an end of. Corners within a straight run of a polygon then stray from it by
/// as much; cut by a Delaunay triangulation, as checkers do, no two polygons touch for that.
/// \throws io::Failure (CannotCreate, IoError)
void writeCityJson(const std::string& path, const Exported& exported);

}  // namespace storey::exports
