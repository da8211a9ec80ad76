// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "io/polygon_soup.h"
#include "synth/triangle_mesh.h"

namespace storey::synth {

/// A polygon mesh made ready for measuring.
struct PolygonMesh {
  TriangleMesh triangles;        ///< over all vertices of the file
  std::vector<int> piece_of;     ///< index into the soup's polygons, for each triangle
  std::vector<int> polygon_of;   ///< for each of the soup's polygons: the merged one it is in
  std::size_t num_polygons = 0;  ///< after merging coplanar neighbours
  std::vector<Eigen::Vector3d> vertices;  ///< those that a polygon uses
  std::vector<Eigen::Vector3d> corners;   ///< those where three or more merged polygons meet
  std::size_t num_broken = 0;             ///< polygons that could not be triangulated: left out
};

/// Triangulates the polygons and merges those that are pieces of one: neighbours across an edge,
/// in the same shell and with the same label, whose normals agree and that either carry the same
/// wall id or lie in one plane to 2e-5 of the extent (models are rounded to about 1e-5 of it).
PolygonMesh measurable(const io::PolygonSoup& soup);

/// Sum of the cross products of a polygon's neighbouring corners: twice the area, along the normal
/// (Newell). Correct for polygons that are not convex.
Eigen::Vector3d areaNormal(const io::PolygonSoup& soup, const io::PolygonSoup::Polygon& polygon);

/// The mean normal of the faces labelled roof: the vertical that the model was built with. Exactly
/// +z if they differ from it by rounding only, or if there are none.
Eigen::Vector3d upOfModel(const io::PolygonSoup& soup);

}  // namespace storey::synth
