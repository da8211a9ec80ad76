// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// A cubic grid over the bulk of a cloud; outlying points fall outside it.
struct VoxelGrid3 {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  double side = 0.0;
  Eigen::Array3i dims = Eigen::Array3i::Zero();

  std::size_t size() const {
    return static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) *
           static_cast<std::size_t>(dims[2]);
  }
  bool contains(const Eigen::Array3i& c) const { return (c >= 0).all() && (c < dims).all(); }
  Eigen::Array3i cellOf(const Eigen::Vector3d& x) const {
    // Clamped first: a far outlier must not overflow the conversion.
    const Eigen::Array3d c = ((x - low) / side).array().floor().max(-1.0);
    return c.min(dims.cast<double>()).cast<int>();
  }
  std::size_t indexOf(const Eigen::Array3i& c) const {
    return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(dims[1]) +
            static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(dims[0]) +
           static_cast<std::size_t>(c[0]);
  }
};

/// What the points of a voxel are.
enum class VoxelKind : std::uint8_t {
  Wall,     ///< normals agree and are nearly horizontal
  Level,    ///< normals agree otherwise: roof, ground, slope
  Clutter,  ///< normals disagree: trees, edges
};

/// A voxel that holds points.
struct OccupiedVoxel {
  Eigen::Array3i cell = Eigen::Array3i::Zero();
  VoxelKind kind = VoxelKind::Clutter;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< mean of its points
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< their common normal up to the sign
  int patch = -1;                                    ///< of a wall voxel
};

/// A connected flat piece of wall, a few voxels wide. Its voxels' axes point the way of `normal`.
struct WallPatch {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  std::vector<int> voxels;
  std::vector<int> flush;  ///< neighbouring patches of the same plane (senses may differ)
};

/// A cloud as voxels: `id_of_cell` is -1 in an empty cell, else a place in `voxels`.
struct WallVoxels {
  VoxelGrid3 grid;
  std::vector<std::int32_t> id_of_cell;
  std::vector<OccupiedVoxel> voxels;
  std::vector<WallPatch> patches;
};

/// \param positions, normals z is up; normals are unit, of any sign
/// \param side of a voxel; enlarged if there would be more than 16 million of them
WallVoxels buildWallVoxels(const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Eigen::Vector3d>& normals, double side,
                           int num_threads);

}  // namespace storey::detail
