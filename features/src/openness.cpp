// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/openness.h>
#include <storey/features/detail/vertical_kernels.h>
#include <storey/filters/detail/task_crew.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace storey::detail {
namespace {

constexpr int kDirections = 64;        // over the upper hemisphere
constexpr double kSteep = 0.5;         // d.z of a steep ray, 30 degrees
constexpr double kOffWall = 0.25;      // |d.n| of a ray that leaves its wall soon enough
constexpr double kGrazing = 0.1;       // |d.n| below which a ray does not tell the side it meets
constexpr double kStartOffset = 1.75;  // voxel sides between a wall and the start of its rays
constexpr std::size_t kOrigins = 4;    // of rays on a patch
constexpr int kRounds = 60;
constexpr int kParts = 4;  // of a round, for each thread
constexpr double kDamping = 0.5;
constexpr double kFlushWeight = 0.3;  // of the neighbours in the same plane
constexpr double kDecided = 0.5;      // |s| of a wall that the level rays decide

struct Meeting {
  int patch;
  double side;  // +1: the ray meets the side that the patch's normal points to
};

// The outcomes of all rays from one side of a patch.
struct Outlook {
  double level_escapes = 0.0;
  double steep_escapes = 0.0;
  double steep_rays = 0.0;
  double roofs = 0.0;
  std::vector<Meeting> meetings;
};

struct PatchOutlooks {
  Outlook front;  // the side its normal points to
  Outlook back;
};

// One bit a cell: a ray passes many empty ones, and so they stay in the cache.
class OccupiedCells {
 public:
  explicit OccupiedCells(const std::vector<std::int32_t>& id_of_cell)
      : words_(id_of_cell.size() / kBits + 1, 0) {
    for (std::size_t cell = 0; cell < id_of_cell.size(); ++cell) {
      if (id_of_cell[cell] >= 0) words_[cell / kBits] |= std::uint64_t{1} << cell % kBits;
    }
  }

  bool holds(std::size_t cell) const { return (words_[cell / kBits] >> cell % kBits & 1) != 0; }

 private:
  static constexpr std::size_t kBits = 64;

