// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/detail/level_fitting.h>
#include <storey/surface/detail/plan_rings.h>
#include <storey/surface/detail/unseen_walls.h>
#include <storey/surface/detail/wall_corners.h>
#include <storey/surface/floorplan_fitting.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace storey {
namespace {

constexpr double kUnseen = 0.03;    // of the density that walls have in the middle: strays
constexpr double kGate = 4.0;       // noise deviations across the neighbor
constexpr double kReach = 30.0;     // noise deviations along it that give its density
constexpr double kMaxShift = 15.0;  // noise deviations: a hypothesis is not further off
constexpr double kSameSense = 0.7;  // cosine of 45 degrees, of normals
// Deviations: ends of neighbors that contradict the direction. It is mostly one that other walls
// have, and what hides an end in part moves it by more than chance does.
constexpr double kClearTurn = 8.0;

// Points of a wall and the area they would cover.
double densityOf(const WallFit& fit, double area) {
  return area > 0.0 ? static_cast<double>(fit.support) / area : 0.0;
}

// A corner of an unseen wall with a neighbor that is seen.
struct Corner {
  Eigen::Vector2d position;
  Eigen::Vector2d along;  // the neighbor's direction, away from the corner
  Eigen::Vector2d normal;
  double length = 0.0;
  double z_min = 0.0, z_max = 0.0;
};

// What the points of the neighbor tell of where the wall is, as of a level: across the wall.
detail::LevelEvidence evidenceOf(const Corner& corner, const WallFit& wall, const FitPoints& points,
                                 double noise) {
  const double slope = wall.normal.dot(corner.along);
  const double reach =
      std::min((kReach + kMaxShift) * noise, 0.5 * corner.length * std::abs(slope));
  detail::LevelEvidence evidence(0.0, -reach, reach, noise);
  detail::HeightHistogram& heights = (slope < 0.0 ? evidence.ends : evidence.starts)[0];
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3d p = points.positions[i].cast<double>();
    if (p.z() < corner.z_min || p.z() > corner.z_max) continue;
    const Eigen::Vector2d off = p.head<2>() - corner.position;
    const double across = wall.normal.dot(off);
    if (std::abs(across) > reach || std::abs(corner.normal.dot(off)) > kGate * noise) continue;
    const Eigen::Vector3f& n = points.normals[i];
    const Eigen::Vector2d normal = n.head<2>().cast<double>();
    if (!detail::isWallNormal(n) || normal.dot(corner.normal) < kSameSense * normal.norm())
      continue;
    heights.add(across);
  }
  return evidence;
}

std::vector<Corner> cornersOf(int wall, const std::vector<FloorplanLayer>& layers,
                              const std::map<int, WallFit>& fits,
                              const std::map<int, WallFit>& unseen) {
  std::vector<Corner> corners;
  for (const FloorplanLayer& layer : layers) {
    detail::forEachRing(layer.plan, [&](const FloorplanRing& ring) {
      const std::size_t n = ring.size();
      for (std::size_t i = 0; i < n; ++i) {
        if (ring.edges[i].wall != wall) continue;
        for (const bool next : {false, true}) {
          const std::size_t edge = next ? (i + 1) % n : (i + n - 1) % n;
          const auto fit = fits.find(ring.edges[edge].wall);
          if (fit == fits.end() || unseen.count(fit->first) > 0) continue;
          const Eigen::Vector2d& at = ring.vertices[next ? edge : i];
          const Eigen::Vector2d& to = ring.vertices[next ? (edge + 1) % n : edge];
          corners.push_back({at, (to - at).normalized(), fit->second.normal, (to - at).norm(),
                             layer.z_min, layer.z_max});
        }
      }
    });
  }
  return corners;
}

// Where the neighbors end, across the wall.
std::vector<HeightFit> fitEnds(const std::vector<Corner>& corners, const FitPoints& points,
                               double noise, const WallFit& wall) {
  std::vector<detail::LevelEvidence> evidence;
  for (const Corner& corner : corners) {
    evidence.push_back(evidenceOf(corner, wall, points, noise));
  }
  const auto fitAll = [&](double tails) {
    std::vector<HeightFit> ends;
    for (const detail::LevelEvidence& end : evidence) {
      ends.push_back(detail::LevelFitting(end, noise, kMaxShift * noise).fit(tails));
    }
    return ends;
  };
  const std::vector<HeightFit> ends = fitAll(0.0);
  const double tails = detail::tailsOf(evidence, ends, noise);
  return tails > 0.0 ? fitAll(tails) : ends;
}

// The line through what all corners tell: its direction stays unless they contradict, and all of it
// where they tell nothing.
void fitToCorners(const std::vector<Corner>& corners, const FitPoints& points, double noise,
                  WallFit& wall) {
  const std::vector<HeightFit> ends = fitEnds(corners, points, noise, wall);
  double w = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0;
  const Eigen::Vector2d tangent(-wall.normal.y(), wall.normal.x());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    const HeightFit& end = ends[i];
    if (std::isinf(end.deviation)) continue;
    const double weight = 1.0 / (end.deviation * end.deviation);
    const double along = tangent.dot(corner.position);
    const double across = wall.normal.dot(corner.position) + end.z;
    w += weight, s += weight * along, d += weight * across;
    ss += weight * along * along, sd += weight * along * across;
  }
  if (w == 0.0) return;
  wall.centre = (s / w) * tangent + (d / w) * wall.normal;
  const double spread = ss - s * s / w;
  const double slope = spread > 0.0 ? (sd - s * d / w) / spread : 0.0;
  if (std::abs(slope) * std::sqrt(spread) > kClearTurn) {
    wall.normal = (wall.normal - slope * tangent).normalized();
    wall.angle_deviation = 1.0 / std::sqrt(spread);
  }
  wall.offset = wall.normal.dot(wall.centre);
  wall.offset_deviation = 1.0 / std::sqrt(w);
}

}  // namespace

std::map<int, WallFit> detail::unseenWalls(const std::vector<FloorplanLayer>& layers,
                                           const std::map<int, WallFit>& fits) {
  std::map<int, double> areas;
  for (const FloorplanLayer& layer : layers) {
    detail::forEachRing(layer.plan, [&](const FloorplanRing& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        areas[ring.edges[i].wall] +=
            (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm() *
            (layer.z_max - layer.z_min);
      }
    });
  }
  std::vector<double> densities;
  for (const auto& [id, fit] : fits) densities.push_back(densityOf(fit, areas[id]));
  if (densities.empty()) return {};
  const auto middle = densities.begin() + static_cast<std::ptrdiff_t>(densities.size() / 2);
  std::nth_element(densities.begin(), middle, densities.end());
  std::map<int, WallFit> unseen;
  for (const auto& [id, fit] : fits) {
    if (densityOf(fit, areas[id]) < kUnseen * *middle) unseen.emplace(id, fit);
  }
  return unseen;
}

void fitUnseenWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
                    std::map<int, WallFit>& fits, unsigned int threads) {
  const std::map<int, WallFit> unseen = detail::unseenWalls(layers, fits);
  if (unseen.empty()) return;
  std::vector<std::pair<int, WallFit>> walls(unseen.begin(), unseen.end());
#pragma omp parallel for num_threads(detail::threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(walls.size()); ++i) {
    auto& [id, wall] = walls[static_cast<std::size_t>(i)];
    fitToCorners(cornersOf(id, layers, fits, unseen), points, noise, wall);
  }
  for (const auto& [id, wall] : walls) fits[id] = wall;
  detail::moveCorners(layers, fits);
}

}  // namespace storey
