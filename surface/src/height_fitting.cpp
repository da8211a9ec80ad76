// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/floorplan_fitting.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

constexpr double kGate = 4.0;         // noise deviations across the wall
constexpr double kEndMargin = 3.0;    // noise deviations inside the ends of a stretch
constexpr double kMinStretch = 6.0;   // noise deviations: shorter ends of walls tell nothing
constexpr double kReference = 30.0;   // noise deviations of height that give the density
constexpr double kOutliers = 0.0005;  // density off the wall, of that on it
constexpr double kMixingGap = 8.0;    // noise deviations: gates of two walls, side by side
constexpr double kSameSense = 0.7;    // cosine of 45 degrees
constexpr double kMinLayer = 3.0;     // noise deviations
constexpr std::size_t kMinPoints = 20;

// Heights of the points of the walls that end, or start, at one level.
struct LevelEvidence {
  double guess = 0.0;
  double low = 0.0;  // points between these heights count
  double high = 0.0;
  std::vector<double> ends;
  std::vector<double> starts;
};

// The parts of `stretches` that no edge of the same wall covers in `others`.
std::vector<detail::WallStretch> uncovered(const std::vector<detail::WallStretch>& stretches,
                                           const std::vector<detail::WallStretch>& others,
                                           double min_length) {
  std::vector<detail::WallStretch> result;
  for (const detail::WallStretch& stretch : stretches) {
    std::vector<std::pair<double, double>> covers;
    for (const detail::WallStretch& other : others) {
      if (other.wall < 0 || other.wall != stretch.wall) continue;
      const double a = (other.start - stretch.start).dot(stretch.tangent);
      const double b = a + other.length * other.tangent.dot(stretch.tangent);
      covers.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(covers.begin(), covers.end());
    covers.emplace_back(stretch.length, stretch.length);
    double from = 0.0;
    for (const auto& [begin, end] : covers) {
      const double to = std::min(begin, stretch.length);
      if (to - from > min_length) {
        result.push_back(
            {stretch.start + from * stretch.tangent, stretch.tangent, to - from, stretch.wall});
      }
      from = std::max(from, end);
    }
  }
  return result;
}

double logCdf(double x) {
  return std::log(0.5 * std::erfc(-x * M_SQRT1_2) * (1.0 - kOutliers) + kOutliers);
}

// Log-likelihood of a step at z. Points of a wall that ends at z lie between `low` and z with
// density N / (z - low), blurred by the noise; the density is profiled out.
double logLikelihood(const LevelEvidence& level, double z, double noise) {
  double sum = 0.0;
  if (level.ends.size() >= kMinPoints) {
    for (const double zi : level.ends) sum += logCdf((z - zi) / noise);
    sum -= static_cast<double>(level.ends.size()) * std::log(z - level.low);
  }
  if (level.starts.size() >= kMinPoints) {
    for (const double zi : level.starts) sum += logCdf((zi - z) / noise);
    sum -= static_cast<double>(level.starts.size()) * std::log(level.high - z);
  }
  return sum;
}

// The most likely height: a scan in steps of half a deviation, then golden section.
double bestHeight(const LevelEvidence& level, double noise, double max_shift) {
  if (level.ends.size() < kMinPoints && level.starts.size() < kMinPoints) return level.guess;
  const double from = std::max(level.low + noise, level.guess - max_shift);
  const double to = std::min(level.high - noise, level.guess + max_shift);
  if (!(from < to)) return level.guess;
  const int steps = std::clamp(static_cast<int>((to - from) / (0.5 * noise)), 4, 400);
  double best = level.guess;
  double best_value = -INFINITY;
  for (int i = 0; i <= steps; ++i) {
    const double z = from + (to - from) * i / steps;
    const double value = logLikelihood(level, z, noise);
    if (value > best_value) {
      best_value = value;
      best = z;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  double a = std::max(from, best - (to - from) / steps);
  double b = std::min(to, best + (to - from) / steps);
  double c = b - kGolden * (b - a);
  double d = a + kGolden * (b - a);
  double at_c = logLikelihood(level, c, noise);
  double at_d = logLikelihood(level, d, noise);
  while (b - a > 1e-4 * noise) {
    if (at_c > at_d) {
      b = d;
      d = c;
      at_d = at_c;
      c = b - kGolden * (b - a);
      at_c = logLikelihood(level, c, noise);
    } else {
      a = c;
      c = d;
      at_c = at_d;
      d = a + kGolden * (b - a);
      at_d = logLikelihood(level, d, noise);
    }
  }
  return 0.5 * (a + b);
}

// Level k lies below layer k; level n is the top. Its window reaches into its neighbours by the
// search range and, on the side of the wall, by the height that gives the density.
std::vector<LevelEvidence> makeLevels(const std::vector<FloorplanLayer>& layers,
                                      const FitOptions& options) {
  std::vector<LevelEvidence> levels(layers.size() + 1);
  const double reach = options.max_shift + kReference * options.noise;
  for (std::size_t k = 0; k <= layers.size(); ++k) {
    LevelEvidence& level = levels[k];
    level.guess = k < layers.size() ? layers[k].z_min : layers.back().z_max;
    // Half of a thin layer belongs to its other boundary.
    const double below = k > 0 ? 0.5 * (layers[k - 1].z_max - layers[k - 1].z_min) : reach;
    const double above = k < layers.size() ? 0.5 * (layers[k].z_max - layers[k].z_min) : reach;
    level.low = level.guess - std::min(reach, std::max(below, 0.5 * options.max_shift));
    level.high = level.guess + std::min(reach, std::max(above, 0.5 * options.max_shift));
  }
  return levels;
}

// Whether a wall of the other layer runs so close beside the stretch that points of both mix.
bool hasCloseNeighbor(const detail::WallStretch& stretch,
                      const std::vector<detail::WallStretch>& others, double gap) {
  return std::any_of(others.begin(), others.end(), [&](const detail::WallStretch& other) {
    if (other.wall == stretch.wall || other.tangent.dot(stretch.tangent) < kSameSense) return false;
    const double a = (other.start - stretch.start).dot(stretch.tangent);
    const double b = a + other.length * other.tangent.dot(stretch.tangent);
    return std::abs((other.start - stretch.start).dot(stretch.normal())) < gap &&
           std::min(b, stretch.length) > std::max(a, 0.0);
  });
}

// The walls that end and start at one level, and all walls around it.
struct LevelWalls {
  detail::EdgeIndex ends;
  detail::EdgeIndex starts;
  detail::EdgeIndex all;
};

LevelWalls wallsAt(const std::vector<detail::WallStretch>& below,
                   const std::vector<detail::WallStretch>& above, double noise) {
  std::vector<detail::WallStretch> ends = uncovered(below, above, kMinStretch * noise);
  std::vector<detail::WallStretch> starts = uncovered(above, below, kMinStretch * noise);
  const auto clear = [&](std::vector<detail::WallStretch> stretches,
                         const std::vector<detail::WallStretch>& others) {
    const auto mixed = [&](const detail::WallStretch& stretch) {
      return hasCloseNeighbor(stretch, others, kMixingGap * noise);
    };
    stretches.erase(std::remove_if(stretches.begin(), stretches.end(), mixed), stretches.end());
    return stretches;
  };
  const std::vector<detail::WallStretch> clear_ends = clear(ends, above);
  const std::vector<detail::WallStretch> clear_starts = clear(starts, below);
  if (!clear_ends.empty() || !clear_starts.empty()) {  // else the mixed ones are all there is
    ends = clear_ends;
    starts = clear_starts;
  }
  std::vector<detail::WallStretch> all = below;
  all.insert(all.end(), above.begin(), above.end());
  const double gate = kGate * noise;
  return {detail::EdgeIndex(ends, gate), detail::EdgeIndex(starts, gate),
          detail::EdgeIndex(all, gate)};
}

void collectHeights(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                    double noise, std::vector<LevelEvidence>& levels) {
  const std::size_t n = layers.size();
  std::vector<LevelWalls> walls;
  for (std::size_t k = 0; k <= n; ++k) {
    walls.push_back(wallsAt(
        k > 0 ? detail::stretchesOf(layers[k - 1].plan) : std::vector<detail::WallStretch>(),
        k < n ? detail::stretchesOf(layers[k].plan) : std::vector<detail::WallStretch>(), noise));
  }
  const double margin = kEndMargin * noise;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3d p = points.positions[i].cast<double>();
    if (!detail::isWallNormal(points.normals[i])) continue;  // roofs and ground end no wall
    const Eigen::Vector2d normal = points.normals[i].head<2>().cast<double>();
    // Levels are sorted, and windows overlap only with their neighbours'.
    const auto next =
        std::lower_bound(levels.begin(), levels.end(), p.z(),
                         [](const LevelEvidence& level, double z) { return level.high < z; });
    for (auto level = next; level != levels.end() && level->low <= p.z(); ++level) {
      if (p.z() > level->high) continue;
      const LevelWalls& at = walls[static_cast<std::size_t>(level - levels.begin())];
      // A point tells of a wall's end only if no other wall is nearer.
      const double any = at.all.distance(p.head<2>(), normal, 0.0) + 1e-9 * noise;
      if (!std::isfinite(any)) continue;  // of no wall at all
      const double end = at.ends.distance(p.head<2>(), normal, margin);
      const double start = at.starts.distance(p.head<2>(), normal, margin);
      if (end <= any && end <= start) {
        level->ends.push_back(p.z());
      } else if (start <= any) {
        level->starts.push_back(p.z());
      }
    }
  }
}

}  // namespace

void fitHeights(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                const FitOptions& options) {
  if (!(options.noise > 0.0) || !(options.max_shift > 0.0)) {
    PCL_ERROR("[storey::fitHeights] noise is %g and max_shift %g, expected > 0.\n", options.noise,
              options.max_shift);
    return;
  }
  if (layers.empty()) return;
  std::vector<LevelEvidence> levels = makeLevels(layers, options);
  collectHeights(layers, points, options.noise, levels);
  std::vector<double> heights;
  for (const LevelEvidence& level : levels) {
    const double z = bestHeight(level, options.noise, options.max_shift);
    heights.push_back(heights.empty() ? z : std::max(z, heights.back()));
  }
  std::vector<FloorplanLayer> kept;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (heights[k + 1] - heights[k] < kMinLayer * options.noise) {
      const bool at_end = kept.empty() || k + 1 == layers.size();
      heights[k + 1] = at_end ? heights[k] : 0.5 * (heights[k] + heights[k + 1]);
      if (!kept.empty()) kept.back().z_max = heights[k + 1];
      continue;
    }
    layers[k].z_min = heights[k];
    layers[k].z_max = heights[k + 1];
    kept.push_back(layers[k]);
  }
  if (!kept.empty()) layers = std::move(kept);
}

}  // namespace storey
