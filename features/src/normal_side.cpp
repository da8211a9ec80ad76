// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/normal_side.h>
#include <storey/filters/detail/main_box.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace storey {
namespace {

constexpr double kVotesAcross = 64.0;  // voxels along the longest side of the walls' box
constexpr double kWallNormal = 0.5;    // |n.up| of a wall, 30 degrees
constexpr double kDecided = 0.1;       // |outwardness|
constexpr double kOneSided = 0.4;
constexpr std::size_t kSampled = 250000;  // points, to see where most of them are

struct Vote {
  std::uint64_t key = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // horizontal, like the normal
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double count = 0.0;  // of points
};

std::uint64_t keyOf(const Eigen::Vector3d& x, const Eigen::Vector3d& low, double side) {
  const Eigen::Vector3d cell = (x - low) / side;
  return static_cast<std::uint64_t>(cell.x()) << 32 | static_cast<std::uint64_t>(cell.y()) << 16 |
         static_cast<std::uint64_t>(cell.z());
}

bool isWall(const Eigen::Vector3d& normal, const Eigen::Vector3d& up) {
  return std::abs(normal.dot(up)) < kWallNormal;
}

// The points of walls, without outliers so far away that one voxel would hold the building.
std::vector<std::size_t> wallPoints(const detail::OrientedPoints& points,
                                    const Eigen::Vector3d& up) {
  std::vector<std::size_t> of_walls;
  of_walls.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (isWall(points.normals[i], up)) of_walls.push_back(i);
  }
  std::vector<Eigen::Vector3f> sample;
  for (std::size_t k = 0; k < of_walls.size(); k += of_walls.size() / kSampled + 1) {
    sample.push_back(points.positions[of_walls[k]].cast<float>());
  }
  const Eigen::AlignedBox3f box = detail::mainBoxOf(sample);
  const auto outside = [&](std::size_t i) {
    return !box.contains(points.positions[i].cast<float>());
  };
  of_walls.erase(std::remove_if(of_walls.begin(), of_walls.end(), outside), of_walls.end());
  return of_walls;
}

// The mean position and normal of the wall points in each voxel, by voxel. Opposite normals in a
// voxel weaken its vote.
std::vector<Vote> votesOf(const detail::OrientedPoints& points, const Eigen::Vector3d& up) {
  const std::vector<std::size_t> of_walls = wallPoints(points, up);
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::max());
  Eigen::Array3d high = -low;
  for (const std::size_t i : of_walls) {
    low = low.min(points.positions[i].array());
    high = high.max(points.positions[i].array());
  }
  const double side = (high - low).maxCoeff() / kVotesAcross;
  std::vector<Vote> votes;
  std::unordered_map<std::uint64_t, std::size_t> vote_of_voxel;
  for (const std::size_t i : of_walls) {
    const std::uint64_t key = side > 0.0 ? keyOf(points.positions[i], low.matrix(), side) : 0;
    const auto [place, is_new] = vote_of_voxel.try_emplace(key, votes.size());
    if (is_new) {
      votes.emplace_back().key = key;
    }
    Vote& vote = votes[place->second];
    vote.x += points.positions[i] - up * up.dot(points.positions[i]);
    vote.n += points.normals[i] - up * up.dot(points.normals[i]);
    vote.count += 1.0;
  }
  for (Vote& vote : votes) {
    vote.x /= vote.count;
    vote.n /= vote.count;
  }
  std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.key < b.key; });
  return votes;
}

}  // namespace

NormalSideEvidence detail::judgeNormalSide(const OrientedPoints& points,
                                           const Eigen::Vector3d& up) {
  NormalSideEvidence result;
  if (!up.allFinite() || up.isZero()) {
    return result;
  }
  const std::vector<Vote> votes = votesOf(points, up.normalized());
  if (votes.empty()) {
    return result;
  }
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double length = 0.0;
  for (const Vote& v : votes) {
    center += v.x / static_cast<double>(votes.size());
    normal += v.n;
    length += v.n.norm();
  }
  double flux = 0.0;
  double reach = 0.0;
  for (const Vote& v : votes) {
    flux += v.n.dot(v.x - center);
    reach += (v.x - center).norm();
  }
  result.outwardness = reach > 0.0 ? flux / reach : 0.0;
  result.one_sidedness = length > 0.0 ? normal.norm() / length : 0.0;
  if (result.outwardness > kDecided || result.one_sidedness > kOneSided) {
    result.side = NormalSide::Building;
  } else if (result.outwardness < -kDecided) {
    result.side = NormalSide::Space;
  }
  return result;
}

}  // namespace storey
