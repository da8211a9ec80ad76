// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "synth/random.h"

namespace storey::synth {
namespace {

/// Where a ray enters a box from outside; infinite if it does not.
double enterBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min() - from).array() / direction.array();
  const Eigen::Array3d b = (box.max() - from).array() / direction.array();
  const double enter = a.min(b).maxCoeff();
  const bool met = enter > 0.0 && enter <= a.max(b).minCoeff();
  return met ? enter : std::numeric_limits<double>::infinity();
}

double enterBall(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& direction) {
  const Eigen::Vector3d to = center - from;
  const double along = to.dot(direction) / direction.squaredNorm();
  const double aside = (to - along * direction).squaredNorm();
  if (!(aside < radius * radius)) return std::numeric_limits<double>::infinity();
  const double enter = along - std::sqrt((radius * radius - aside) / direction.squaredNorm());
  return enter > 0.0 ? enter : std::numeric_limits<double>::infinity();
}

Eigen::AlignedBox3d standing(const Eigen::Vector3d& foot, const Eigen::Vector3d& size) {
  const Eigen::Vector3d half(0.5 * size.x(), 0.5 * size.y(), 0.0);
  return {foot - half, foot + half + Eigen::Vector3d(0.0, 0.0, size.z())};
}

}  // namespace

Occluders::Occluders(const Eigen::AlignedBox3d& box, int count, std::uint64_t seed) {
  Random random(seed);
  const double unit = 0.1 * std::min({box.sizes().x(), box.sizes().y(), box.sizes().z()});
  for (int i = 0; i < count; ++i) {
    // On the box's outline moved outwards by one to two and a half units.
    const bool along_x = random.chance(box.sizes().x() / (box.sizes().x() + box.sizes().y()));
    const int axis = along_x ? 0 : 1;
    const double out = unit * random.uniform(1.0, 2.5);
    Eigen::Vector3d foot = box.min();
    foot[axis] += random.uniform() * box.sizes()[axis];
    foot[1 - axis] += random.chance(0.5) ? -out : box.sizes()[1 - axis] + out;
    if (i % 3 == 0) {
      blocks_.push_back(
          {standing(foot, unit * Eigen::Vector3d(0.12, 0.12, 5.0)), {60.0, 62.0, 66.0}});
    } else if (i % 3 == 1) {
      blocks_.push_back(
          {standing(foot, unit * Eigen::Vector3d(0.2, 0.2, 2.0)), {70.0, 52.0, 40.0}});
      balls_.push_back(
          {foot + unit * Eigen::Vector3d(0.0, 0.0, 2.4), 0.9 * unit, {40.0, 92.0, 38.0}});
    } else {
      const Eigen::Vector3d size =
          along_x ? Eigen::Vector3d(1.8, 0.8, 0.7) : Eigen::Vector3d(0.8, 1.8, 0.7);
      blocks_.push_back({standing(foot, unit * size), {150.0, 30.0, 34.0}});
    }
  }
}

std::optional<Occluders::Hit> Occluders::firstHit(const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& direction) const {
  Hit best = {std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
  for (const Block& block : blocks_) {
    const double distance = enterBox(block.box, from, direction);
    if (distance < best.distance) best = {distance, block.color};
  }
  for (const Ball& ball : balls_) {
    const double distance = enterBall(ball.center, ball.radius, from, direction);
    if (distance < best.distance) best = {distance, ball.color};
  }
  if (best.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
  return best;
}

}  // namespace storey::synth
