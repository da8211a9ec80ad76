// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace storey::view {

/// A wall as it was found, in the upright local frame.
struct SeenWall {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();               ///< outwards
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> runs;  ///< where it was seen, in plan
  double z_min = 0.0;
  double z_max = 0.0;
};

/// The cells of the plan and in which blocks they are inside.
struct PlanCells {
  struct Cell {
    std::vector<Eigen::Vector2d> corners;  ///< 3 or more, convex
    std::vector<bool> inside;              ///< parallel to `blocks`
  };
  std::vector<std::pair<double, double>> blocks;  ///< z_min, z_max, bottom to top
  std::vector<Cell> cells;
};

// Both read what storey_reconstruct --intermediate wrote as untrusted.
// \throws io::Failure (BadInput, MissingInput, IoError)
std::vector<SeenWall> readWalls(const std::string& path);
PlanCells readCells(const std::string& path);

}  // namespace storey::view
