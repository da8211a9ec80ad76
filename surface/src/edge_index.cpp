// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/edge_index.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kMaxCellsPerSide = 256.0;
// A given normal may be 15 degrees of noise off; beyond 70 the point is of another wall.
constexpr double kMinNormalDot = 0.35;

void appendStretches(const FloorplanRing& ring, std::vector<WallStretch>& stretches) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d along = ring.vertices[(i + 1) % ring.size()] - ring.vertices[i];
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    stretches.push_back({ring.vertices[i], along / length, length, ring.edges[i].wall});
  }
}

}  // namespace

std::vector<WallStretch> stretchesOf(const Floorplan& plan) {
  std::vector<WallStretch> stretches;
  for (const FloorplanComponent& component : plan.components) {
    appendStretches(component.outer, stretches);
    for (const FloorplanRing& hole : component.holes) appendStretches(hole, stretches);
  }
  return stretches;
}

EdgeIndex::EdgeIndex(std::vector<WallStretch> stretches, double gate)
    : stretches_(std::move(stretches)), gate_(gate), low_(Eigen::Vector2d::Zero()) {
  if (stretches_.empty()) return;
  Eigen::Vector2d high = stretches_.front().start;
  low_ = high;
  for (const WallStretch& s : stretches_) {
    const Eigen::Vector2d end = s.start + s.length * s.tangent;
    low_ = low_.cwiseMin(s.start).cwiseMin(end);
    high = high.cwiseMax(s.start).cwiseMax(end);
  }
  low_.array() -= gate_;
  high.array() += gate_;
  const double extent = (high - low_).maxCoeff();
  cell_ = std::max(2.0 * gate_, extent / kMaxCellsPerSide);
  columns_ = static_cast<std::ptrdiff_t>((high.x() - low_.x()) / cell_) + 1;
  rows_ = static_cast<std::ptrdiff_t>((high.y() - low_.y()) / cell_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  const double reach = gate_ + 0.7072 * cell_;  // from the cell's centre to its corner
  for (std::ptrdiff_t r = 0; r < rows_; ++r) {
    for (std::ptrdiff_t c = 0; c < columns_; ++c) {
      const Eigen::Vector2d centre = low_ + cell_ * Eigen::Vector2d(static_cast<double>(c) + 0.5,
                                                                    static_cast<double>(r) + 0.5);
      for (std::size_t i = 0; i < stretches_.size(); ++i) {
        const WallStretch& s = stretches_[i];
        const Eigen::Vector2d d = centre - s.start;
        const double along = std::clamp(d.dot(s.tangent), 0.0, s.length);
        if ((d - along * s.tangent).norm() <= reach) {
          cells_[static_cast<std::size_t>(r * columns_ + c)].push_back(static_cast<int>(i));
        }
      }
    }
  }
}

std::size_t EdgeIndex::cellOf(const Eigen::Vector2d& point) const {
  const double x = (point.x() - low_.x()) / cell_;
  const double y = (point.y() - low_.y()) / cell_;
  if (!(x >= 0.0 && y >= 0.0 && x < static_cast<double>(columns_) &&
        y < static_cast<double>(rows_))) {
    return cells_.size();
  }
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(y) * columns_ +
                                  static_cast<std::ptrdiff_t>(x));
}

const std::vector<int>& EdgeIndex::candidates(const Eigen::Vector2d& point) const {
  static const std::vector<int> none;
  const std::size_t cell = cellOf(point);
  return cell < cells_.size() ? cells_[cell] : none;
}

int EdgeIndex::nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal,
                       double margin) const {
  const std::size_t cell = cellOf(point);
  if (cell >= cells_.size()) return -1;
  const bool has_normal = normal.squaredNorm() > 0.0;
  int best = -1;
  double best_distance = gate_;
  for (const int i : cells_[cell]) {
    const WallStretch& s = stretches_[static_cast<std::size_t>(i)];
    if (has_normal && s.normal().dot(normal) < kMinNormalDot) continue;
    const Eigen::Vector2d d = point - s.start;
    const double along = d.dot(s.tangent);
    const double inset = std::min(margin, 0.25 * s.length);
    if (along < inset || along > s.length - inset) continue;
    const double distance = std::abs(d.dot(s.normal()));
    if (distance <= best_distance) {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}

}  // namespace storey::detail
