// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/wall_assignment.h>

#include <algorithm>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGate = 4.0;  // noise deviations: points further off are of another wall
// Noise deviations: at corners points mix. Each wall loses about what it gets: at a right angle,
// all points beyond m sigma from the corner move a wall of length L by 0.25 sigma^2 / L for m = 0
// and 0.011 for 1.5.
constexpr double kEndMargin = 1.5;

}  // namespace

WallAssignment::WallAssignment(const std::vector<FloorplanLayer>& layers, double noise)
    : layers_(layers), margin_(kEndMargin * noise) {
  std::vector<std::vector<WallStretch>> stretches;
  for (const FloorplanLayer& layer : layers) {
    stretches.push_back(stretchesOf(layer.plan));
    for (const WallStretch& stretch : stretches.back()) {
      if (stretch.wall >= 0) ids_.push_back(stretch.wall);
    }
  }
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  for (std::vector<WallStretch>& of_layer : stretches) {
    for (WallStretch& stretch : of_layer) {
      if (stretch.wall < 0) continue;
      const auto id = std::lower_bound(ids_.begin(), ids_.end(), stretch.wall);
      stretch.wall = static_cast<int>(id - ids_.begin());
    }
    indices_.emplace_back(std::move(of_layer), kGate * noise);
  }
}

std::vector<int> WallAssignment::wallsOf(const FitPoints& points, unsigned int threads) const {
  std::vector<int> walls(points.positions.size());
  forEachChunk(walls.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      walls[i] = wallOf(points.positions[i], points.normals[i]);
    }
  });
  return walls;
}

int WallAssignment::wallOf(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const {
  if (!isWallNormal(normal)) return -1;
  const Eigen::Vector3d p = position.cast<double>();
  const auto layer = std::upper_bound(
      layers_.begin(), layers_.end(), p.z(),
      [](double z, const FloorplanLayer& candidate) { return z < candidate.z_max; });
  if (layer == layers_.end() || p.z() < layer->z_min) return -1;
  const EdgeIndex& index = indices_[static_cast<std::size_t>(layer - layers_.begin())];
  const int edge = index.nearest(p.head<2>(), normal.head<2>().cast<double>(), margin_);
  return edge < 0 ? -1 : index[static_cast<std::size_t>(edge)].wall;
}

}  // namespace storey::detail
