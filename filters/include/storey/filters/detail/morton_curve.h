// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// Largest coordinate that is searched: squared distances of points up to here fit into a float.
constexpr float kLargestCoordinate = 1e18f;

/// Whether a position can be searched: finite, and small enough to be squared.
inline bool isSearchable(const Eigen::Vector3f& p) {
  return std::abs(p.x()) <= kLargestCoordinate && std::abs(p.y()) <= kLargestCoordinate &&
         std::abs(p.z()) <= kLargestCoordinate;  // false for NaN
}

/// A Morton curve through 2^21 cells on each axis of a cube: what is near in space is near on it.
class MortonCurve {
 public:
  static constexpr int kAxisBits = 21;
  static constexpr int kCodeBits = 3 * kAxisBits;

  /// Through the cube at the lower corner of a box and as large as its longest side.
  explicit MortonCurve(const Eigen::AlignedBox3d& box);

  /// Where on the curve a position is; of one outside of the cube the cell next to it.
  std::uint64_t codeOf(const Eigen::Vector3f& p) const {
    const std::array<std::uint32_t, 3> cell = cellOf(p);
    return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
  }

  /// The leading bits of the code, a few for each axis. \param axis_bits at most 8
  std::uint32_t leadingBits(const Eigen::Vector3f& p, int axis_bits) const {
    const std::array<std::uint32_t, 3> cell = cellOf(p);
    const int shift = kAxisBits - axis_bits;
    return static_cast<std::uint32_t>(spread(cell[0] >> shift) | spread(cell[1] >> shift) << 1 |
                                      spread(cell[2] >> shift) << 2);
  }

 private:
  std::array<std::uint32_t, 3> cellOf(const Eigen::Vector3f& p) const {
    return {along(0, p), along(1, p), along(2, p)};
  }

  std::uint32_t along(Eigen::Index axis, const Eigen::Vector3f& p) const {
    constexpr double kLast = (1 << kAxisBits) - 1;
    const double cell = (static_cast<double>(p[axis]) - low_[axis]) * scale_;
    return static_cast<std::uint32_t>(std::min(std::max(cell, 0.0), kLast));
  }

  // Two zero bits after each of the 21 bits.
  static std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    v = (v | v << 2) & 0x1249249249249249;
    return v;
  }

  Eigen::Vector3d low_;
  double scale_ = 0.0;  // cells per unit of length
};

/// The part of a box that holds all but a few of the positions on each axis, where the whole is
/// much longer: a few outliers far away would leave one cell of the curve for all the others.
Eigen::AlignedBox3d withoutOutliers(const std::vector<Eigen::Vector3f>& distinct,
                                    Eigen::AlignedBox3d box);

}  // namespace storey::detail
