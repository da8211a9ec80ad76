// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "synth/surface_sampler.h"

namespace storey::synth {

/// What real clouds have and the paper's protocol has not. Shares are between 0 and 1; lengths in
/// the building's units; 0 (or 1 for `density_falloff`) switches a defect off.
struct Defects {
  double missing_patches = 0.0;  ///< share of the sampled surface hidden by balls
  double patch_radius = 1.5;     ///< of these balls
  double missing_walls = 0.0;    ///< share of the walls (planes) without points, at least one
  double missing_side = 0.0;     ///< how much of one side has no points, from its left end on
  double side_half_angle = 0.6;  ///< rad; walls whose normals are this near belong to the side
  double missing_foot = 0.0;     ///< share of the height, from below, without points
  double density_falloff = 1.0;  ///< density at the foot / density at the top, exponential
  double heavy_tails = 0.0;      ///< share of the points whose noise is `tail_factor` times higher
  double tail_factor = 5.0;
  double windows = 0.0;  ///< share of the wall area that is recessed
  double window_depth = 0.2;
  double window_pitch = 3.0;     ///< from window to window, along the wall and upwards
  double flipped_normals = 0.0;  ///< share of the normals that point inwards
  double outliers = 0.0;         ///< uniform in the box + 10 %, as a share of the points asked for
  double ground = 0.0;           ///< points of the ground around, as a share of the same
  double ground_relief = 0.3;    ///< amplitude of its waves
  double trees = 0.0;            ///< points of trees, as a share of the same
  int tree_count = 6;
};

/// Whether all values lie in their ranges.
bool areValid(const Defects& defects);

/// Decides which of the drawn points the cloud does not have. The share of patches is met by
/// adding balls until that share of 20,000 probes is hidden.
class HiddenSurface {
 public:
  HiddenSurface(const SurfaceSampler& sampler, const Defects& defects, std::uint64_t seed);

  /// Takes the same amount of randomness for every point, hidden or not.
  bool hides(const SurfaceSample& sample, Random& random) const;

 private:
  void choosePatches(const SurfaceSampler& sampler, Random& random);
  void chooseWalls(int num_walls, Random& random);
  void chooseSide(const SurfaceSampler& sampler, Random& random);
  bool isOnHiddenSide(const SurfaceSample& sample) const;

  Defects defects_;
  double z_min_ = 0.0;
  double height_ = 0.0;
  std::vector<Eigen::Vector3d> patch_centers_;
  std::vector<char> is_wall_hidden_;
  Eigen::Vector2d side_normal_ = Eigen::Vector2d::UnitX();
  double side_end_ = 0.0;  ///< hidden up to here, seen along the side
};

/// Moves a point of a wall inwards if it falls on a window: squares centred in a raster of
/// `window_pitch`, of a size that gives the share of the area.
Eigen::Vector3d recessed(const SurfaceSample& sample, const Defects& defects);

}  // namespace storey::synth
