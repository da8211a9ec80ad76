// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

/// Line segments of one slice to closed rings: Algorithm 1 of [Sui et al. 2016] and its four
/// refinements (completion, snapping, merging, redundancy elimination).
///
/// Notation. A segment is *oriented*: it runs so that the building is on its left; its normal
/// points outwards, to its right. So segments follow each other end to start, outer rings come out
/// counter-clockwise and courtyards clockwise, and opposite faces of a thin wall never link.
namespace storey::detail {

struct LineSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
  std::size_t support = 0;                           ///< number of points
  double residual = 0.0;                             ///< standard deviation of the points across

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double length() const { return (end - start).norm(); }
};

/// Least-squares line through the points, made oriented by `outward`.
/// \param points 2 or more; \param outward approximate normal. A segment too short for its scatter
/// to tell a direction better than `prior_angle` (radians) takes the direction of `outward`
/// instead.
LineSegment fitSegment(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& outward,
                       double prior_angle);

/// `fitSegment` without the points further off than 3 deviations (`noise`, or the median scatter if
/// that is more): near a corner some points have the label of the other wall.
LineSegment fitTrimmedSegment(const std::vector<Eigen::Vector2d>& points,
                              const Eigen::Vector2d& outward, double prior_angle, double noise);

enum class LinkingMethod {
  Optimal,  ///< the cycle cover of all segments with the least length of missing wall
  Greedy,   ///< Algorithm 1: from the longest free segment always on to the nearest one
};

struct LinkingOptions {
  LinkingMethod method = LinkingMethod::Optimal;
  double tolerance = 0.0;  ///< length below which vertices merge and parallel lines are one
  double max_gap = std::numeric_limits<double>::infinity();  ///< t of Algorithm 1
  std::vector<Eigen::Vector2d> directions;  ///< dominant (outward) normals, for completion
};

/// Successors of the segments: `next[i]` follows segment i, -1 if i is in no ring.
std::vector<int> linkSegments(const std::vector<LineSegment>& segments,
                              const LinkingOptions& options);

/// The ring that a cycle of segments encloses, with completion, snapping, merging and redundancy
/// elimination. Empty if fewer than three edges remain. It may still cross itself.
FloorplanRing closeRing(const std::vector<LineSegment>& cycle, const LinkingOptions& options);

/// The region that the rings together wind around counter-clockwise (winding number > 0): a
/// clockwise ring cuts a courtyard out, another one inside it is an island, and the lobe of a
/// self-crossing ring that runs backwards is outside. The result is valid: simple rings without
/// collinear vertices, disjoint components, holes inside; largest component first. Components and
/// holes with less than `min_area` are dropped. An edge has the attributes of the input edge that
/// lies along the longest part of it.
Floorplan assembleFloorplan(const std::vector<FloorplanRing>& rings, double min_area);

}  // namespace storey::detail
