// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/detail/wall_points.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// A piece of a level face over one square of the plan.
struct LevelFace {
  double z = 0.0;
  bool up = true;
  bool ground = false;
};

/// The level faces over one square of the plan, bottom to top.
struct LevelColumn {
  long x = 0;  ///< the how-manieth square
  long y = 0;
  Eigen::Vector2d center;
  std::vector<LevelFace> faces;
};

/// Where level faces were seen, in equal squares of the plan.
struct LevelColumns {
  double side = 0.0;  ///< of each
  std::vector<LevelColumn> columns;
};

/// The level faces that the points show: in each square what lies at one height, flat, and is
/// continued by at least three of the eight squares around. Crowns of trees are not.
/// \param threads 0: all cores
LevelColumns gatherLevelColumns(const std::vector<LevelPoint>& points, const WallScale& scale,
                                unsigned int threads = 1);

/// Marks the ground: surfaces of faces up (squares side by side without a step) that lie, with most
/// of their squares, as low as what is lowest around them: the feet of walls and other faces within
/// a quarter of the extent, with slopes up to 0.1.
/// \param walls points of walls
void markGround(const std::vector<Eigen::Vector3f>& walls, const WallScale& scale,
                LevelColumns& columns);

}  // namespace storey::detail
