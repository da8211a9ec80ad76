// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// Lines of sight among facades, through a tree of boxes (median split along the longest axis).
class FacadeSight {
 public:
  explicit FacadeSight(const std::vector<Facade>& facades);

  /// Whether a facade other than `own` is between the eye and a point on `own`.
  bool isBlocked(const Eigen::Vector3d& eye, const Eigen::Vector3d& point, std::size_t own) const;

  /// Number of facades that a ray meets.
  int countCrossings(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

 private:
  struct Flat {
    FacadeFrame frame;
    FacadeOutline outline;
    Eigen::AlignedBox3d box;
  };
  /// A leaf holds order_[first, last); the left child of an inner node follows it.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t first = 0, last = 0;
    std::size_t right = 0;  ///< 0 in a leaf
  };

  std::size_t build(std::size_t first, std::size_t last);
  /// Calls visit(facade) for those met within (0, end) of the direction's length until it is true.
  template <typename Visit>
  bool walk(std::size_t node, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
            double end, const Visit& visit) const;
  bool meets(const Flat& flat, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
             double end) const;

  std::vector<Flat> flats_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace storey::detail
