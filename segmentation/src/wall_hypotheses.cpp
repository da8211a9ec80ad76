// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/building_floorplans.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kSameDirection = 0.07;  // rad, 4 degrees: as good a guess as any between
constexpr double kMinCrossing = 0.26;    // rad, 15 degrees: flatter lines close nothing
constexpr double kMinRun = 15.0;         // noise deviations
constexpr std::size_t kMaxHypotheses = 30;

// Directions (modulo 180 degrees) of the walls, most support first.
std::vector<Eigen::Vector2d> directionsOf(const std::vector<WallLine>& walls) {
  std::vector<Eigen::Vector2d> normals;
  for (const WallLine& wall : walls) {
    const bool known = std::any_of(normals.begin(), normals.end(), [&](const Eigen::Vector2d& n) {
      return std::abs(n.x() * wall.normal.y() - n.y() * wall.normal.x()) < kSameDirection;
    });
    if (!known) normals.push_back(wall.normal);
  }
  return normals;
}

}  // namespace

std::vector<PlanLine> hypothesiseLines(const std::vector<WallLine>& walls, const WallScale& scale) {
  const double reach = std::max(6.0 * scale.noise, 3.0 / std::sqrt(scale.density));
  const std::vector<Eigen::Vector2d> directions = directionsOf(walls);
  std::vector<PlanLine> lines;
  const auto passes = [&](const auto& line, const Eigen::Vector2d& p) {
    return std::abs(line.normal.dot(p) - line.offset) < reach;
  };
  for (const WallLine& wall : walls) {
    for (const auto& [from, to] : wall.runs) {
      if (to - from < kMinRun * scale.noise) continue;
      for (const double s : {from, to}) {
        const Eigen::Vector2d end = wall.offset * wall.normal + s * wall.tangent();
        const auto closes = [&](const auto& other) {
          const double sine =
              std::abs(other.normal.x() * wall.normal.y() - other.normal.y() * wall.normal.x());
          return sine > std::sin(kMinCrossing) && passes(other, end);
        };
        if (std::any_of(walls.begin(), walls.end(), closes) ||
            std::any_of(lines.begin(), lines.end(), closes)) {
          continue;
        }
        for (const Eigen::Vector2d& normal : directions) {
          const double sine = std::abs(normal.x() * wall.normal.y() - normal.y() * wall.normal.x());
          if (sine <= std::sin(kMinCrossing)) continue;
          lines.push_back({normal, normal.dot(end)});
          if (lines.size() == kMaxHypotheses) return lines;
        }
      }
    }
  }
  return lines;
}

}  // namespace storey::detail
