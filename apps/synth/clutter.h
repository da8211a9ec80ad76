// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "synth/random.h"
#include "synth/surface_sampler.h"

namespace storey::synth {

/// A point that belongs to no building.
struct ClutterPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
};

/// Uniform in the building's box enlarged by 10 % on each side, normals uniform on the sphere.
ClutterPoint drawOutlier(const SurfaceSampler& sampler, Random& random);

/// Gently waved ground around the building: z = foot + relief * waves. Half the building's width
/// of it on each side, nothing under the lowest floorplan; normals up, tilted with the waves.
class GroundAround {
 public:
  GroundAround(const SurfaceSampler& sampler, double relief);
  double heightAt(const Eigen::Vector2d& at) const;
  ClutterPoint draw(Random& random) const;

 private:
  const SurfaceSampler& sampler_;
  double relief_;
  Eigen::AlignedBox2d area_;
};

/// Trees beside the building: a trunk below a ball, 70 % of whose points are near its surface.
/// Crowns keep clear of the walls.
class TreesAround {
 public:
  TreesAround(const SurfaceSampler& sampler, const GroundAround& ground, int count, Random& random);
  ClutterPoint draw(Random& random) const;

 private:
  struct Tree {
    Eigen::Vector3d foot;
    double crown_radius;
    double height;  ///< of the crown's centre above the foot
  };
  std::vector<Tree> trees_;
};

}  // namespace storey::synth
