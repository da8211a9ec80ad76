// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/planar_patches.h>
#include <storey/segmentation/detail/point_classes.h>
#include <storey/segmentation/detail/point_cubes.h>
#include <storey/segmentation/detail/union_find.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace storey::detail {
namespace {

constexpr double kLevelNormalZ = 0.9;  // cos(25 degrees)
constexpr double kLeaning = 0.139;     // sin(8 degrees)
constexpr double kLeaningDeviations = 3.0;
constexpr double kMinInCube = 8.0;    // points, for a mean normal
constexpr double kCubeSide = 2.0;     // cells of the support of a wall
constexpr double kGroundReach = 6.0;  // noise deviations from the ground's face
constexpr double kGap = 0.5;          // of the side of the least wall
constexpr double kMinShare = 0.5;     // of the points in the cells of a patch
constexpr double kBeside = 0.25;      // of the side of the least wall
constexpr double kMinGroup = 0.1;     // of the upright points of the largest

PointClass byNormal(const OrientedPoint& p) {
  const double nz = std::abs(static_cast<double>(p.normal.z()));
  return nz > kLevelNormalZ     ? PointClass::Level
         : nz < kUprightNormalZ ? PointClass::Wall
                                : PointClass::Sloped;
}

void findGround(const std::vector<OrientedPoint>& points, const WallScale& scale,
                unsigned int threads, std::vector<PointClass>& classes) {
  std::vector<LevelPoint> levels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] != PointClass::Level) continue;
    const Eigen::Vector3d p = points[i].position.cast<double>();
    levels.push_back({p.head<2>(), p.z(), points[i].normal.z() > 0.0f});
  }
  LevelColumns columns = gatherLevelColumns(levels, scale, threads);
  if (columns.columns.empty()) return;
  std::vector<Eigen::Vector3f> walls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] == PointClass::Wall) walls.push_back(points[i].position);
  }
  markGround(walls, scale, columns);
  GridCells squares;
  for (const LevelColumn& column : columns.columns) squares.add({column.x, column.y, 0});
  forEachChunk(points.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (classes[i] != PointClass::Level || points[i].normal.z() < 0.0f) continue;
      const Eigen::Vector3d p = points[i].position.cast<double>();
      const std::size_t column =
          squares.find({cellAlong(p.x(), columns.side), cellAlong(p.y(), columns.side), 0});
      if (column == GridCells::kNone) continue;
      for (const LevelFace& face : columns.columns[column].faces) {
        const double off = std::abs(face.z - p.z());
        if (face.ground && off < kGroundReach * scale.noise) classes[i] = PointClass::Ground;
      }
    }
  });
}

void findLeaning(const std::vector<OrientedPoint>& points, double side, unsigned int threads,
                 std::vector<PointClass>& classes) {
  struct Lean {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  const PointCubes cubes = sortIntoCubes(
      points, side, [&](std::size_t i) { return classes[i] == PointClass::Wall; }, threads);
  std::vector<Lean> leans(cubes.cells.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cubes.of[i] == PointCubes::kNone) continue;
    Lean& lean = leans[cubes.of[i]];
    const double nz = static_cast<double>(points[i].normal.z());
    lean.count += 1.0;
    lean.sum += nz;
    lean.squares += nz * nz;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cubes.of[i] == PointCubes::kNone) continue;
    const Lean& lean = leans[cubes.of[i]];
    if (lean.count < kMinInCube) continue;
    const double mean = lean.sum / lean.count;
    const double variance = std::max(0.0, lean.squares / lean.count - mean * mean);
    if (std::abs(mean) > kLeaning + kLeaningDeviations * std::sqrt(variance / lean.count)) {
      classes[i] = PointClass::Sloped;
    }
  }
}

// Groups of cubes that touch.
UnionFind<> groupsOf(const GridCells& cubes) {
  UnionFind<> groups(cubes.size());
  for (std::size_t c = 0; c < cubes.size(); ++c) {
    for (std::int64_t k = 0; k < 13; ++k) {  // half of the 26 around, the others come from them
      const std::size_t beside = cubes.find(
          {cubes[c][0] + k / 9 - 1, cubes[c][1] + k / 3 % 3 - 1, cubes[c][2] + k % 3 - 1});
      if (beside != GridCells::kNone) groups.unite(c, beside);
    }
  }
  return groups;
}

void findSmall(const std::vector<OrientedPoint>& points, const WallScale& scale, double least_wall,
               unsigned int threads, std::vector<PointClass>& classes) {
  std::vector<char> counts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    counts[i] = classes[i] != PointClass::Ground && classes[i] != PointClass::NonPlanar ? 1 : 0;
  }
  const PlanarPatches patches = findPlanarPatches(points, counts, scale, threads);
  const double side = kBeside * std::sqrt(least_wall);
  const auto isLarge = [&](std::size_t i) {
    const std::uint32_t patch = patches.of[i];
    return patch != PlanarPatches::kNone && patches.area[patch] > least_wall &&
           patches.share[patch] > kMinShare;
  };
  const PointCubes large = sortIntoCubes(points, side, isLarge, threads);
  const auto isBeside = [&](const OrientedPoint& point) {
    const GridCell at = cubeAt(point.position, side);
    for (std::int64_t k = 0; k < 27; ++k) {
      const GridCell beside = {at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1};
      if (large.cells.find(beside) != GridCells::kNone) return true;
    }
    return false;
  };
  forEachChunk(points.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (counts[i] == 0 || large.of[i] != PointCubes::kNone) continue;
      if (!isBeside(points[i])) classes[i] = PointClass::Small;
    }
  });
}

void findApart(const std::vector<OrientedPoint>& points, double side, unsigned int threads,
               std::vector<PointClass>& classes) {
  const auto isSolid = [&](std::size_t i) {
    return classes[i] != PointClass::Ground && classes[i] != PointClass::NonPlanar &&
           classes[i] != PointClass::Small;
  };
  const PointCubes cubes = sortIntoCubes(points, side, isSolid, threads);
  UnionFind<> groups = groupsOf(cubes.cells);
  std::vector<double> upright(cubes.cells.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (classes[i] == PointClass::Wall) upright[groups.find(cubes.of[i])] += 1.0;
  }
  if (upright.empty()) return;
  const double least = kMinGroup * *std::max_element(upright.begin(), upright.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cubes.of[i] == PointCubes::kNone) continue;
    if (upright[groups.find(cubes.of[i])] < least) classes[i] = PointClass::Apart;
  }
}

}  // namespace

std::vector<PointClass> classifyPoints(const std::vector<OrientedPoint>& points,
                                       const std::vector<char>& planar, const WallScale& scale,
                                       double least_wall, unsigned int threads) {
  std::vector<PointClass> classes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    classes[i] = planar[i] != 0 ? byNormal(points[i]) : PointClass::NonPlanar;
  }
  findGround(points, scale, threads, classes);
  findLeaning(points, kCubeSide * supportCellSize(scale), threads, classes);
  findSmall(points, scale, least_wall, threads, classes);
  findApart(points, kGap * std::sqrt(least_wall), threads, classes);
  return classes;
}

}  // namespace storey::detail
