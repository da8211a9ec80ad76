// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/oriented_point.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

/// What a point is of, as far as its surroundings tell.
enum class PointClass : unsigned char {
  Wall,       ///< a surface that stands upright
  Level,      ///< a roof or terrace, or a level face seen from below
  Ground,     ///< the level surface at the feet of the walls
  Sloped,     ///< a surface that leans, such as a pitched roof
  NonPlanar,  ///< no surface: vegetation, edges, clutter
  Apart,      ///< of a small group that a gap separates from all that is large
  Small       ///< a surface smaller than any wall: vegetation, clutter
};
constexpr int kNumPointClasses = 7;

/// Largest |n.up| of a point that may be of a wall: 17 degrees.
constexpr double kUprightNormalZ = 0.3;

/// Sorts points into classes from the points alone: no model takes part.
///
/// - What is not `planar` is NonPlanar.
/// - Level faces are told from the ground by `markGround`.
/// - Upright are points with |n.up| < 0.3, unless the mean normal in the cube around leans by more
///   than 8 degrees, beyond three deviations of that mean; fewer than 8 points tell none.
/// - Small are planar points that are no ground and have no patch (`findPlanarPatches`) as large as
///   the least wall in the cubes around them, each of a quarter of that wall's side; a patch with
///   less than half of the points at its place does not count. Crowns of trees are planar over a
///   neighbourhood, but not over a wall. What is small and beside something large, such as the
///   reveals of windows, stays what it is.
/// - Groups are connected planar points that are neither, with gaps of up to half the side of the
///   least wall. Apart are those with less than a tenth of the upright points of the largest group:
///   cars, free-standing trees, neighbours cut by the edge of the cloud. What touches the building,
///   or is as large as a part of it, is not.
/// \param planar parallel to the points \param least_wall area of the least wall, > 0
/// \param threads 0: all cores \return parallel to the points
std::vector<PointClass> classifyPoints(const std::vector<OrientedPoint>& points,
                                       const std::vector<char>& planar, const WallScale& scale,
                                       double least_wall, unsigned int threads = 1);

}  // namespace storey::detail
