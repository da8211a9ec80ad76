// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/wall_voxels.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kMostVoxels = 1.6e7;  // 64 MB
constexpr double kOutliers = 0.001;    // share of the points cut off at each end of each axis
constexpr int kMargin = 2;             // empty voxels around the points
constexpr double kAgreement = 0.6;     // share of the largest eigenvalue in sum n n^T
constexpr double kWallAxis = 0.5;      // |axis.z| of a wall, 30 degrees
constexpr double kSameAxis = 0.9;      // 26 degrees
constexpr double kSamePlane = 0.75;    // voxel sides between two voxels of one plane
constexpr int kPatchRadius = 4;        // voxels around the seed of a patch

double quantile(std::vector<double>& values, double share) {
  const auto place =
      values.begin() +
      static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

VoxelGrid3 gridOver(const std::vector<Eigen::Vector3d>& positions, double side, int num_threads) {
  Eigen::Array3d low;
  Eigen::Array3d high;
#pragma omp parallel for num_threads(num_threads) schedule(dynamic, 1)
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values(positions.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = positions[i][axis];
    }
    low[axis] = quantile(values, kOutliers);
    high[axis] = quantile(values, 1.0 - kOutliers);
  }
  VoxelGrid3 grid;
  grid.side = side;
  for (;; grid.side *= 1.25) {
    const Eigen::Array3d dims = ((high - low) / grid.side).ceil() + 2.0 * kMargin;
    if (dims.prod() <= kMostVoxels) {
      grid.dims = dims.cast<int>();
      break;
    }
  }
  const Eigen::Array3d slack = grid.dims.cast<double>() * grid.side - (high - low);
  grid.low = low - slack / 2.0;
  return grid;
}

void classify(const Eigen::Matrix3d& spread, OccupiedVoxel& voxel) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  voxel.axis = solver.eigenvectors().col(2);
  if (solver.eigenvalues()[2] < kAgreement * spread.trace()) {
    voxel.kind = VoxelKind::Clutter;
  } else {
    voxel.kind = std::abs(voxel.axis.z()) < kWallAxis ? VoxelKind::Wall : VoxelKind::Level;
  }
}

void fillVoxels(const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3d>& normals, int num_threads, WallVoxels& result) {
  result.id_of_cell.assign(result.grid.size(), -1);
  std::vector<Eigen::Matrix3d> spread;  // sum n n^T of each voxel
  std::vector<double> counts;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Array3i cell = result.grid.cellOf(positions[i]);
    if (!result.grid.contains(cell)) {
      continue;
    }
    std::int32_t& id = result.id_of_cell[result.grid.indexOf(cell)];
    if (id < 0) {
      id = static_cast<std::int32_t>(result.voxels.size());
      result.voxels.emplace_back().cell = cell;
      spread.emplace_back(Eigen::Matrix3d::Zero());
      counts.push_back(0.0);
    }
    const auto v = static_cast<std::size_t>(id);
    spread[v] += normals[i] * normals[i].transpose();
    result.voxels[v].center += positions[i];
    counts[v] += 1.0;
  }
#pragma omp parallel for num_threads(num_threads) schedule(dynamic, 256)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(result.voxels.size()); ++i) {
    const auto v = static_cast<std::size_t>(i);
    result.voxels[v].center /= counts[v];
    classify(spread[v], result.voxels[v]);
  }
}

// Calls visit(id) for the occupied ones among the 26 neighbours of a voxel.
template <typename Visit>
void forNeighbors(const WallVoxels& all, const OccupiedVoxel& voxel, const Visit& visit) {
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Eigen::Array3i cell = voxel.cell + Eigen::Array3i(dx, dy, dz);
        const bool inside = all.grid.contains(cell);
        const std::int32_t id = inside ? all.id_of_cell[all.grid.indexOf(cell)] : -1;
        if (id >= 0) {
          visit(id);
        }
      }
    }
  }
}

bool samePlane(const OccupiedVoxel& a, const OccupiedVoxel& b, double side) {
  return std::abs(a.axis.dot(b.axis)) > kSameAxis &&
         std::abs((b.center - a.center).dot(a.axis)) < kSamePlane * side;
}

// Grows a patch from a wall voxel over connected wall voxels near it in the same plane.
void growPatch(WallVoxels& all, int seed_id) {
  const auto patch_id = static_cast<int>(all.patches.size());
  const OccupiedVoxel seed = all.voxels[static_cast<std::size_t>(seed_id)];
  WallPatch patch;
  patch.voxels.push_back(seed_id);
  all.voxels[static_cast<std::size_t>(seed_id)].patch = patch_id;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t next = 0; next < patch.voxels.size(); ++next) {
    const OccupiedVoxel current = all.voxels[static_cast<std::size_t>(patch.voxels[next])];
    sum += current.axis;
    forNeighbors(all, current, [&](int id) {
      OccupiedVoxel& other = all.voxels[static_cast<std::size_t>(id)];
      if (other.kind == VoxelKind::Wall && other.patch < 0 &&
          samePlane(seed, other, all.grid.side) &&
          (other.cell - seed.cell).abs().maxCoeff() <= kPatchRadius) {
        other.patch = patch_id;
        other.axis *= other.axis.dot(seed.axis) < 0.0 ? -1.0 : 1.0;
        patch.voxels.push_back(id);
      }
    });
  }
  patch.normal = sum.normalized();
  all.patches.push_back(patch);
}

// Patches that touch in one plane: they are one wall, cut only by the size of a patch.
void findFlushPatches(int num_threads, WallVoxels& all) {
#pragma omp parallel for num_threads(num_threads) schedule(dynamic, 16)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(all.patches.size()); ++i) {
    WallPatch& patch = all.patches[static_cast<std::size_t>(i)];
    for (const int id : patch.voxels) {
      const OccupiedVoxel& voxel = all.voxels[static_cast<std::size_t>(id)];
      forNeighbors(all, voxel, [&](int other_id) {
        const OccupiedVoxel& other = all.voxels[static_cast<std::size_t>(other_id)];
        if (other.patch >= 0 && other.patch != voxel.patch &&
            samePlane(voxel, other, all.grid.side)) {
          patch.flush.push_back(other.patch);
        }
      });
    }
    std::sort(patch.flush.begin(), patch.flush.end());
    patch.flush.erase(std::unique(patch.flush.begin(), patch.flush.end()), patch.flush.end());
  }
}

}  // namespace

WallVoxels buildWallVoxels(const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Eigen::Vector3d>& normals, double side,
                           int num_threads) {
  WallVoxels result;
  if (positions.empty()) {
    return result;
  }
  result.grid = gridOver(positions, side, num_threads);
  fillVoxels(positions, normals, num_threads, result);
  for (std::size_t v = 0; v < result.voxels.size(); ++v) {
    if (result.voxels[v].kind == VoxelKind::Wall && result.voxels[v].patch < 0) {
      growPatch(result, static_cast<int>(v));
    }
  }
  findFlushPatches(num_threads, result);
  return result;
}

}  // namespace storey::detail
