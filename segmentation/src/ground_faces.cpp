// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/level_columns.h>
#include <storey/segmentation/detail/union_find.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kReach = 0.25;     // of the diagonal of the walls' box, around a face
constexpr double kMaxSlope = 0.1;   // of the ground
constexpr double kStep = 6.0;       // noise deviations between squares of one surface
constexpr double kLowShare = 0.05;  // of the wall points of a patch, which may lie below ground
constexpr double kMinGround = 0.5;  // of the squares of a surface
constexpr int kPatchesInReach = 2;

using Patch = std::pair<long, long>;

Patch patchOf(const Eigen::Vector2d& p, double side) {
  return {cellAlong(p.x(), side), cellAlong(p.y(), side)};
}

double diagonalOf(const std::vector<Eigen::Vector3f>& walls) {
  Eigen::Vector3f low = walls.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& p : walls) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).cast<double>().norm();
}

// The least height in each patch of the plan, of walls and of level faces.
std::map<Patch, double> lowest(const std::vector<Eigen::Vector3f>& walls,
                               const LevelColumns& columns, double side) {
  std::map<Patch, std::vector<float>> heights;
  auto entry = heights.end();  // points that follow each other are mostly of one patch
  for (const Eigen::Vector3f& p : walls) {
    const Patch patch = patchOf(p.head<2>().cast<double>(), side);
    if (entry == heights.end() || entry->first != patch) entry = heights.try_emplace(patch).first;
    entry->second.push_back(p.z());
  }
  std::map<Patch, double> low;
  for (auto& [at, values] : heights) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(kLowShare * static_cast<double>(values.size()));
    std::nth_element(values.begin(), place, values.end());
    low[at] = static_cast<double>(*place);
  }
  for (const LevelColumn& column : columns.columns) {
    double& value = low.emplace(patchOf(column.center, side), column.faces.front().z).first->second;
    value = std::min(value, column.faces.front().z);
  }
  return low;
}

// Surfaces of faces up: squares side by side without a step.
class Surfaces {
 public:
  Surfaces(const LevelColumns& columns, double step) : columns_(columns), sets_(0) {
    for (const LevelColumn& column : columns.columns) {
      squares_.add({column.x, column.y, 0});
      first_.push_back(size_);
      size_ += column.faces.size();
    }
    sets_ = UnionFind<>(size_);
    for (std::size_t c = 0; c < columns.columns.size(); ++c) {
      for (const auto& [dx, dy] : {std::pair{1L, 0L}, {0L, 1L}, {1L, 1L}, {1L, -1L}}) {
        const std::size_t beside =
            squares_.find({columns.columns[c].x + dx, columns.columns[c].y + dy, 0});
        if (beside != GridCells::kNone) join(c, beside, step);
      }
    }
  }

  std::size_t size() const { return size_; }
  std::size_t surfaceOf(std::size_t column, std::size_t face) {
    return sets_.find(first_[column] + face);
  }

 private:
  void join(std::size_t a, std::size_t b, double step) {
    const std::vector<LevelFace>& some = columns_.columns[a].faces;
    const std::vector<LevelFace>& others = columns_.columns[b].faces;
    for (std::size_t i = 0; i < some.size(); ++i) {
      for (std::size_t j = 0; j < others.size(); ++j) {
        if (some[i].up && others[j].up && std::abs(some[i].z - others[j].z) < step) {
          sets_.unite(first_[a] + i, first_[b] + j);
        }
      }
    }
  }

  const LevelColumns& columns_;
  GridCells squares_;  // numbered as the columns
  std::vector<std::size_t> first_;
  std::size_t size_ = 0;
  UnionFind<> sets_;
};

}  // namespace

void markGround(const std::vector<Eigen::Vector3f>& walls, const WallScale& scale,
                LevelColumns& columns) {
  if (walls.empty() || columns.columns.empty()) return;
  const double side = kReach * diagonalOf(walls) / kPatchesInReach;
  const std::map<Patch, double> low = lowest(walls, columns, side);
  std::map<Patch, double> around;
  for (const LevelColumn& column : columns.columns) {
    const auto [entry, added] = around.emplace(patchOf(column.center, side), 0.0);
    if (!added) continue;
    entry->second = std::numeric_limits<double>::infinity();
    for (long dx = -kPatchesInReach; dx <= kPatchesInReach; ++dx) {
      for (long dy = -kPatchesInReach; dy <= kPatchesInReach; ++dy) {
        const auto found = low.find({entry->first.first + dx, entry->first.second + dy});
        if (found != low.end()) entry->second = std::min(entry->second, found->second);
      }
    }
  }
  const double tolerance = kMaxSlope * kPatchesInReach * side + kStep * scale.noise;
  Surfaces surfaces(columns, kStep * scale.noise);
  std::vector<double> squares(surfaces.size(), 0.0);
  std::vector<double> at_foot(surfaces.size(), 0.0);
  const auto forEachFaceUp = [&](auto work) {
    for (std::size_t c = 0; c < columns.columns.size(); ++c) {
      LevelColumn& column = columns.columns[c];
      for (std::size_t i = 0; i < column.faces.size(); ++i) {
        if (column.faces[i].up) work(column, column.faces[i], surfaces.surfaceOf(c, i));
      }
    }
  };
  forEachFaceUp([&](const LevelColumn& column, const LevelFace& face, std::size_t surface) {
    squares[surface] += 1.0;
    if (face.z < around.at(patchOf(column.center, side)) + tolerance) at_foot[surface] += 1.0;
  });
  forEachFaceUp([&](const LevelColumn&, LevelFace& face, std::size_t surface) {
    face.ground = at_foot[surface] > kMinGround * squares[surface];
  });
}

}  // namespace storey::detail
