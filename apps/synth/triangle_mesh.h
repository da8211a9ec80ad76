// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace storey::synth {

/// Plain triangles; counter-clockwise seen from outside where the mesh bounds a solid.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`

  bool empty() const { return triangles.empty(); }
  const Eigen::Vector3d& corner(std::size_t triangle, std::size_t i) const {
    return vertices[static_cast<std::size_t>(triangles[triangle][i])];
  }
};

/// Area of each triangle, in the order of the mesh.
std::vector<double> triangleAreas(const TriangleMesh& mesh);

/// Points spread over the surface: the i-th lies at a random place of the i-th of `count` equal
/// parts of the running area, so that each face gets its share to within one point. Empty if the
/// mesh has no area.
std::vector<Eigen::Vector3d> spreadOverSurface(const TriangleMesh& mesh, std::size_t count);

/// Smallest distance of a point to a triangle, corners and edges included. A triangle without area
/// counts as its edges.
double distanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace storey::synth
