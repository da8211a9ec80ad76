// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/edge_index.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kMaxCellsPerSide = 256.0;
constexpr double kCellsPerSide = 24.0;  // times the root of the number of stretches
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
  layGrid();
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const WallStretch& s : stretches_) {
    forEachCellNear(s, [&](std::size_t cell) { ++first_[cell + 1]; });
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  candidates_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    forEachCellNear(stretches_[i],
                    [&](std::size_t cell) { candidates_[next[cell]++] = static_cast<int>(i); });
  }
}

void EdgeIndex::layGrid() {
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
  const double sides =
      std::min(kMaxCellsPerSide, kCellsPerSide * std::sqrt(static_cast<double>(stretches_.size())));
  cell_ = std::max(2.0 * gate_, extent / sides);
  columns_ = static_cast<std::ptrdiff_t>((high.x() - low_.x()) / cell_) + 1;
  rows_ = static_cast<std::ptrdiff_t>((high.y() - low_.y()) / cell_) + 1;
}

template <typename Work>
void EdgeIndex::forEachCellNear(const WallStretch& stretch, const Work& work) const {
  const double reach = gate_ + 0.7072 * cell_;  // from the cell's centre to its corner
  const Eigen::Vector2d end = stretch.start + stretch.length * stretch.tangent;
  const auto range = [&](double a, double b, double low, std::ptrdiff_t count) {
    const auto from = static_cast<std::ptrdiff_t>((std::min(a, b) - reach - low) / cell_);
    const auto to = static_cast<std::ptrdiff_t>((std::max(a, b) + reach - low) / cell_);
    return std::make_pair(std::max(std::ptrdiff_t{0}, from), std::min(count - 1, to));
  };
  const double rise = stretch.tangent.y();
  const auto [first_row, last_row] = range(stretch.start.y(), end.y(), low_.y(), rows_);
  for (std::ptrdiff_t r = first_row; r <= last_row; ++r) {
    const double y = low_.y() + cell_ * (static_cast<double>(r) + 0.5);
    // The part of the stretch that is within reach of the row.
    double from = 0.0;
    double to = stretch.length;
    if (std::abs(rise) * stretch.length > cell_) {
      const double below = (y - reach - stretch.start.y()) / rise;
      const double above = (y + reach - stretch.start.y()) / rise;
      from = std::clamp(std::min(below, above), 0.0, stretch.length);
      to = std::clamp(std::max(below, above), 0.0, stretch.length);
    }
    const double x = stretch.start.x();
    const auto [first, last] =
        range(x + from * stretch.tangent.x(), x + to * stretch.tangent.x(), low_.x(), columns_);
    for (std::ptrdiff_t c = first; c <= last; ++c) {
      const Eigen::Vector2d centre(low_.x() + cell_ * (static_cast<double>(c) + 0.5), y);
      const Eigen::Vector2d d = centre - stretch.start;
      const double along = std::clamp(d.dot(stretch.tangent), 0.0, stretch.length);
      if ((d - along * stretch.tangent).squaredNorm() > reach * reach) continue;
      work(static_cast<std::size_t>(r * columns_ + c));
    }
  }
}

int EdgeIndex::nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal,
                       double margin) const {
  const bool has_normal = normal.squaredNorm() > 0.0;
  int best = -1;
  double best_distance = gate_;
  for (const int i : candidates(point)) {
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
