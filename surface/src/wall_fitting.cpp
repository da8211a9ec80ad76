// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/wall_assignment.h>
#include <storey/surface/detail/wall_corners.h>
#include <storey/surface/detail/wall_panes.h>
#include <storey/surface/floorplan_fitting.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

constexpr int kRounds = 3;      // assignment and fit settle in two
constexpr double kTukey = 6.0;  // noise deviations
// Tukey's weights w of k = 6 shrink the scatter of a normal distribution:
// sqrt(E[w u^2] / E[w]) = sqrt((1 - 6 / k^2 + 15 / k^4) / (1 - 2 / k^2 + 3 / k^4)).
constexpr double kTukeyScatter = 0.94468;
// And their efficiency: the deviation of a mean over weights of sum w is this over sqrt(w), from
// E[w] E[w^2 u^2] / E[(w u)']^2 with E[w^2 u^2] = 1 - 12 / k^2 + 90 / k^4 - 420 / k^6 + 945 / k^8
// and E[(w u)'] = 1 - 6 / k^2 + 15 / k^4.
constexpr double kTukeyDeviation = 0.98237;
constexpr double kMaxAngleDeviation = 0.05;  // rad; a wall that tells less keeps its direction,
                                             // unless its points contradict
constexpr double kSameDirection = 3.5;       // standard deviations
constexpr std::size_t kMinSupport = 8;       // points

// A wall while it is fitted: its line, and the weighted moments of its points along (s) and across
// (d) it, about the reference point.
struct Wall {
  Eigen::Vector2d reference;
  Eigen::Vector2d normal;
  double w = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0, dd = 0.0;
  std::size_t support = 0;
  std::vector<Eigen::Vector2d> points;  // along and across
  detail::WallPanes panes;

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double spread() const { return ss - s * s / w; }  // of the points along the wall
  // Of the middle of the points. Panes beyond the gate count there, the moments do not.
  double across(double noise) const { return panes.in_use ? panes.offset * noise : d / w; }
  double residual(double slope) const {
    const double mean = d / w;
    const double variance = (dd - d * mean - slope * (sd - s * mean)) / w;
    return std::sqrt(std::max(0.0, variance)) / kTukeyScatter;
  }
  void collect(const Eigen::Vector2d& point) {
    const Eigen::Vector2d r = point - reference;
    points.emplace_back(r.dot(tangent()), r.dot(normal));
  }
  void add(double along, double across, double weight) {
    w += weight;
    s += weight * along;
    d += weight * across;
    ss += weight * along * along;
    sd += weight * along * across;
    dd += weight * across * across;
    ++support;
  }
};

using Walls = std::map<int, Wall>;

// The lines as the layers have them: of each wall its longest edge.
Walls wallsOf(const std::vector<FloorplanLayer>& layers) {
  Walls walls;
  std::map<int, double> longest;
  for (const FloorplanLayer& layer : layers) {
    for (const detail::WallStretch& stretch : detail::stretchesOf(layer.plan)) {
      if (stretch.wall < 0 || stretch.length <= longest[stretch.wall]) continue;
      longest[stretch.wall] = stretch.length;
      Wall wall;
      wall.reference = stretch.start + 0.5 * stretch.length * stretch.tangent;
      wall.normal = stretch.normal();
      walls[stretch.wall] = wall;
    }
  }
  return walls;
}

void collectPoints(const std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
                   Walls& walls) {
  const detail::WallAssignment assignment(layers, noise);
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const auto wall = walls.find(assignment.wallOf(points.positions[i], points.normals[i]));
    if (wall == walls.end()) continue;
    wall->second.collect(points.positions[i].head<2>().cast<double>());
  }
}

void findPanes(double noise, Walls& walls) {
  std::vector<Wall*> seen;
  std::vector<detail::ResidualHistogram> histograms;
  for (auto& [id, wall] : walls) {
    if (wall.points.size() < kMinSupport) continue;
    seen.push_back(&wall);
    histograms.emplace_back();
    for (const Eigen::Vector2d& point : wall.points) histograms.back().add(point.y() / noise);
  }
  const std::vector<detail::WallPanes> all_panes = detail::fitPanes(histograms);
  for (std::size_t k = 0; k < all_panes.size(); ++k) seen[k]->panes = all_panes[k];
}

// Tukey's weights; where the wall has panes, one step of expectation and maximisation.
void sumMoments(double noise, Wall& wall) {
  for (const Eigen::Vector2d& point : wall.points) {
    if (wall.panes.in_use) {
      const auto expected = wall.panes.expected(point.y() / noise);
      wall.add(point.x(), expected.residual * noise, expected.weight);
      continue;
    }
    const double u = point.y() / (kTukey * noise);
    if (std::abs(u) < 1.0) wall.add(point.x(), point.y(), (1.0 - u * u) * (1.0 - u * u));
  }
}

void rotateTo(Wall& wall, double angle) { wall.normal = {std::cos(angle), std::sin(angle)}; }

void setDeviations(const Wall& wall, double noise, double slope, WallFit& fit) {
  if (wall.panes.in_use) {
    fit.angle_deviation = noise / std::sqrt(wall.panes.information * wall.spread() / wall.w);
    fit.offset_deviation = noise * wall.panes.offset_deviation;
    return;
  }
  const double deviation = kTukeyDeviation * std::max(wall.residual(slope), 0.1 * noise);
  fit.angle_deviation = deviation / std::sqrt(wall.spread());
  fit.offset_deviation = deviation / std::sqrt(wall.w);
}

