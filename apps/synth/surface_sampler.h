// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "synth/random.h"

namespace storey::synth {

/// Which faces of the true model get points.
enum class SampledFaces {
  Walls,          ///< walls only: photos taken from the ground see nothing else
  WallsAndRoofs,  ///< and all that faces up
  All,            ///< and ceilings of overhangs and the ground face
};

/// A point drawn on the surface of the true model.
struct SurfaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outwards
  int wall = -1;             ///< id of the wall's plane, -1 on a horizontal face
  double along = 0.0;        ///< distance from the start of the wall's edge
  double edge_length = 0.0;  ///< length of that edge
};

/// Draws points uniformly by area from the surface of stacked floorplans. A wall of a layer is
/// outside everything else, so it is exposed as a whole; a plan is exposed where the next layer
/// does not cover it. Horizontal faces are drawn by rejection: a candidate outside the plan or
/// under the next layer makes the whole draw start again, which keeps the density equal
/// everywhere.
class SurfaceSampler {
 public:
  SurfaceSampler(std::vector<FloorplanLayer> layers, SampledFaces faces);

  SurfaceSample draw(Random& random) const;

  /// Area of all walls, in square units.
  double wallArea() const { return wall_area_; }

  /// The layers' box, from the foot to the top.
  const Eigen::AlignedBox3d& box() const { return box_; }

  const std::vector<FloorplanLayer>& layers() const { return layers_; }

  /// Number of different wall ids.
  int numWalls() const { return num_walls_; }

 private:
  struct WallPatch {
    Eigen::Vector2d from, to;
    double z_min, z_max;
    int wall;
  };
  struct Cap {
    std::size_t layer;
    Floorplan plan;  ///< a single component of the layer
    bool faces_up;
    Eigen::AlignedBox2d box;
  };

  void addWalls(const FloorplanLayer& layer, const FloorplanRing& ring);
  void addCaps(std::size_t layer, SampledFaces faces);
  SurfaceSample drawOnWall(const WallPatch& wall, Random& random) const;
  bool drawOnCap(const Cap& cap, Random& random, SurfaceSample& sample) const;

  std::vector<FloorplanLayer> layers_;
  std::vector<WallPatch> walls_;
  std::vector<Cap> caps_;
  std::vector<double> area_until_;  ///< running sum over the walls, then the boxes of the caps
  double wall_area_ = 0.0;
  Eigen::AlignedBox3d box_;
  int num_walls_ = 0;
};

}  // namespace storey::synth
