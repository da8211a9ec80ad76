// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/short_walls.h>
#include <storey/segmentation/detail/wall_density.h>
#include <storey/segmentation/detail/wall_residue.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kStrayed = 5.0;     // noise deviations: nearly all of panes and tails are nearer
constexpr double kOn = 2.5;          // noise deviations across a wall
constexpr std::size_t kFewest = 10;  // points of a place, for their heights
constexpr double kDense = 0.3;       // of the density of walls at the same heights
constexpr std::size_t kMaxLines = 400;

// Of each point that no line took and that lies near none: whether it may be of a wall not found.
std::vector<char> farFromLines(const std::vector<WallPoint>& points, const std::vector<char>& free,
                               const std::vector<FoundLine>& lines, double noise) {
  std::vector<char> far = free;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (far[i] == 0) continue;
    const WallPoint& p = points[i];
    far[i] = std::none_of(lines.begin(), lines.end(), [&](const FoundLine& found) {
      return explains(found.line, p, kStrayed * noise, noise);
    });
  }
  return far;
}

// The points of a place, if they are as dense as walls are at their heights: at the ends of trees
// and other clutter they are not. \return that density of walls, 0 if not
double wallDensityAt(const DensePlace& place, const std::vector<WallPoint>& points,
                     const std::vector<int>& candidates, const HeightDensity& density,
                     double noise) {
  std::vector<double> heights;
  const Eigen::Vector2d tangent(-place.normal.y(), place.normal.x());
  for (const int i : candidates) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    const double s = tangent.dot(p.position);
    if (s < place.s_min || s > place.s_max) continue;
    if (std::abs(place.normal.dot(p.position) - place.offset) < kOn * noise) heights.push_back(p.z);
  }
  if (heights.size() < kFewest) return 0.0;
  std::sort(heights.begin(), heights.end());
  const std::size_t tenth = heights.size() / 10;
  const double low = heights[tenth];
  const double high = heights[heights.size() - 1 - tenth];
  const double count = static_cast<double>(heights.size() - 2 * tenth);
  const double there = density.at(heights[heights.size() / 2]);
  return count > kDense * there * (high - low) * (place.s_max - place.s_min) ? there : 0.0;
}

// The line through a place, and its support among the points that are left.
FoundLine fitAt(const DensePlace& place, const std::vector<WallPoint>& points,
                const PointBlocks& blocks, const WallScale& scale, const HeightDensity& density,
                const WallLineOptions& options, const std::vector<char>& left) {
  FoundLine found;
  found.line.normal = place.normal;
  found.line.offset = place.offset;
  const double reach = std::sqrt(options.min_area);
  std::vector<int> candidates = candidatesFor(points, blocks, left, found.line, scale.noise);
  const auto beyond = [&](int i) {
    const double s = found.line.along(points[static_cast<std::size_t>(i)].position);
    return s < place.s_min - reach || s > place.s_max + reach;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), beyond), candidates.end());
  WallScale local = scale;
  local.density = wallDensityAt(place, points, candidates, density, scale.noise);
  if (!(local.density > 0.0)) return found;
  SupportOptions locked;
  locked.fit_direction = false;
  locked.by_normals = true;
  locked.steps = options.steps;
  found.support = fitToSupport(points, candidates, local, locked, found.line);
  return found;
}

}  // namespace

void extractShortWalls(const std::vector<WallPoint>& points, const PointBlocks& blocks,
                       const WallScale& scale, const WallLineOptions& options,
                       const std::vector<double>& angles, std::vector<char>& free,
                       std::vector<FoundLine>& lines) {
  const HeightDensity density(points, scale);
  std::vector<char> left = farFromLines(points, free, lines, scale.noise);
  const auto fit = [&](const DensePlace& place) {
    return fitAt(place, points, blocks, scale, density, options, left);
  };
  // Of places in directions near each other, that with most support is right.
  std::vector<std::pair<std::size_t, DensePlace>> order;
  for (const DensePlace& place : findDensePlaces(points, left, angles, scale.noise))
    order.emplace_back(fit(place).support.size(), place);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [support, place] : order) {
    if (support == 0 || lines.size() >= kMaxLines) return;
    FoundLine found = fit(place);
    if (found.support.empty() || found.line.support_area < options.min_area) continue;
    for (const int i : found.support) {
      left[static_cast<std::size_t>(i)] = 0;
      free[static_cast<std::size_t>(i)] = 0;
    }
    lines.push_back(std::move(found));
  }
}

}  // namespace storey::detail