  std::vector<std::uint64_t> words_;
};

struct RayScene {
  const WallVoxels& walls;
  OccupiedCells occupied;
};

// Walks a ray from cell to cell [Amanatides and Woo 1987] to the first occupied voxel that is not
// of the patch `own`; -1 if it leaves the grid.
int castRay(const RayScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& d,
            int own) {
  const VoxelGrid3& grid = scene.walls.grid;
  const Eigen::Array3i start = grid.cellOf(origin);
  if (!grid.contains(start)) return -1;
  const Eigen::Array3d position = (origin - grid.low).array() / grid.side;
  const std::ptrdiff_t strides[3] = {1, grid.dims[0],
                                     static_cast<std::ptrdiff_t>(grid.dims[0]) * grid.dims[1]};
  double next[3];   // ray parameter, in voxel sides, of the next wall of the cell
  double delta[3];  // from wall to wall
  int left[3];      // cells to the end of the grid
  std::ptrdiff_t step[3];
  for (int a = 0; a < 3; ++a) {
    const bool forward = d[a] > 0.0;
    const double distance = forward ? start[a] + 1.0 - position[a] : position[a] - start[a];
    const bool moves = std::abs(d[a]) > 1e-9;
    delta[a] = moves ? 1.0 / std::abs(d[a]) : std::numeric_limits<double>::max();
    next[a] = moves ? distance * delta[a] : std::numeric_limits<double>::max();
    left[a] = forward ? grid.dims[a] - 1 - start[a] : start[a];
    step[a] = forward ? strides[a] : -strides[a];
  }
  auto cell = static_cast<std::ptrdiff_t>(grid.indexOf(start));
  while (true) {
    const auto at = static_cast<std::size_t>(cell);
    if (scene.occupied.holds(at)) {
      const std::int32_t id = scene.walls.id_of_cell[at];
      if (scene.walls.voxels[static_cast<std::size_t>(id)].patch != own) return id;
    }
    int axis = next[1] < next[0] ? 1 : 0;
    if (next[2] < next[axis]) axis = 2;
    if (left[axis]-- == 0) return -1;
    cell += step[axis];
    next[axis] += delta[axis];
  }
}

void addRay(const RayScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& d, int own,
            Outlook& outlook) {
  const bool steep = d.z() > kSteep;
  outlook.steep_rays += steep ? 1.0 : 0.0;
  const int id = castRay(scene, origin, d, own);
  if (id < 0) {
    (steep ? outlook.steep_escapes : outlook.level_escapes) += 1.0;
    return;
  }
  const OccupiedVoxel& hit = scene.walls.voxels[static_cast<std::size_t>(id)];
  if (hit.kind == VoxelKind::Level) {
    outlook.roofs += 1.0;
  } else if (hit.kind == VoxelKind::Wall && std::abs(hit.axis.dot(d)) > kGrazing) {
    outlook.meetings.push_back({hit.patch, hit.axis.dot(d) < 0.0 ? 1.0 : -1.0});
  }
}

PatchOutlooks lookAround(const RayScene& scene, int patch_id, const Vectors3d& directions) {
  PatchOutlooks result;
  const WallVoxels& walls = scene.walls;
  const WallPatch& patch = walls.patches[static_cast<std::size_t>(patch_id)];
  const std::size_t step = std::max<std::size_t>(1, patch.voxels.size() / kOrigins);
  const Eigen::Vector3d offset = kStartOffset * walls.grid.side * patch.normal;
  for (std::size_t k = 0; k < patch.voxels.size(); k += step) {
    const auto v = static_cast<std::size_t>(patch.voxels[k]);
    const Eigen::Vector3d& center = walls.voxels[v].center;
    for (const Eigen::Vector3d& d : directions) {
      const double along = d.dot(patch.normal);
      if (along > kOffWall) {
        addRay(scene, center + offset, d, patch_id, result.front);
      } else if (along < -kOffWall) {
        addRay(scene, center - offset, d, patch_id, result.back);
      }
    }
  }
  return result;
}

// Mean outcome of the rays of one side: +1 outside, -1 inside.
double meanOutcome(const Outlook& outlook, const std::vector<double>& s, double steep_weight) {
  double sum = outlook.level_escapes + steep_weight * outlook.steep_escapes - outlook.roofs;
  for (const Meeting& m : outlook.meetings) {
    sum += m.side * s[static_cast<std::size_t>(m.patch)];
  }
  const double rays = outlook.level_escapes + outlook.roofs + steep_weight * outlook.steep_escapes +
                      static_cast<double>(outlook.meetings.size());
  return rays > 0.0 ? sum / rays : 0.0;
}

double flushMean(const WallVoxels& walls, const WallPatch& patch, const std::vector<double>& s) {
  double sum = 0.0;
  for (const int other : patch.flush) {
    const auto o = static_cast<std::size_t>(other);
    sum += (walls.patches[o].normal.dot(patch.normal) < 0.0 ? -1.0 : 1.0) * s[o];
  }
  return patch.flush.empty() ? 0.0 : sum / static_cast<double>(patch.flush.size());
}

std::vector<double> solve(const WallVoxels& walls, const std::vector<PatchOutlooks>& outlooks,
                          double steep_weight, TaskCrew& crew) {
  std::vector<double> s(outlooks.size(), 0.0);
  std::vector<double> updated(s);
  const auto update = [&](std::size_t i) {
    const double difference = meanOutcome(outlooks[i].front, s, steep_weight) -
                              meanOutcome(outlooks[i].back, s, steep_weight);
    const double target =
        std::clamp(difference + kFlushWeight * flushMean(walls, walls.patches[i], s), -1.0, 1.0);
    updated[i] = s[i] + kDamping * (target - s[i]);
  };
  const auto parts = static_cast<std::size_t>(kParts * crew.size());
  for (int round = 0; round < kRounds; ++round) {
    crew.run(parts, [&](std::size_t part) {
      const std::size_t end = (part + 1) * s.size() / parts;
      for (std::size_t i = part * s.size() / parts; i < end; ++i) update(i);
    });
    s.swap(updated);
  }
  return s;
}

// How much a steep escape says for outside: nothing if as many get out on the inner side of the
// walls that are decided without them, everything if none does.
double steepWeight(const std::vector<PatchOutlooks>& outlooks, const std::vector<double>& s) {
  double inner = 0.0;
  double outer = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (std::abs(s[i]) > kDecided) {
      const Outlook& in = s[i] > 0.0 ? outlooks[i].back : outlooks[i].front;
      const Outlook& out = s[i] > 0.0 ? outlooks[i].front : outlooks[i].back;
      inner += in.steep_rays > 0.0 ? in.steep_escapes / in.steep_rays : 0.0;
      outer += out.steep_rays > 0.0 ? out.steep_escapes / out.steep_rays : 0.0;
    }
  }
  return outer > 0.0 ? std::clamp(1.0 - inner / outer, 0.0, 1.0) : 0.0;
}

}  // namespace

std::vector<double> findOutsides(const WallVoxels& walls, int num_threads) {
  const Vectors3d directions = fibonacciHemisphere(kDirections);
  std::vector<PatchOutlooks> outlooks(walls.patches.size());
  const RayScene scene = {walls, OccupiedCells(walls.id_of_cell)};
  TaskCrew crew(num_threads);
  crew.run(outlooks.size(), [&](std::size_t i) {
    outlooks[i] = lookAround(scene, static_cast<int>(i), directions);
  });
  const std::vector<double> level_only = solve(walls, outlooks, 0.0, crew);
  const double steep_weight = steepWeight(outlooks, level_only);
  return solve(walls, outlooks, steep_weight, crew);
}

}  // namespace storey::detail
