// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/surface/detail/edge_index.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Which wall of a stack of floorplans a point is of: the nearest one in the layer at its height,
/// within four noise deviations and clear of the wall's ends, where the points of two walls mix.
class WallAssignment {
 public:
  WallAssignment(const std::vector<FloorplanLayer>& layers, double noise);

  /// The wall's id; -1 if the point is of none, or of one without an id.
  int wallOf(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const;

 private:
  const std::vector<FloorplanLayer>& layers_;
  double margin_ = 0.0;
  std::vector<EdgeIndex> indices_;  // by layer
};

}  // namespace storey::detail
