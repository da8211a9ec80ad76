// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
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
///
/// Deviations are standard ones and hold for points that err independently. The errors of offset
/// and direction are independent too: `offset_deviation` is that of the plane at `centre`, and at
/// the distance s along it has the deviation hypot(offset_deviation, s angle_deviation).
struct WallFit {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
  double offset = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the points, on the plane
  std::size_t support = 0;     ///< points within the gate; 0: not seen, the line is as it was
  double residual = 0.0;       ///< standard deviation of the points across
  double angle_deviation = 0;  ///< of the direction, radians; of all walls that share it, if shared
  double offset_deviation = std::numeric_limits<double>::infinity();  ///< infinite: not seen
};

/// One level of the building: the foot or the top of layers.
struct HeightFit {
  double z = 0.0;
  std::size_t wall_support = 0;  ///< points of walls that end or start there, in the window
  std::size_t cap_support = 0;   ///< points of roofs, grounds and ceilings there, in the window
  double deviation =
      std::numeric_limits<double>::infinity();  ///< standard deviation; infinite: nothing ends
                                                ///< there clearly, the height is as it was
};

struct FitOptions {
  double noise = 0.0;            ///< standard deviation of the points about their walls, > 0
  double max_shift = 0.0;        ///< a height moves by no more than this in one fit, > 0
  bool share_directions = true;  ///< walls whose directions agree within 3.5 deviations share one
  bool find_panes = true;        ///< windows set back are a mode of their own, where they are found
  int rounds = 3;                ///< of giving points to walls and fitting these; two settle
  unsigned int threads = 0;      ///< 0: all cores; the result is the same for any number
};

/// Fits every wall to all the points of all the layers that use it (the decoded shape of a type is
/// fitted again: doc/method.md, deviation 5), robustly by Tukey's weights, and moves the corners to
/// the intersections of the fitted lines. Short edges that would turn around go; a ring with longer
/// ones that would keeps its corners and loses its wall ids. Points whose normals are nearer to the
/// vertical than to the horizontal are of roofs and floors and take no part. \param layers with
/// wall ids, bottom to top with disjoint ranges; changed in place \return the lines by wall id;
/// none, after a PCL_ERROR, for a bad option or normals that are not parallel to the positions
std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options);

/// Moves walls that have next to no points of their own (less than 3 % of the density of the wall
/// in the middle) to where the points of their neighbors end, by the likelihood that `fitHeights`
/// has for levels; their directions stay unless both ends contradict them. \param fits of
/// `fitWalls` for the same layers; changed in place, as the layers are
void fitUnseenWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
                    std::map<int, WallFit>& fits, unsigned int threads = 0);

/// Moves the boundaries between layers, the foot and the top to where the points say they are
/// (doc/method.md, deviation 6): the maximum likelihood of a step in the density of the points of
/// all walls that end or start there, blurred by the noise, and of the points of the level faces
/// there. A boundary that nothing clearly ends at stays. Layers that shrink below three noise
/// deviations are dropped. \return the levels, foot to top, one more than layers are left; none,
/// after a PCL_ERROR, for a bad option
std::vector<HeightFit> fitHeights(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                  const FitOptions& options);

/// How far the walls lean together: what is left of the cloud's tilt when its walls are known.
/// Each wall is fitted as r = a + b s + c z (s along it, r across), robustly, and the direction
/// (u, 1) of the vertical from c = n . u over all walls, again robustly: single walls may lean.
/// \return the rotation about the middle of the layers that sets the points upright; the identity
/// where the lean is below four standard deviations
Eigen::Isometry3d fitUpright(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                             double noise, unsigned int threads = 0);

}  // namespace storey
