// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/short_walls.h>
#include <storey/segmentation/detail/wall_residue.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
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

// What a place was fitted to, and the line found there.
struct Fit {
  std::vector<int> candidates;
  FoundLine found;
};

// The line through a place, and its support among the points that are left.
Fit fitAt(const DensePlace& place, const PointPool& pool, const WallScale& scale,
          const HeightDensity& density, const WallLineOptions& options,
          const std::vector<char>& left) {
  Fit fit;
  WallLine& line = fit.found.line;
  line.normal = place.normal;
  line.offset = place.offset;
  const double reach = std::sqrt(options.min_area);
  fit.candidates =
      candidatesFor(pool, left, line, scale.noise, {place.s_min - reach, place.s_max + reach});
  WallScale local = scale;
  local.density = wallDensityAt(place, pool.points, fit.candidates, density, scale.noise);
  if (!(local.density > 0.0)) return fit;
  SupportOptions locked;
  locked.fit_direction = false;
  locked.by_normals = true;
  locked.steps = options.steps;
  fit.found.support = fitToSupport(pool.points, fit.candidates, local, locked, line);
  return fit;
}

}  // namespace

void extractShortWalls(const std::vector<WallPoint>& points, const WallScale& scale,
                       const HeightDensity& density, const WallLineOptions& options,
                       const std::vector<double>& angles, std::vector<char>& free,
                       std::vector<FoundLine>& lines) {
  std::vector<char> left = farFromLines(points, free, lines, scale.noise);
  const PointPool pool(points, left);
  const auto fit = [&](const DensePlace& place) {
    return fitAt(place, pool, scale, density, options, left);
  };
  const std::vector<DensePlace> places =
      findDensePlaces(points, left, angles, scale.noise, options.threads);
  std::vector<Fit> fits(places.size());
#pragma omp parallel for num_threads(threadsFor(options.threads)) schedule(dynamic, 16)
  for (std::ptrdiff_t p = 0; p < static_cast<std::ptrdiff_t>(places.size()); ++p) {
    fits[static_cast<std::size_t>(p)] = fit(places[static_cast<std::size_t>(p)]);
  }
  // Of places in directions near each other, that with most support is right.
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return fits[a].found.support.size() > fits[b].found.support.size();
  });
  for (const std::size_t p : order) {
    if (fits[p].found.support.empty() || lines.size() >= kMaxLines) return;
    const std::vector<int>& candidates = fits[p].candidates;
    const bool taken = std::any_of(candidates.begin(), candidates.end(),
                                   [&](int i) { return left[static_cast<std::size_t>(i)] == 0; });
    if (taken) fits[p] = fit(places[p]);
    FoundLine& found = fits[p].found;
    if (found.support.empty() || found.line.support_area < options.min_area) continue;
    for (const int i : found.support) {
      left[static_cast<std::size_t>(i)] = 0;
      free[static_cast<std::size_t>(i)] = 0;
    }
    lines.push_back(std::move(found));
  }
}

}  // namespace storey::detail