// Solves each wall: d = a + b s, or d = a where the points are too few to tell b.
std::map<int, WallFit> solve(Walls& walls, double noise) {
  std::map<int, WallFit> fits;
  for (auto& [id, wall] : walls) {
    WallFit fit;
    fit.normal = wall.normal;
    fit.offset = wall.normal.dot(wall.reference);
    fit.angle_deviation = M_PI;
    if (wall.support >= kMinSupport && wall.w > 0.0 && wall.spread() > 0.0) {
      double slope = (wall.sd - wall.s * wall.d / wall.w) / wall.spread();
      fit.support = wall.support;
      setDeviations(wall, noise, slope, fit);
      const bool contradicts = std::abs(slope) > kSameDirection * fit.angle_deviation;
      if (fit.angle_deviation > kMaxAngleDeviation && !contradicts) slope = 0.0;
      fit.residual = wall.panes.in_use ? wall.panes.deviation * noise : wall.residual(slope);
      const Eigen::Vector2d centre =
          wall.reference + (wall.s / wall.w) * wall.tangent() + wall.across(noise) * wall.normal;
      fit.normal = (wall.normal - slope * wall.tangent()).normalized();
      fit.offset = fit.normal.dot(centre);
      fit.centre = centre;
      wall.reference = centre;  // the line turns about the centre of its points
      wall.normal = fit.normal;
    }
    fits[id] = fit;
  }
  return fits;
}

// Walls whose directions (modulo 180 degrees) agree share the weighted mean; each turns about the
// centre of its points, so that its offset stays the least-squares one.
void shareDirections(Walls& walls, std::map<int, WallFit>& fits) {
  struct Direction {
    double angle;
    double deviation;
    int wall;
  };
  std::vector<Direction> directions;
  for (const auto& [id, fit] : fits) {
    if (fit.support == 0 || fit.angle_deviation > kMaxAngleDeviation) continue;
    double angle = std::atan2(fit.normal.y(), fit.normal.x());
    if (angle < 0.0) angle += M_PI;
    directions.push_back({angle, fit.angle_deviation, id});
  }
  if (directions.empty()) return;
  std::sort(directions.begin(), directions.end(), [](const Direction& a, const Direction& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.wall < b.wall;
  });
  const auto agree = [](const Direction& a, const Direction& b, double turn) {
    return turn <= kSameDirection * std::hypot(a.deviation, b.deviation);
  };
  // Cut the half circle open between two directions that differ, so that no group is split.
  std::size_t first = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Direction& before = directions[(i + directions.size() - 1) % directions.size()];
    const double turn = directions[i].angle - before.angle + (i == 0 ? M_PI : 0.0);
    if (!agree(before, directions[i], turn)) {
      first = i;
      break;
    }
  }
  std::rotate(directions.begin(), directions.begin() + static_cast<std::ptrdiff_t>(first),
              directions.end());
  for (std::size_t i = directions.size() - first; i < directions.size(); ++i) {
    directions[i].angle += M_PI;
  }
  for (std::size_t begin = 0; begin < directions.size();) {
    double weight = 0.0;
    double sum = 0.0;
    std::size_t end = begin;
    for (; end < directions.size(); ++end) {
      Direction group{weight > 0.0 ? sum / weight : 0.0,
                      weight > 0.0 ? 1.0 / std::sqrt(weight) : 0.0, -1};
      if (end > begin && !agree(group, directions[end], directions[end].angle - group.angle)) break;
      const double w = 1.0 / (directions[end].deviation * directions[end].deviation);
      weight += w;
      sum += w * directions[end].angle;
    }
    for (; begin < end; ++begin) {
      Wall& wall = walls.at(directions[begin].wall);
      WallFit& fit = fits.at(directions[begin].wall);
      const bool opposite =
          fit.normal.dot(Eigen::Vector2d(std::cos(sum / weight), std::sin(sum / weight))) < 0.0;
      rotateTo(wall, sum / weight + (opposite ? M_PI : 0.0));
      fit.normal = wall.normal;
      fit.offset = wall.normal.dot(wall.reference);
      fit.angle_deviation = 1.0 / std::sqrt(weight);
    }
  }
}

}  // namespace

std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options) {
  if (!(options.noise > 0.0) || std::isinf(options.noise)) {
    PCL_ERROR("[storey::fitWalls] noise is %g, expected finite and > 0.\n", options.noise);
    return {};
  }
  if (points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::fitWalls] %zu normals for %zu points.\n", points.normals.size(),
              points.positions.size());
    return {};
  }
  std::map<int, WallFit> fits;
  for (int round = 0; round < kRounds; ++round) {
    Walls walls = wallsOf(layers);
    collectPoints(layers, points, options.noise, walls);
    if (options.find_panes && round > 0)
      findPanes(options.noise, walls);  // about lines that are nearly right
    for (auto& [id, wall] : walls) sumMoments(options.noise, wall);
    fits = solve(walls, options.noise);
    if (options.share_directions) shareDirections(walls, fits);
    detail::moveCorners(layers, fits);
  }
  return fits;
}

}  // namespace storey
