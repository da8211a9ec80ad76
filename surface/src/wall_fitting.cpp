// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/points_by_wall.h>
#include <storey/surface/detail/wall_corners.h>
#include <storey/surface/detail/wall_panes.h>
#include <storey/surface/floorplan_fitting.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

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

// Weighted moments of the points of a wall along (s) and across (d) it, about its reference point.
struct Moments {
  double w = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0, dd = 0.0;
  std::size_t support = 0;

  void add(double along, double across, double weight) {
    w += weight;
    s += weight * along;
    d += weight * across;
    ss += weight * along * along;
    sd += weight * along * across;
    dd += weight * across * across;
    ++support;
  }
  Moments& operator+=(const Moments& m) {
    w += m.w, s += m.s, d += m.d, ss += m.ss, sd += m.sd, dd += m.dd, support += m.support;
    return *this;
  }
};

// A wall while it is fitted.
struct Wall {
  int id = -1;
  Eigen::Vector2d reference;
  Eigen::Vector2d normal;
  Moments sums = {};
  detail::WallPanes panes = {};

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double spread() const { return sums.ss - sums.s * sums.s / sums.w; }  // of the points along it
  // Of the middle of the points. Panes beyond the gate count there, the moments do not.
  double across(double noise) const {
    return panes.in_use ? panes.offset * noise : sums.d / sums.w;
  }
  double residual(double slope) const {
    const double mean = sums.d / sums.w;
    const double variance = (sums.dd - sums.d * mean - slope * (sums.sd - sums.s * mean)) / sums.w;
    return std::sqrt(std::max(0.0, variance)) / kTukeyScatter;
  }
};

using Walls = std::vector<Wall>;

// The lines by which the points were given to the walls.
Walls wallsOf(const std::vector<detail::WallFrame>& frames) {
  Walls walls;
  for (const detail::WallFrame& frame : frames) {
    walls.push_back({frame.id, frame.reference, frame.normal});
  }
  return walls;
}

// From the frame that the points of a wall were gathered in to that of its line by now.
class FrameChange {
 public:
  FrameChange(const detail::WallFrame& from, const Wall& to)
      : along_(partsOf(from, to, to.tangent())), across_(partsOf(from, to, to.normal)) {}

  double along(const detail::WallPlace& p) const { return sum(along_, p); }
  double across(const detail::WallPlace& p) const { return sum(across_, p); }

 private:
  static Eigen::Vector3d partsOf(const detail::WallFrame& from, const Wall& to,
                                 const Eigen::Vector2d& axis) {
    return {axis.dot(from.reference - to.reference), axis.dot(from.tangent()),
            axis.dot(from.normal)};
  }
  static double sum(const Eigen::Vector3d& parts, const detail::WallPlace& p) {
    return parts[0] + parts[1] * static_cast<double>(p.along) +
           parts[2] * static_cast<double>(p.across);
  }

  Eigen::Vector3d along_;
  Eigen::Vector3d across_;
};

// The points, gathered by wall, and the lines that are fitted to them.
struct WallPoints {
  const detail::PointsByWall& by_wall;
  unsigned int threads;

  // Sums over the points of each wall what `work(wall, along, across, sum)` adds.
  template <typename Sum, typename Work>
  std::vector<Sum> sum(const Walls& walls, const Work& work) const {
    using Place = detail::WallPlace;
    return by_wall.sum<Sum>(threads,
                            [&](std::size_t k, const Place* begin, const Place* end, Sum& total) {
                              const FrameChange change(by_wall.frames()[k], walls[k]);
                              for (const Place* p = begin; p != end; ++p) {
                                work(walls[k], change.along(*p), change.across(*p), total);
                              }
                            });
  }
};

struct Residuals {
  detail::ResidualHistogram histogram;
  std::size_t points = 0;

  Residuals& operator+=(const Residuals& other) {
    histogram += other.histogram;
    points += other.points;
    return *this;
  }
};

// \return whether there are any
bool findPanes(const WallPoints& points, double noise, Walls& walls) {
  const std::vector<Residuals> residuals =
      points.sum<Residuals>(walls, [noise](const Wall&, double, double across, Residuals& sum) {
        sum.histogram.add(across / noise);
        ++sum.points;
      });
  std::vector<Wall*> seen;
  std::vector<detail::ResidualHistogram> histograms;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    walls[k].panes = {};
    if (residuals[k].points < kMinSupport) continue;
    seen.push_back(&walls[k]);
    histograms.push_back(residuals[k].histogram);
  }
  const std::vector<detail::WallPanes> all_panes = detail::fitPanes(histograms, points.threads);
  for (std::size_t k = 0; k < all_panes.size(); ++k) seen[k]->panes = all_panes[k];
  return !all_panes.empty();
}

// Tukey's weights; where the wall has panes, one step of expectation and maximisation.
void sumMoments(const WallPoints& points, double noise, Walls& walls) {
  const std::vector<Moments> sums = points.sum<Moments>(
      walls, [noise](const Wall& wall, double along, double across, Moments& sum) {
        if (wall.panes.in_use) {
          const auto expected = wall.panes.expected(across / noise);
          sum.add(along, expected.residual * noise, expected.weight);
          return;
        }
        const double u = across / (kTukey * noise);
        if (std::abs(u) < 1.0) sum.add(along, across, (1.0 - u * u) * (1.0 - u * u));
      });
  for (std::size_t k = 0; k < walls.size(); ++k) walls[k].sums = sums[k];
}

