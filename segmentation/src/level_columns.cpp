// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGap = 6.0;              // noise deviations between two faces of one column
constexpr double kFlat = 2.0;             // noise deviations, spread of one face's heights
constexpr std::ptrdiff_t kMinPoints = 3;  // of a face; fewer may be outliers
constexpr int kMinContinued = 3;          // of eight squares around

using Points = std::vector<LevelPoint>::const_iterator;

void appendFlatFace(Points from, Points to, double noise, std::vector<LevelFace>& faces) {
  const auto count = static_cast<double>(to - from);
  if (to - from < kMinPoints) return;
  double sum = 0.0;
  double squares = 0.0;
  double up = 0.0;
  for (Points point = from; point != to; ++point) {
    const double z = point->z - from->z;
    sum += z;
    squares += z * z;
    up += point->up ? 1.0 : -1.0;
  }
  const double mean = sum / count;
  if (squares / count - mean * mean > kFlat * kFlat * noise * noise || up == 0.0) return;
  faces.push_back({from->z + mean, up > 0.0, false});
}

// Faces of one square, from its points, lowest first.
std::vector<LevelFace> facesOf(Points begin, Points end, double noise) {
  std::vector<LevelFace> faces;
  Points from = begin;
  for (Points point = begin; point != end; ++point) {
    if (point == from || point->z - (point - 1)->z < kGap * noise) continue;
    appendFlatFace(from, point, noise, faces);
    from = point;
  }
  if (from != end) appendFlatFace(from, end, noise, faces);
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

// Calls `work(square)` for all squares, from several threads.
template <typename Work>
void forEachSquare(const Squares& squares, unsigned int threads, const Work& work) {
  const auto count = static_cast<std::ptrdiff_t>(squares.cells.size());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 256)
  for (std::ptrdiff_t square = 0; square < count; ++square) work(static_cast<std::size_t>(square));
}

Squares squaresOf(const std::vector<LevelPoint>& points, double side, double noise,
                  unsigned int threads) {
  Squares squares;
  std::vector<std::size_t> square_of;
  square_of.reserve(points.size());
  for (const LevelPoint& p : points) {
    square_of.push_back(
        squares.cells.add({cellAlong(p.position.x(), side), cellAlong(p.position.y(), side), 0}));
  }
  std::vector<std::size_t> ends(squares.cells.size() + 1, 0);  // of each square, once it is filled
  for (const std::size_t square : square_of) ++ends[square + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<LevelPoint> by_square(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) by_square[ends[square_of[i]]++] = points[i];
  squares.faces.resize(squares.cells.size());
  forEachSquare(squares, threads, [&](std::size_t s) {
    const auto begin = by_square.begin() + static_cast<std::ptrdiff_t>(s > 0 ? ends[s - 1] : 0);
    const auto end = by_square.begin() + static_cast<std::ptrdiff_t>(ends[s]);
    std::sort(begin, end, [](const LevelPoint& a, const LevelPoint& b) {
      return std::tie(a.z, a.up) < std::tie(b.z, b.up);
    });
    squares.faces[s] = facesOf(begin, end, noise);
  });
  return squares;
}

LevelColumn columnAt(const Squares& squares, std::size_t square, double side, double noise) {
  const GridCell& at = squares.cells[square];
  LevelColumn column;
  column.x = at[0];
  column.y = at[1];
  column.center =
      side * Eigen::Vector2d(static_cast<double>(at[0]) + 0.5, static_cast<double>(at[1]) + 0.5);
  for (const LevelFace& face : squares.faces[square]) {
    if (isContinued(squares, at, face, noise)) column.faces.push_back(face);
  }
  return column;
}

}  // namespace

LevelColumns gatherLevelColumns(const std::vector<LevelPoint>& points, const WallScale& scale,
                                unsigned int threads) {
  LevelColumns result;
  result.side = supportCellSize(scale);
  const Squares squares = squaresOf(points, result.side, scale.noise, threads);
  std::vector<LevelColumn> columns(squares.cells.size());
  forEachSquare(squares, threads, [&](std::size_t s) {
    columns[s] = columnAt(squares, s, result.side, scale.noise);
  });
  for (LevelColumn& column : columns) {
    if (!column.faces.empty()) result.columns.push_back(std::move(column));
  }
  return result;
}

}  // namespace storey::detail
