// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "synth/triangle_mesh.h"

namespace storey::synth {

/// Exact distances to a triangle mesh, and what rays hit of it, through a tree of boxes (median
/// split along the longest axis). O(n log^2 n) to build, about O(log n) a query. The mesh is
/// copied.
class TriangleTree {
 public:
  explicit TriangleTree(TriangleMesh mesh);

  static constexpr double kAnywhere = std::numeric_limits<double>::infinity();

  /// Distance to the nearest triangle; infinite if none is nearer than `reach`. A short reach takes
  /// less time.
  double distance(const Eigen::Vector3d& point, double reach = kAnywhere) const;

  /// Distance of each point, in their order.
  std::vector<double> distances(const std::vector<Eigen::Vector3d>& points,
                                double reach = kAnywhere) const;

  struct Hit {
    std::size_t triangle = 0;
    double distance = std::numeric_limits<double>::infinity();  ///< in lengths of the direction
  };

  /// The first triangle that a ray meets, from either side; none if it meets none.
  std::optional<Hit> firstHit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

 private:
  /// A leaf holds order_[first, last); the left child of an inner node follows it.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t first = 0, last = 0;
    std::size_t right = 0;  ///< 0 in a leaf
  };

  std::size_t build(std::size_t first, std::size_t last,
                    const std::vector<Eigen::AlignedBox3d>& boxes);
  void search(std::size_t node, const Eigen::Vector3d& point, double& best) const;

  void search(std::size_t node, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
              Hit& best) const;

  TriangleMesh mesh_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace storey::synth
