// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/planar_patches.h>
#include <storey/segmentation/detail/wall_support.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
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

constexpr std::uint32_t kNowhere = 0xffffffff;  // as a cell or a patch

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
               const WallScale& scale)
      : num_points_(points.size()),
        side_(kCellSide * supportCellSize(scale)),
        reach_(kReach * scale.noise) {
    std::vector<std::uint32_t> cell_of(points.size(), kNowhere);
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (counts[i] == 0) continue;
      const Eigen::Vector3d p = points[i].position.cast<double>();
      cell_of[i] = static_cast<std::uint32_t>(
          cells_.add({cellAlong(p.x(), side_), cellAlong(p.y(), side_), cellAlong(p.z(), side_)}));
      held.resize(cells_.size(), 0);
      ++held[cell_of[i]];
    }
    sortByCell(points, cell_of, held);
    reached_.assign(cells_.size(), PlanarPatches::kNone);
  }

  PlanarPatches find() {
    for (const std::size_t cell : seeds()) grow(cell);
    points_ = {};  // the result needs the memory
    result_.of.assign(num_points_, PlanarPatches::kNone);
    for (std::size_t k = 0; k < patch_.size(); ++k) {
      if (patch_[k] != kNowhere) result_.of[number_[k]] = patch_[k];
    }
    return std::move(result_);
  }

 private:
  // The points cell by cell, in memory too: cells are visited again and again.
  void sortByCell(const std::vector<OrientedPoint>& points,
                  const std::vector<std::uint32_t>& cell_of, const std::vector<std::size_t>& held) {
    first_.assign(held.size() + 1, 0);
    std::partial_sum(held.begin(), held.end(), first_.begin() + 1);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    points_.resize(first_.back());
    number_.resize(first_.back());
    patch_.assign(first_.back(), kNowhere);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cell_of[i] == kNowhere) continue;
      const std::size_t place = next[cell_of[i]]++;
      points_[place] = points[i];
      number_[place] = static_cast<std::uint32_t>(i);
    }
  }
  double heldIn(std::size_t cell) const {
    return static_cast<double>(first_[cell + 1] - first_[cell]);
  }

  // Mean of the normals of the free points in a cell, all turned to one side.
  Eigen::Vector3d meanNormal(std::size_t cell) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      if (patch_[i] != kNowhere) continue;
      const Eigen::Vector3d n = points_[i].normal.cast<double>();
      sum += n.dot(sum) < 0.0 ? Eigen::Vector3d(-n) : n;
      count += 1.0;
    }
    return count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
  }

  // Cells in which normals agree best come first.
  std::vector<std::size_t> seeds() const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (heldIn(c) < kMinInCell) continue;
      order.emplace_back(-meanNormal(c).norm(), c);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> cells;
    for (const auto& [coherence, cell] : order) cells.push_back(cell);
    return cells;
  }

  // Takes the free points of a cell that lie on the plane.
  double take(std::size_t cell, const Plane& plane, std::size_t patch, Moments& moments) {
    double taken = 0.0;
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      if (patch_[i] != kNowhere) continue;
      const Eigen::Vector3d p = points_[i].position.cast<double>();
      if (std::abs(plane.normal.dot(p - plane.center)) > reach_) continue;
      if (std::abs(plane.normal.dot(points_[i].normal.cast<double>())) < kAgreement) continue;
      patch_[i] = static_cast<std::uint32_t>(patch);
      moments.add(p);
      taken += 1.0;
    }
    return taken;
  }

  // The plane of the free points in a cell; false if they are too few.
  bool planeAt(std::size_t cell, Plane& plane) const {
    plane.normal = meanNormal(cell);
    if (!(plane.normal.norm() > 0.0)) return false;
    plane.normal.normalize();
    Moments moments;
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      if (patch_[i] == kNowhere) moments.add(points_[i].position.cast<double>());
    }
    plane.center = moments.center();
    return moments.count >= kMinInCell;
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
    const GridCell at = cells_[cell];
    for (std::int64_t k = 0; k < 27; ++k) {
      const std::size_t beside =
          cells_.find({at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1});
      if (beside == GridCells::kNone || reached_[beside] == patch) continue;
      reached_[beside] = patch;
      queue.push_back(beside);
    }
  }

  std::size_t num_points_;
  double side_;
  double reach_;
  GridCells cells_;
  std::vector<std::size_t> first_;     // of each cell, of the points that follow
  std::vector<OrientedPoint> points_;  // those that count, cell by cell
  std::vector<std::uint32_t> number_;  // of each among all points
  std::vector<std::uint32_t> patch_;   // of each, `kNowhere` while it is free
  std::vector<std::size_t> reached_;   // the last patch that did, of each cell
  PlanarPatches result_;
};

}  // namespace

PlanarPatches findPlanarPatches(const std::vector<OrientedPoint>& points,
                                const std::vector<char>& counts, const WallScale& scale) {
  return PatchGrowing(points, counts, scale).find();
}

}  // namespace storey::detail
