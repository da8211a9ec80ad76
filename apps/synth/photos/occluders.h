// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

namespace storey::synth {

/// Poles, trees and cars around a building, that hide parts of it in the photos.
class Occluders {
 public:
  Occluders() = default;
  /// \param box   the building's
  /// \param count of them, poles, trees and cars by turns, near the building's walls
  Occluders(const Eigen::AlignedBox3d& box, int count, std::uint64_t seed);

  struct Hit {
    double distance;  ///< in lengths of the direction
    Eigen::Vector3d color;
  };
  std::optional<Hit> firstHit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

 private:
  struct Ball {
    Eigen::Vector3d center;
    double radius;
    Eigen::Vector3d color;
  };
  struct Block {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d color;
  };
  std::vector<Ball> balls_;
  std::vector<Block> blocks_;
};

}  // namespace storey::synth
