// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/flat_face.h>

#include <cstdint>
#include <set>
#include <vector>

/// Validity of solids as ISO 19107 has it, by the numbers that the checkers of city models use,
/// tested on the integers of a file in exact arithmetic.
namespace storey::test {

struct IntegerSolid {
  using Polygon = std::vector<std::vector<int>>;  ///< rings, the outer one first
  using Shell = std::vector<Polygon>;
  std::vector<detail::LatticePoint> vertices;
  std::vector<Shell> shells;  ///< the outer one first
};

enum class IsoError {
  TooFewPoints = 101,       ///< a ring of less than three points
  RepeatedPoint = 102,      ///< consecutive, or the same point twice in a ring
  NotAPolygon = 200,        ///< 104, 201, 202, 206 to 208: rings cross, touch along an edge, ...
  NotPlanar = 203,          ///< a point further from the best plane of its polygon than `planarity`
  TooFewPolygons = 301,     ///< a shell of less than four
  NotClosed = 302,          ///< an edge without a polygon on the other side
  NonManifold = 303,        ///< an edge of several polygons, or a vertex with several fans
  SeveralComponents = 305,  ///< a shell that is not connected
  SelfIntersection = 306,   ///< polygons of a shell that meet elsewhere than at their common edges
  Orientation = 307,        ///< two polygons that run an edge in the same sense
  ShellsMeet = 401,         ///< shells that have a point in common
  InnerOutside = 403,       ///< a cavity that is not inside
  WrongSense = 405,         ///< an outer shell that is inside out, or a cavity that is not
};

/// All that is wrong. Later groups (100s, 200s, ...) are only tested where the earlier are right.
/// \param planarity in the integers' unit
std::set<IsoError> checkSolid(const IntegerSolid& solid, double planarity);

/// Its volume; cavities are subtracted.
double volumeOf(const IntegerSolid& solid);

}  // namespace storey::test
