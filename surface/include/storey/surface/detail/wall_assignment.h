// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Which wall of a stack of floorplans a point is of: the nearest one in the layer at its height,
/// within four noise deviations and clear of the wall's ends, where the points of two walls mix.
class WallAssignment {
 public:
  WallAssignment(const std::vector<FloorplanLayer>& layers, double noise);

  /// Ids of the walls that have one, ascending.
  const std::vector<int>& ids() const { return ids_; }

  /// The wall of each point, as its place in `ids`; -1 if the point is of none, or of one without
  /// an id.
  std::vector<int> wallsOf(const FitPoints& points, unsigned int threads) const;

 private:
  int wallOf(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const;

  const std::vector<FloorplanLayer>& layers_;
  double margin_ = 0.0;
  std::vector<int> ids_;
  std::vector<EdgeIndex> indices_;  // by layer; walls as their places in `ids_`
};

}  // namespace storey::detail
