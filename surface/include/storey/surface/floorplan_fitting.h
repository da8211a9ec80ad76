// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

namespace storey {

/// The points that floorplans are fitted to, upright (+z is up). `normals` is parallel to
/// `positions`, outwards; a zero normal is unknown and fits every wall.
struct FitPoints {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
};

/// One vertical plane of the building: normal . (x, y) = offset, fitted to all its points.
struct WallFit {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
  double offset = 0.0;
  std::size_t support = 0;     ///< points within the gate; 0: not seen, the line is as it was
  double residual = 0.0;       ///< standard deviation of the points across
  double angle_deviation = 0;  ///< standard deviation of the direction, radians
};

struct FitOptions {
  double noise = 0.0;            ///< standard deviation of the points about their walls, > 0
  double max_shift = 0.0;        ///< a height moves by no more than this in one fit, > 0
  bool share_directions = true;  ///< walls whose directions agree within 3.5 deviations share one
};

/// Fits every wall to all the points of all the layers that use it (the decoded shape of a type is
/// fitted again: doc/method.md, deviation 5), robustly by Tukey's weights, and moves the corners to
/// the intersections of the fitted lines. A ring whose edges would turn around keeps its corners
/// and loses its wall ids. Points whose normals are nearer to the vertical than to the horizontal
/// are of roofs and floors and take no part. \param layers with wall ids, bottom to top with
/// disjoint ranges; changed in place \return the lines by wall id; none, after a PCL_ERROR, for a
/// bad option or normals that are not parallel to the positions
std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options);

/// Moves the boundaries between layers, the foot and the top to where wall points end or start
/// (doc/method.md, deviation 6): the maximum likelihood of a step in the density of the points,
/// blurred by the noise, over all walls that end or start there together. A boundary without such
/// points stays. Layers that shrink below three noise deviations are dropped.
void fitHeights(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                const FitOptions& options);

}  // namespace storey
