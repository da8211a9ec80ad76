// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/point_blocks.h>
#include <storey/segmentation/detail/wall_points.h>

#include <limits>
#include <vector>

namespace storey::detail {

struct FoundLine {
  WallLine line;
  std::vector<int> support;  ///< indices of points
};

/// At 4 degrees from a direction, another is hardly told from it by a short wall.
constexpr double kNearDirection = 0.06981317;  // rad

/// A part of a line, from end to end; all of it by default.
struct LineStretch {
  double s_min = -std::numeric_limits<double>::infinity();
  double s_max = std::numeric_limits<double>::infinity();
};

/// The points that a search begins with, those of no line yet: the longer the search for all lines
/// goes on, the fewer they are.
struct PointPool {
  /// \param free of each point, whether it is of no line yet
  PointPool(const std::vector<WallPoint>& all, const std::vector<char>& free);

  /// Leaves out those that are of a line by now.
  void shrink(const std::vector<char>& free);

  const std::vector<WallPoint>& points;
  std::vector<int> numbers;  ///< of those in the pool, ascending
  PointBlocks blocks;        ///< of these
};

/// Whether a point may be of a line whose first guess this is: near it, and its normal within
/// `kVoteAngle` of the line's.
bool isCandidate(const WallLine& guess, const WallPoint& p, double noise);

/// The points of a pool for which that holds, ascending, near a stretch of the line. \param free of
/// each point, whether it is of no line yet
std::vector<int> candidatesFor(const PointPool& pool, const std::vector<char>& free,
                               const WallLine& line, double noise, const LineStretch& stretch = {});

/// Whether a point lies within `across` of the line, where that has support or a little beyond it,
/// and its normal agrees.
bool explains(const WallLine& line, const WallPoint& p, double across, double noise);

/// Directions of the lines, modulo 180 degrees, as angles in [0, pi), ascending. Those that several
/// lines share, or that have much support, and the perpendiculars of all of them: jambs of notches
/// and ends of wings are often the only walls of their direction.
std::vector<double> directionsOf(const std::vector<FoundLine>& lines);

}  // namespace storey::detail
