// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/wall_solving.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
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

void rotateTo(FittedWall& wall, double angle) { wall.normal = {std::cos(angle), std::sin(angle)}; }

void setDeviations(const FittedWall& wall, double noise, double slope, WallFit& fit) {
  if (wall.panes.in_use) {
    fit.angle_deviation = noise / std::sqrt(wall.panes.information * wall.spread() / wall.sums.w);
    fit.offset_deviation = noise * wall.panes.offset_deviation;
    return;
  }
  const double deviation = kTukeyDeviation * std::max(wall.residual(slope), 0.1 * noise);
  fit.angle_deviation = deviation / std::sqrt(wall.spread());
  fit.offset_deviation = deviation / std::sqrt(wall.sums.w);
}

// Of a wall, modulo 180 degrees.
struct Direction {
  double angle;
  double deviation;
  FittedWall* wall;
};

// Of the walls that tell theirs, ascending.
std::vector<Direction> knownDirections(FittedWalls& walls, const std::map<int, WallFit>& fits) {
  std::vector<Direction> directions;
  for (FittedWall& wall : walls) {
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

}  // namespace

double FittedWall::residual(double slope) const {
  const double mean = sums.d / sums.w;
  const double variance = (sums.dd - sums.d * mean - slope * (sums.sd - sums.s * mean)) / sums.w;
  return std::sqrt(std::max(0.0, variance)) / kTukeyScatter;
}

FittedWalls wallsOf(const std::vector<WallFrame>& frames) {
  FittedWalls walls;
  for (const WallFrame& frame : frames) {
    walls.push_back({frame.id, frame.reference, frame.normal});
  }
  return walls;
}

double tukeyWeight(double across) {
  const double u = across / kTukey;
  return std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
}

std::map<int, WallFit> solveWalls(FittedWalls& walls, double noise) {
  std::map<int, WallFit> fits;
  for (FittedWall& wall : walls) {
    const WallMoments& sums = wall.sums;
    WallFit fit;
    fit.normal = wall.normal;
    fit.offset = wall.normal.dot(wall.reference);
    fit.angle_deviation = M_PI;
    if (sums.support >= kMinWallSupport && sums.w > 0.0 && wall.spread() > 0.0) {
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

void shareDirections(FittedWalls& walls, std::map<int, WallFit>& fits) {
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
      FittedWall& wall = *directions[begin].wall;
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

}  // namespace storey::detail
