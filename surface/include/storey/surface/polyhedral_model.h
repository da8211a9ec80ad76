// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace storey {

enum class FaceLabel {
  Wall,
  Roof,     ///< faces up
  Ground,   ///< faces down, at the foot of the building
  Ceiling,  ///< faces down, under an overhang
};

/// What a face is of a window that `cutWindows` made. Its `FaceLabel` says which way it faces.
enum class WindowPart {
  None,    ///< not of a window
  Pane,    ///< parallel to the wall
  Reveal,  ///< between wall and pane
};

/// A planar polygon. Seen from outside the solid the outer ring runs counter-clockwise and the
/// inner rings (holes) clockwise. Rings hold indices into `PolyhedralModel::vertices`.
struct PolyhedralFace {
  std::vector<int> outer;
  std::vector<std::vector<int>> inner;
  FaceLabel label = FaceLabel::Wall;
  WindowPart window = WindowPart::None;
  int wall = -1;              ///< `FloorplanEdge::wall` of a wall face, else -1
  int shell = 0;              ///< index of the shell that the face belongs to
  bool hypothetical = false;  ///< guessed: a wall that completion made, or a face of which less
                              ///< than a third has points; see `measureSupport`
  std::size_t support = 0;    ///< points on the face, their normals agreeing
  double coverage = 0.0;      ///< share of its area that has points, in [0, 1]
  double residual = 0.0;      ///< root mean square distance of these points, in the cloud's unit
  /// Standard deviation of the face's plane in the middle of the face, in the cloud's unit;
  /// infinite where the points do not tell.
  double deviation = std::numeric_limits<double>::infinity();
};

/// A closed solid with vertical walls and horizontal caps: the model of a building. Every edge is
/// shared by exactly two faces that run it in opposite senses; coplanar neighbours are one face;
/// no vertex lies inside another face's edge. Parts that touch only along an edge or at a point
/// are separate shells with vertices of their own. `checkModel` tests all of this.
struct PolyhedralModel {
  std::vector<Eigen::Vector3d> vertices;  ///< exact multiples of `grid`, in the cloud's local frame
  std::vector<PolyhedralFace> faces;
  /// Covariances of the vertices, in the cloud's unit squared, parallel to `vertices`; empty if the
  /// model was not fitted to points. Infinite on the diagonal where the points do not tell.
  std::vector<Eigen::Matrix3d> covariances;
  std::vector<FloorplanLayer> storeys;  ///< the floorplans and heights it was made from, bottom up
  double grid = 0.0;                    ///< unit of the integer lattice that the vertices lie on
  int num_shells = 0;

  bool empty() const { return faces.empty(); }
  /// Root mean square displacement of a vertex, expected from `covariances`.
  double vertexDeviation(std::size_t vertex) const {
    return std::sqrt(covariances[vertex].trace());
  }
};

}  // namespace storey
