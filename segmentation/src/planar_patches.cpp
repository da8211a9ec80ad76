// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/planar_patches.h>
#include <storey/segmentation/detail/point_cubes.h>
#include <storey/segmentation/detail/wall_support.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kReach = 3.0;        // noise deviations from the plane
constexpr double kAgreement = 0.866;  // cos(30 degrees)
constexpr double kMinInCell = 2.0;    // points of the patch, to go on from there
constexpr double kCellSide = 2.0;     // cells of the support of a wall: where walls are thin, too

constexpr double kFirstFit = 16.0;  // points

constexpr std::size_t kAround = 27;  // a cell and those beside it

struct Plane {
  Eigen::Vector3d center;
  Eigen::Vector3d normal;
};

// Running moments of the points of a patch, about its first one.
struct Moments {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0.0;

  void add(const Eigen::Vector3d& p) {
    if (count == 0.0) origin = p;
    const Eigen::Vector3d x = p - origin;
    sum += x;
    squares += x * x.transpose();
    count += 1.0;
  }
  Eigen::Vector3d center() const { return origin + sum / count; }
  Eigen::Vector3d normal() const {
    const Eigen::Vector3d mean = sum / count;
    const Eigen::Matrix3d covariance = squares / count - mean * mean.transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
  }
};

class PatchGrowing {
 public:
  PatchGrowing(const std::vector<OrientedPoint>& points, const std::vector<char>& counts,
               const WallScale& scale, unsigned int threads)
      : points_(points),
        side_(kCellSide * supportCellSize(scale)),
        reach_(kReach * scale.noise),
        threads_(threads) {
    const PointCubes cubes = sortIntoCubes(
        points, side_, [&](std::size_t i) { return counts[i] != 0; }, threads);
    sortByCell(cubes.of, cubes.cells.size());
    findNeighbors(cubes.cells);
    for (std::size_t cell = 0; cell < cubes.cells.size(); ++cell) {
      free_.push_back(static_cast<std::uint32_t>(first_[cell + 1] - first_[cell]));
    }
    reached_.assign(cubes.cells.size(), PlanarPatches::kNone);
    result_.of.assign(points.size(), PlanarPatches::kNone);
  }

  PlanarPatches find() {
    for (const std::size_t cell : seeds()) grow(cell);
    return std::move(result_);
  }

