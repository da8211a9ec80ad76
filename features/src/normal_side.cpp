// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/normal_side.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace storey {
namespace {

constexpr double kVotesAcross = 64.0;  // voxels along the longest side of the walls' box
constexpr double kWallNormal = 0.5;    // |n.up| of a wall, 30 degrees
constexpr double kDecided = 0.1;       // |outwardness|
constexpr double kOneSided = 0.4;

struct Vote {
  std::uint64_t key = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // horizontal, like the normal
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
};

std::uint64_t keyOf(const Eigen::Vector3d& x, const Eigen::Vector3d& low, double side) {
  const Eigen::Vector3d cell = (x - low) / side;
  return static_cast<std::uint64_t>(cell.x()) << 32 | static_cast<std::uint64_t>(cell.y()) << 16 |
         static_cast<std::uint64_t>(cell.z());
}

std::vector<Vote> wallPoints(const detail::OrientedPoints& points, const Eigen::Vector3d& up) {
  std::vector<Vote> walls;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points.normals[i].dot(up)) < kWallNormal) {
      const Eigen::Vector3d& x = points.positions[i];
      low = walls.empty() ? x : Eigen::Vector3d(low.cwiseMin(x));
      high = walls.empty() ? x : Eigen::Vector3d(high.cwiseMax(x));
      walls.push_back({0, x, points.normals[i]});
    }
  }
  const double side = (high - low).maxCoeff() / kVotesAcross;
  for (Vote& w : walls) {
    w.key = side > 0.0 ? keyOf(w.x, low, side) : 0;
    w.x -= up * up.dot(w.x);
    w.n -= up * up.dot(w.n);
  }
  std::stable_sort(walls.begin(), walls.end(),
                   [](const Vote& a, const Vote& b) { return a.key < b.key; });
  return walls;
}

// The mean position and normal of each voxel. Opposite normals in a voxel weaken its vote.
std::vector<Vote> votesOf(const std::vector<Vote>& walls) {
  std::vector<Vote> votes;
  for (std::size_t begin = 0; begin < walls.size();) {
    Vote vote;
    std::size_t end = begin;
    for (; end < walls.size() && walls[end].key == walls[begin].key; ++end) {
      vote.x += walls[end].x;
      vote.n += walls[end].n;
    }
    vote.x /= static_cast<double>(end - begin);
    vote.n /= static_cast<double>(end - begin);
    votes.push_back(vote);
    begin = end;
  }
  return votes;
}

}  // namespace

NormalSideEvidence detail::judgeNormalSide(const OrientedPoints& points,
                                           const Eigen::Vector3d& up) {
  NormalSideEvidence result;
  if (!up.allFinite() || up.isZero()) {
    return result;
  }
  const std::vector<Vote> votes = votesOf(wallPoints(points, up.normalized()));
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
