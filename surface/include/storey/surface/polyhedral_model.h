// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <vector>

namespace storey {

enum class FaceLabel {
  Wall,
  Roof,     ///< faces up
  Ground,   ///< faces down, at the foot of the building
  Ceiling,  ///< faces down, under an overhang
};

/// A planar polygon. Seen from outside the solid the outer ring runs counter-clockwise and the
/// inner rings (holes) clockwise. Rings hold indices into `PolyhedralModel::vertices`.
struct PolyhedralFace {
  std::vector<int> outer;
  std::vector<std::vector<int>> inner;
  FaceLabel label = FaceLabel::Wall;
  int wall = -1;              ///< `FloorplanEdge::wall` of a wall face, else -1
  int shell = 0;              ///< index of the shell that the face belongs to
  bool hypothetical = false;  ///< a wall that completion made, not seen in the points
};

/// A closed solid with vertical walls and horizontal caps: the model of a building. Every edge is
/// shared by exactly two faces that run it in opposite senses; coplanar neighbours are one face;
/// no vertex lies inside another face's edge. Parts that touch only along an edge or at a point
/// are separate shells with vertices of their own. `checkModel` tests all of this.
struct PolyhedralModel {
  std::vector<Eigen::Vector3d> vertices;  ///< exact multiples of `grid`, in the cloud's local frame
  std::vector<PolyhedralFace> faces;
  std::vector<FloorplanLayer> storeys;  ///< the floorplans and heights it was made from, bottom up
  double grid = 0.0;                    ///< unit of the integer lattice that the vertices lie on
  int num_shells = 0;

  bool empty() const { return faces.empty(); }
};

}  // namespace storey
