// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/point_classes.h>
#include <storey/segmentation/detail/union_find.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kLevelNormalZ = 0.9;  // cos(25 degrees)
constexpr double kLeaning = 0.139;     // sin(8 degrees)
constexpr double kLeaningDeviations = 3.0;
constexpr double kMinInCube = 8.0;    // points, for a mean normal
constexpr double kCubeSide = 2.0;     // cells of the support of a wall
constexpr double kGroundReach = 6.0;  // noise deviations from the ground's face
constexpr double kGap = 0.5;          // of the side of the least wall
constexpr double kMinGroup = 0.1;     // of the upright points of the largest

using Cube = std::array<long, 3>;

// The cubes of a grid that points lie in, numbered in ascending order.
struct Cubes {
  std::vector<Cube> places;
  std::vector<std::size_t> of;  // number of each point's
};

Cube cubeOf(const Eigen::Vector3d& p, double side) {
  Cube cube{};
  for (std::size_t k = 0; k < 3; ++k) {
    cube[k] = std::lround(std::floor(p[static_cast<Eigen::Index>(k)] / side));
  }
  return cube;
}

Cubes cubesOf(const std::vector<OrientedPoint>& points, double side) {
  std::vector<std::pair<Cube, std::size_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = {cubeOf(points[i].position, side), i};
  std::sort(order.begin(), order.end());
  Cubes cubes;
  cubes.of.resize(points.size());
  for (const auto& [cube, i] : order) {
    if (cubes.places.empty() || cubes.places.back() != cube) cubes.places.push_back(cube);
    cubes.of[i] = cubes.places.size() - 1;
  }
  return cubes;
}

PointClass byNormal(const OrientedPoint& p) {
  const double nz = std::abs(p.normal.z());
  return nz > kLevelNormalZ     ? PointClass::Level
         : nz < kUprightNormalZ ? PointClass::Wall
                                : PointClass::Sloped;
}

void findGround(const std::vector<OrientedPoint>& points, const WallScale& scale,
                std::vector<PointClass>& classes) {
  std::vector<WallPoint> walls;
  std::vector<LevelPoint> levels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OrientedPoint& p = points[i];
    const Eigen::Vector2d at = p.position.head<2>();
    if (classes[i] == PointClass::Wall) {
      walls.push_back({at, p.position.z(), p.normal.head<2>().normalized()});
    } else if (classes[i] == PointClass::Level) {
      levels.push_back({at, p.position.z(), p.normal.z() > 0.0});
    }
  }
  LevelColumns columns = gatherLevelColumns(levels, scale);
  markGround(walls, scale, columns);
  std::map<std::pair<long, long>, const LevelColumn*> column_at;
  for (const LevelColumn& column : columns.columns) column_at[{column.x, column.y}] = &column;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] != PointClass::Level || points[i].normal.z() < 0.0) continue;
    const Cube at = cubeOf(points[i].position, columns.side);
    const auto column = column_at.find({at[0], at[1]});
    if (column == column_at.end()) continue;
    for (const LevelFace& face : column->second->faces) {
      const double off = std::abs(face.z - points[i].position.z());
      if (face.ground && off < kGroundReach * scale.noise) classes[i] = PointClass::Ground;
    }
  }
}

void findLeaning(const std::vector<OrientedPoint>& points, double side,
                 std::vector<PointClass>& classes) {
  struct Lean {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  const Cubes cubes = cubesOf(points, side);
  std::vector<Lean> leans(cubes.places.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] != PointClass::Wall) continue;
    Lean& lean = leans[cubes.of[i]];
    const double nz = points[i].normal.z();
    lean.count += 1.0;
    lean.sum += nz;
    lean.squares += nz * nz;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Lean& lean = leans[cubes.of[i]];
    if (classes[i] != PointClass::Wall || lean.count < kMinInCube) continue;
    const double mean = lean.sum / lean.count;
    const double variance = std::max(0.0, lean.squares / lean.count - mean * mean);
    if (std::abs(mean) > kLeaning + kLeaningDeviations * std::sqrt(variance / lean.count)) {
      classes[i] = PointClass::Sloped;
    }
  }
}

// Groups of occupied cubes that touch.
UnionFind<> groupsOf(const std::vector<Cube>& places, const std::vector<char>& occupied) {
  UnionFind<> groups(places.size());
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (occupied[c] == 0) continue;
    for (long k = 0; k < 13; ++k) {  // half of the 26 around, the others come from them
      const Cube at = {places[c][0] + k / 9 - 1, places[c][1] + k / 3 % 3 - 1,
                       places[c][2] + k % 3 - 1};
      const auto beside = std::lower_bound(places.begin(), places.end(), at);
      const auto b = static_cast<std::size_t>(beside - places.begin());
      if (beside != places.end() && *beside == at && occupied[b] != 0) groups.unite(c, b);
    }
  }
  return groups;
}

void findApart(const std::vector<OrientedPoint>& points, double side,
               std::vector<PointClass>& classes) {
  const auto grouped = [&](std::size_t i) {
    return classes[i] != PointClass::Ground && classes[i] != PointClass::NonPlanar;
  };
  const Cubes cubes = cubesOf(points, side);
  std::vector<char> occupied(cubes.places.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (grouped(i)) occupied[cubes.of[i]] = 1;
  }
  UnionFind<> groups = groupsOf(cubes.places, occupied);
  std::vector<double> upright(cubes.places.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] == PointClass::Wall) upright[groups.find(cubes.of[i])] += 1.0;
  }
  if (upright.empty()) return;
  const double least = kMinGroup * *std::max_element(upright.begin(), upright.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (grouped(i) && upright[groups.find(cubes.of[i])] < least) classes[i] = PointClass::Apart;
  }
}

}  // namespace

std::vector<PointClass> classifyPoints(const std::vector<OrientedPoint>& points,
                                       const std::vector<char>& planar, const WallScale& scale,
                                       double least_wall) {
  std::vector<PointClass> classes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    classes[i] = planar[i] != 0 ? byNormal(points[i]) : PointClass::NonPlanar;
  }
  findGround(points, scale, classes);
  findLeaning(points, kCubeSide * supportCellSize(scale), classes);
  findApart(points, kGap * std::sqrt(least_wall), classes);
  return classes;
}

}  // namespace storey::detail
