// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGap = 6.0;           // noise deviations between two faces of one column
constexpr double kFlat = 2.0;          // noise deviations, spread of one face's heights
constexpr std::size_t kMinPoints = 3;  // of a face; fewer may be outliers
constexpr int kMinContinued = 3;       // of eight squares around

void appendFlatFace(const std::vector<LevelPoint>& points, std::size_t from, std::size_t to,
                    double noise, std::vector<LevelFace>& faces) {
  const auto count = static_cast<double>(to - from);
  if (to - from < kMinPoints) return;
  double sum = 0.0;
  double squares = 0.0;
  double up = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    const double z = points[i].z - points[from].z;
    sum += z;
    squares += z * z;
    up += points[i].up ? 1.0 : -1.0;
  }
  const double mean = sum / count;
  if (squares / count - mean * mean > kFlat * kFlat * noise * noise || up == 0.0) return;
  faces.push_back({points[from].z + mean, up > 0.0, false});
}

// Faces of one square, from its points, lowest first.
std::vector<LevelFace> facesOf(const std::vector<LevelPoint>& points, double noise) {
  std::vector<LevelFace> faces;
  std::size_t from = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size() && points[i].z - points[i - 1].z < kGap * noise) continue;
    appendFlatFace(points, from, i, noise, faces);
    from = i;
  }
  return faces;
}

// The squares of the plan that points lie in, and their faces.
struct Squares {
  GridCells cells;
  std::vector<std::vector<LevelFace>> faces;
};

bool isContinued(const Squares& squares, const GridCell& at, const LevelFace& face, double noise) {
  int continued = 0;
  for (std::int64_t dx = -1; dx <= 1; ++dx) {
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      if (dx == 0 && dy == 0) continue;
      const std::size_t beside = squares.cells.find({at[0] + dx, at[1] + dy, 0});
      if (beside == GridCells::kNone) continue;
      const std::vector<LevelFace>& others = squares.faces[beside];
      const bool goes_on = std::any_of(others.begin(), others.end(), [&](const LevelFace& other) {
        return other.up == face.up && std::abs(other.z - face.z) < kGap * noise;
      });
      continued += goes_on ? 1 : 0;
    }
  }
  return continued >= kMinContinued;
}

}  // namespace

LevelColumns gatherLevelColumns(const std::vector<LevelPoint>& points, const WallScale& scale) {
  LevelColumns result;
  result.side = supportCellSize(scale);
  Squares squares;
  std::vector<std::vector<LevelPoint>> members;
  for (const LevelPoint& p : points) {
    const std::size_t square = squares.cells.add(
        {cellAlong(p.position.x(), result.side), cellAlong(p.position.y(), result.side), 0});
    if (square == members.size()) members.emplace_back();
    members[square].push_back(p);
  }
  for (std::vector<LevelPoint>& of_square : members) {
    std::sort(of_square.begin(), of_square.end(), [](const LevelPoint& a, const LevelPoint& b) {
      return std::tie(a.z, a.up) < std::tie(b.z, b.up);
    });
    squares.faces.push_back(facesOf(of_square, scale.noise));
  }
  for (std::size_t s = 0; s < squares.cells.size(); ++s) {
    const GridCell& at = squares.cells[s];
    LevelColumn column;
    column.x = at[0];
    column.y = at[1];
    column.center = result.side * Eigen::Vector2d(static_cast<double>(at[0]) + 0.5,
                                                  static_cast<double>(at[1]) + 0.5);
    for (const LevelFace& face : squares.faces[s]) {
      if (isContinued(squares, at, face, scale.noise)) column.faces.push_back(face);
    }
    if (!column.faces.empty()) result.columns.push_back(std::move(column));
  }
  return result;
}

}  // namespace storey::detail