void rotateTo(Wall& wall, double angle) { wall.normal = {std::cos(angle), std::sin(angle)}; }

void setDeviations(const Wall& wall, double noise, double slope, WallFit& fit) {
  if (wall.panes.in_use) {
    fit.angle_deviation = noise / std::sqrt(wall.panes.information * wall.spread() / wall.sums.w);
    fit.offset_deviation = noise * wall.panes.offset_deviation;
    return;
  }
  const double deviation = kTukeyDeviation * std::max(wall.residual(slope), 0.1 * noise);
  fit.angle_deviation = deviation / std::sqrt(wall.spread());
  fit.offset_deviation = deviation / std::sqrt(wall.sums.w);
}

// Solves each wall: d = a + b s, or d = a where the points are too few to tell b.
std::map<int, WallFit> solve(Walls& walls, double noise) {
  std::map<int, WallFit> fits;
  for (Wall& wall : walls) {
    const Moments& sums = wall.sums;
    WallFit fit;
    fit.normal = wall.normal;
    fit.offset = wall.normal.dot(wall.reference);
    fit.angle_deviation = M_PI;
    if (sums.support >= kMinSupport && sums.w > 0.0 && wall.spread() > 0.0) {
      double slope = (sums.sd - sums.s * sums.d / sums.w) / wall.spread();
      fit.support = sums.support;
      setDeviations(wall, noise, slope, fit);
      const bool contradicts = std::abs(slope) > kSameDirection * fit.angle_deviation;
      if (fit.angle_deviation > kMaxAngleDeviation && !contradicts) slope = 0.0;
      fit.residual = wall.panes.in_use ? wall.panes.deviation * noise : wall.residual(slope);
      const Eigen::Vector2d centre =
          wall.reference + (sums.s / sums.w) * wall.tangent() + wall.across(noise) * wall.normal;
      fit.normal = (wall.normal - slope * wall.tangent()).normalized();
      fit.offset = fit.normal.dot(centre);
      fit.centre = centre;
      wall.reference = centre;  // the line turns about the centre of its points
      wall.normal = fit.normal;
    }
    fits[wall.id] = fit;
  }
  return fits;
}

// Of a wall, modulo 180 degrees.
struct Direction {
  double angle;
  double deviation;
  Wall* wall;
};

// Of the walls that tell theirs, ascending.
std::vector<Direction> knownDirections(Walls& walls, const std::map<int, WallFit>& fits) {
  std::vector<Direction> directions;
  for (Wall& wall : walls) {
    const WallFit& fit = fits.at(wall.id);
    if (fit.support == 0 || fit.angle_deviation > kMaxAngleDeviation) continue;
    double angle = std::atan2(fit.normal.y(), fit.normal.x());
    if (angle < 0.0) angle += M_PI;
    directions.push_back({angle, fit.angle_deviation, &wall});
  }
  std::sort(directions.begin(), directions.end(), [](const Direction& a, const Direction& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.wall->id < b.wall->id;
  });
  return directions;
}

// Walls whose directions agree share the weighted mean; each turns about the centre of its points,
// so that its offset stays the least-squares one.
void shareDirections(Walls& walls, std::map<int, WallFit>& fits) {
  std::vector<Direction> directions = knownDirections(walls, fits);
  if (directions.empty()) return;
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
                      weight > 0.0 ? 1.0 / std::sqrt(weight) : 0.0, nullptr};
      if (end > begin && !agree(group, directions[end], directions[end].angle - group.angle)) break;
      const double w = 1.0 / (directions[end].deviation * directions[end].deviation);
      weight += w;
      sum += w * directions[end].angle;
    }
    for (; begin < end; ++begin) {
      Wall& wall = *directions[begin].wall;
      WallFit& fit = fits.at(wall.id);
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

std::map<int, WallFit> detail::fitWalls(std::vector<FloorplanLayer>& layers,
                                        const FitPoints& points, const FitOptions& options,
                                        PointsByWall& by_wall) {
  if (!(options.noise > 0.0) || std::isinf(options.noise)) {
    PCL_ERROR("[storey::fitWalls] noise is %g, expected finite and > 0.\n", options.noise);
    return {};
  }
  if (points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::fitWalls] %zu normals for %zu points.\n", points.normals.size(),
              points.positions.size());
    return {};
  }
  if (layers.empty()) return {};
  std::map<int, WallFit> fits;
  Walls walls;
  bool panes = false;
  for (int round = 0; round < options.rounds; ++round) {
    const bool anew = by_wall.gather(layers, points, options.noise, options.threads);
    if (anew || round == 0) walls = wallsOf(by_wall.frames());
    const WallPoints of_walls{by_wall, options.threads};
    // About lines that are nearly right; what was not there is not there for the same points.
    if (options.find_panes && round > 0 && (anew || round == 1 || panes)) {
      panes = findPanes(of_walls, options.noise, walls);
    }
    sumMoments(of_walls, options.noise, walls);
    fits = solve(walls, options.noise);
    if (options.share_directions) shareDirections(walls, fits);
    moveCorners(layers, fits);
  }
  return fits;
}

std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options) {
  detail::PointsByWall by_wall;
  return detail::fitWalls(layers, points, options, by_wall);
}

}  // namespace storey
