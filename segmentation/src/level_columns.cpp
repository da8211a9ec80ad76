// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGap = 6.0;           // noise deviations between two faces of one column
constexpr double kFlat = 2.0;          // noise deviations, spread of one face's heights
constexpr std::size_t kMinPoints = 3;  // of a face; fewer may be outliers
constexpr int kMinContinued = 3;       // of eight squares around

using Square = std::pair<long, long>;
using Squares = std::map<Square, std::vector<LevelFace>>;

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

bool isContinued(const Squares& squares, const Square& at, const LevelFace& face, double noise) {
  int continued = 0;
  for (long dx = -1; dx <= 1; ++dx) {
    for (long dy = -1; dy <= 1; ++dy) {
      const auto beside = squares.find({at.first + dx, at.second + dy});
      if ((dx == 0 && dy == 0) || beside == squares.end()) continue;
      continued +=
          std::any_of(beside->second.begin(), beside->second.end(),
                      [&](const LevelFace& other) {
                        return other.up == face.up && std::abs(other.z - face.z) < kGap * noise;
                      })
              ? 1
              : 0;
    }
  }
  return continued >= kMinContinued;
}

}  // namespace

LevelColumns gatherLevelColumns(const std::vector<LevelPoint>& points, const WallScale& scale) {
  const double side = supportCellSize(scale);
  std::vector<std::pair<Square, LevelPoint>> order;
  for (const LevelPoint& p : points) {
    order.push_back({{std::lround(std::floor(p.position.x() / side)),
                      std::lround(std::floor(p.position.y() / side))},
                     p});
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.z, a.second.up) < std::tie(b.first, b.second.z, b.second.up);
  });
  Squares squares;
  std::vector<LevelPoint> members;
  for (std::size_t i = 0; i < order.size(); ++i) {
    members.push_back(order[i].second);
    if (i + 1 < order.size() && order[i + 1].first == order[i].first) continue;
    squares.emplace_hint(squares.end(), order[i].first, facesOf(members, scale.noise));
    members.clear();
  }
  LevelColumns result;
  result.side = side;
  for (const auto& [at, faces] : squares) {
    LevelColumn column;
    column.x = at.first;
    column.y = at.second;
    column.center = side * Eigen::Vector2d(static_cast<double>(at.first) + 0.5,
                                           static_cast<double>(at.second) + 0.5);
    for (const LevelFace& face : faces) {
      if (isContinued(squares, at, face, scale.noise)) column.faces.push_back(face);
    }
    if (!column.faces.empty()) result.columns.push_back(std::move(column));
  }
  return result;
}

}  // namespace storey::detail