 private:
  // The numbers of the points only: those of a cell are near each other as they come.
  void sortByCell(const std::vector<std::uint32_t>& cell_of, std::size_t num_cells) {
    first_.assign(num_cells + 1, 0);
    for (const std::uint32_t cell : cell_of) {
      if (cell != PointCubes::kNone) ++first_[cell + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    number_.resize(first_.back());
    for (std::size_t i = 0; i < cell_of.size(); ++i) {
      if (cell_of[i] != PointCubes::kNone) {
        number_[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
      }
    }
  }

  void findNeighbors(const GridCells& cells) {
    beside_.resize(cells.size());
    forEachCell([&](std::size_t cell) {
      const GridCell& at = cells[cell];
      for (std::size_t k = 0; k < kAround; ++k) {
        const auto step = static_cast<std::int64_t>(k);
        const std::size_t beside =
            cells.find({at[0] + step / 9 - 1, at[1] + step / 3 % 3 - 1, at[2] + step % 3 - 1});
        beside_[cell][k] =
            beside == GridCells::kNone ? PointCubes::kNone : static_cast<std::uint32_t>(beside);
      }
    });
  }

  // Calls `work(cell)` for all cells, from several threads.
  template <typename Work>
  void forEachCell(const Work& work) const {
    const auto count = static_cast<std::ptrdiff_t>(beside_.size());
#pragma omp parallel for num_threads(threadsFor(threads_)) schedule(dynamic, 512)
    for (std::ptrdiff_t cell = 0; cell < count; ++cell) work(static_cast<std::size_t>(cell));
  }

  // Calls `visit(point, patch)` for the points of a cell that are of no patch yet.
  template <typename Patches, typename Visit>
  void forEachFree(std::size_t cell, Patches& patch_of, const Visit& visit) const {
    for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) {
      auto& patch = patch_of[number_[k]];
      if (patch == PlanarPatches::kNone) visit(points_[number_[k]], patch);
    }
  }
  double heldIn(std::size_t cell) const {
    return static_cast<double>(first_[cell + 1] - first_[cell]);
  }

  // Mean of the normals of the free points in a cell, all turned to one side.
  Eigen::Vector3d meanNormal(std::size_t cell) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    forEachFree(cell, result_.of, [&](const OrientedPoint& point, std::uint32_t) {
      const Eigen::Vector3d n = point.normal.cast<double>();
      sum += n.dot(sum) < 0.0 ? Eigen::Vector3d(-n) : n;
      count += 1.0;
    });
    return count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
  }

  // Cells in which normals agree best come first.
  std::vector<std::size_t> seeds() const {
    std::vector<double> coherence(beside_.size());
    forEachCell([&](std::size_t cell) { coherence[cell] = meanNormal(cell).norm(); });
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t c = 0; c < coherence.size(); ++c) {
      if (heldIn(c) >= kMinInCell) order.emplace_back(-coherence[c], c);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> cells;
    for (const auto& [less, cell] : order) cells.push_back(cell);
    return cells;
  }

  // Takes the free points of a cell that lie on the plane.
  double take(std::size_t cell, const Plane& plane, std::size_t patch, Moments& moments) {
    double taken = 0.0;
    forEachFree(cell, result_.of, [&](const OrientedPoint& point, std::uint32_t& patch_of_point) {
      const Eigen::Vector3d p = point.position.cast<double>();
      if (std::abs(plane.normal.dot(p - plane.center)) > reach_) return;
      if (std::abs(plane.normal.dot(point.normal.cast<double>())) < kAgreement) return;
      patch_of_point = static_cast<std::uint32_t>(patch);
      moments.add(p);
      taken += 1.0;
    });
    free_[cell] -= static_cast<std::uint32_t>(taken);
    return taken;
  }

  // The plane of the free points in a cell; false if they are too few.
  bool planeAt(std::size_t cell, Plane& plane) const {
    if (free_[cell] < kMinInCell) return false;
    plane.normal = meanNormal(cell);
    if (!(plane.normal.norm() > 0.0)) return false;
    plane.normal.normalize();
    Moments moments;
    forEachFree(cell, result_.of, [&](const OrientedPoint& point, std::uint32_t) {
      moments.add(point.position.cast<double>());
    });
    plane.center = moments.center();
    return true;
  }

  void grow(std::size_t seed) {
    Plane plane;
    if (!planeAt(seed, plane)) return;
    const std::size_t patch = result_.area.size();
    Moments moments;
    double next_fit = kFirstFit;
    double filled = 0.0;
    double held = 0.0;
    std::vector<std::size_t> queue = {seed};
    reached_[seed] = patch;
    for (std::size_t q = 0; q < queue.size(); ++q) {
      if (take(queue[q], plane, patch, moments) < kMinInCell) continue;
      filled += 1.0;
      held += heldIn(queue[q]);
      queueAround(queue[q], patch, queue);
      if (moments.count < next_fit) continue;
      next_fit = 2.0 * moments.count;
      plane = {moments.center(), moments.normal()};
    }
    // A plane oblique to the grid passes through more cells.
    result_.share.push_back(held > 0.0 ? moments.count / held : 0.0);
    result_.area.push_back(filled * side_ * side_ / plane.normal.cwiseAbs().sum());
  }

  void queueAround(std::size_t cell, std::size_t patch, std::vector<std::size_t>& queue) {
    for (const std::uint32_t beside : beside_[cell]) {
      if (beside == PointCubes::kNone || free_[beside] == 0 || reached_[beside] == patch) continue;
      reached_[beside] = patch;
      queue.push_back(beside);
    }
  }

  const std::vector<OrientedPoint>& points_;
  double side_;
  double reach_;
  unsigned int threads_;
  std::vector<std::array<std::uint32_t, kAround>> beside_;  // of each cell, itself among them
  std::vector<std::size_t> first_;     // of each cell, of the numbers that follow
  std::vector<std::uint32_t> number_;  // of the points that count, cell by cell
  std::vector<std::uint32_t> free_;    // how many points of each cell are of no patch yet
  std::vector<std::size_t> reached_;   // the last patch that did, of each cell
  PlanarPatches result_;
};

}  // namespace

PlanarPatches findPlanarPatches(const std::vector<OrientedPoint>& points,
                                const std::vector<char>& counts, const WallScale& scale,
                                unsigned int threads) {
  return PatchGrowing(points, counts, scale, threads).find();
}

}  // namespace storey::detail
