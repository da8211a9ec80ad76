// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// A stretch of wall in plan, with the building on its left.
struct WallStretch {
  Eigen::Vector2d start;
  Eigen::Vector2d tangent;  // unit
  double length = 0.0;
  int wall = -1;

  Eigen::Vector2d normal() const { return {tangent.y(), -tangent.x()}; }
};

std::vector<WallStretch> stretchesOf(const Floorplan& plan);

/// Whether the point can be one of a wall: its normal is nearer to the horizontal than to the
/// vertical, or unknown (zero). At 15 degrees of noise 45 are 3 deviations, both for walls and for
/// the roof points along the eaves, which pull walls inwards and tops upwards.
inline bool isWallNormal(const Eigen::Vector3f& normal) {
  return normal.z() * normal.z() <= normal.head<2>().squaredNorm();
}

/// Finds the wall that a point belongs to: a uniform grid over the plan that lists the stretches
/// within `gate` of each cell.
class EdgeIndex {
 public:
  EdgeIndex(std::vector<WallStretch> stretches, double gate);

  /// Numbers of stretches, as a part of the index.
  struct Candidates {
    const int* first = nullptr;
    const int* last = nullptr;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };

  /// The stretch nearest to the point across, at most `gate` away, with the point at least
  /// `margin` (or a quarter of the stretch, if that is less) inside its ends and a normal that
  /// does not contradict; -1 if there is none. \param normal may be zero: unknown
  int nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal, double margin) const;

  /// All stretches that may be within the gate of the point, and others; ascending.
  Candidates candidates(const Eigen::Vector2d& point) const;

  const WallStretch& operator[](std::size_t i) const { return stretches_[i]; }
  std::size_t size() const { return stretches_.size(); }

 private:
  void layGrid();
  // Calls `work(cell)` for all cells that the stretch may be within the gate of.
  template <typename Work>
  void forEachCellNear(const WallStretch& stretch, const Work& work) const;

  std::vector<WallStretch> stretches_;
  double gate_ = 0.0;
  double cell_ = 1.0;
  Eigen::Vector2d low_;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
  std::vector<std::size_t> first_;  // of the candidates of each cell, in `candidates_`
  std::vector<int> candidates_;
};

inline EdgeIndex::Candidates EdgeIndex::candidates(const Eigen::Vector2d& point) const {
  const double x = (point.x() - low_.x()) / cell_;
  const double y = (point.y() - low_.y()) / cell_;
  if (!(x >= 0.0 && y >= 0.0 && x < static_cast<double>(columns_) &&
        y < static_cast<double>(rows_))) {
    return {};
  }
  const auto cell = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(y) * columns_ +
                                             static_cast<std::ptrdiff_t>(x));
  return {candidates_.data() + first_[cell], candidates_.data() + first_[cell + 1]};
}

}  // namespace storey::detail
