// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/openness.h>
#include <storey/features/detail/outward_signs.h>

#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr double kWallNormal = 0.5;  // |n.z| of a wall, 30 degrees
constexpr double kSameWall = 0.7;    // |n.axis| of a point of that wall, 45 degrees

// The wall voxel that a point follows: its own, else the one around it whose axis is nearest to the
// normal; -1 if there is none.
int wallOf(const WallVoxels& walls, const Eigen::Vector3d& x, const Eigen::Vector3d& n) {
  const Eigen::Array3i cell = walls.grid.cellOf(x);
  int best = -1;
  double best_agreement = kSameWall;
  for (int k = 0; k < 27; ++k) {
    const Eigen::Array3i c = cell + Eigen::Array3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const std::int32_t id = walls.grid.contains(c) ? walls.id_of_cell[walls.grid.indexOf(c)] : -1;
    if (id < 0 || walls.voxels[static_cast<std::size_t>(id)].kind != VoxelKind::Wall) {
      continue;
    }
    if ((c == cell).all()) {
      return id;
    }
    const double agreement = std::abs(walls.voxels[static_cast<std::size_t>(id)].axis.dot(n));
    if (agreement > best_agreement) {
      best_agreement = agreement;
      best = id;
    }
  }
  return best;
}

}  // namespace

OutwardSigns findOutwardSigns(const std::vector<Eigen::Vector3d>& positions,
                              const std::vector<Eigen::Vector3d>& normals, double side,
                              int num_threads) {
  const WallVoxels walls = buildWallVoxels(positions, normals, side);
  const std::vector<double> outsides = findOutsides(walls, num_threads);
  OutwardSigns result;
  result.sign.assign(positions.size(), 1);
  result.confidence.assign(positions.size(), 0.0f);
  double sum = 0.0;
  std::size_t num_walls = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::abs(normals[i].z()) >= kWallNormal) {
      result.sign[i] = normals[i].z() < 0.0 ? -1 : 1;
      result.confidence[i] = 1.0f;
      continue;
    }
    ++num_walls;
    const int id = wallOf(walls, positions[i], normals[i]);
    if (id >= 0) {
      const OccupiedVoxel& voxel = walls.voxels[static_cast<std::size_t>(id)];
      const double outside = outsides[static_cast<std::size_t>(voxel.patch)];
      result.sign[i] = outside * voxel.axis.dot(normals[i]) < 0.0 ? -1 : 1;
      result.confidence[i] = static_cast<float>(std::abs(outside));
      sum += std::abs(outside);
    }
  }
  result.wall_confidence = num_walls > 0 ? sum / static_cast<double>(num_walls) : 0.0;
  return result;
}

}  // namespace storey::detail
