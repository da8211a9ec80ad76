// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/openness.h>
#include <storey/features/detail/outward_signs.h>
#include <storey/filters/detail/chunks.h>

#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr double kWallNormal = 0.5;  // |n.z| of a wall, 30 degrees
constexpr double kSameWall = 0.7;    // |n.axis| of a point of that wall, 45 degrees

// The id of the wall voxel in a cell, -1 if there is none.
int wallIn(const WallVoxels& walls, const Eigen::Array3i& cell) {
  if (!walls.grid.contains(cell)) return -1;
  const std::int32_t id = walls.id_of_cell[walls.grid.indexOf(cell)];
  return id >= 0 && walls.voxels[static_cast<std::size_t>(id)].kind == VoxelKind::Wall ? id : -1;
}

// The wall voxel that a point follows: its own, else the one around it whose axis is nearest to the
// normal; -1 if there is none.
int wallOf(const WallVoxels& walls, const Eigen::Vector3d& x, const Eigen::Vector3d& n) {
  const Eigen::Array3i cell = walls.grid.cellOf(x);
  int best = wallIn(walls, cell);
  if (best >= 0) return best;
  double best_agreement = kSameWall;
  for (int k = 0; k < 27; ++k) {
    const int id = wallIn(walls, cell + Eigen::Array3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
    if (id < 0) continue;
    const double agreement = std::abs(walls.voxels[static_cast<std::size_t>(id)].axis.dot(n));
    if (agreement > best_agreement) {
      best_agreement = agreement;
      best = id;
    }
  }
  return best;
}

struct Confidence {
  double sum = 0.0;
  std::size_t points = 0;

  Confidence& operator+=(const Confidence& other) {
    sum += other.sum;
    points += other.points;
    return *this;
  }
};

}  // namespace

OutwardSigns findOutwardSigns(const std::vector<Eigen::Vector3d>& positions,
                              const std::vector<Eigen::Vector3d>& normals, double side,
                              int num_threads) {
  const WallVoxels walls = buildWallVoxels(positions, normals, side, num_threads);
  const std::vector<double> outsides = findOutsides(walls, num_threads);
  OutwardSigns result;
  result.sign.assign(positions.size(), 1);
  result.confidence.assign(positions.size(), 0.0f);
  const auto judge = [&](std::size_t i, Confidence& of_walls) {
    if (std::abs(normals[i].z()) >= kWallNormal) {
      result.sign[i] = normals[i].z() < 0.0 ? -1 : 1;
      result.confidence[i] = 1.0f;
      return;
    }
    ++of_walls.points;
    const int id = wallOf(walls, positions[i], normals[i]);
    if (id < 0) return;
    const OccupiedVoxel& voxel = walls.voxels[static_cast<std::size_t>(id)];
    const double outside = outsides[static_cast<std::size_t>(voxel.patch)];
    result.sign[i] = outside * voxel.axis.dot(normals[i]) < 0.0 ? -1 : 1;
    result.confidence[i] = static_cast<float>(std::abs(outside));
    of_walls.sum += std::abs(outside);
  };
  const Confidence all = sumByChunks(
      positions.size(), static_cast<unsigned int>(num_threads), std::vector<Confidence>(1),
      [&](std::size_t begin, std::size_t end, std::vector<Confidence>& sums) {
        for (std::size_t i = begin; i < end; ++i) judge(i, sums.front());
      })[0];
  result.wall_confidence = all.points > 0 ? all.sum / static_cast<double>(all.points) : 0.0;
  return result;
}

}  // namespace storey::detail
