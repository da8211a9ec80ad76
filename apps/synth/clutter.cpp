// SPDX-License-Identifier: BSD-3-Clause
#include "synth/clutter.h"

#include <algorithm>
#include <cmath>

namespace storey::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d drawDirection(Random& random) {
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(0.0, 2.0 * M_PI);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::AlignedBox2d footprintBox(const SurfaceSampler& sampler) {
  return {sampler.box().min().head<2>(), sampler.box().max().head<2>()};
}

double distanceToRing(const FloorplanRing& ring, const Vector2d& point) {
  double least = INFINITY;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& from = ring.vertices[i];
    const Vector2d along = ring.vertices[(i + 1) % ring.size()] - from;
    const double t = std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - from - t * along).norm());
  }
  return least;
}

/// Whether a disc keeps off the floorplans of all layers.
bool isClear(const SurfaceSampler& sampler, const Vector2d& center, double radius) {
  const auto& layers = sampler.layers();
  return std::none_of(layers.begin(), layers.end(), [&](const FloorplanLayer& layer) {
    const auto& parts = layer.plan.components;
    return contains(layer.plan, center) ||
           std::any_of(parts.begin(), parts.end(), [&](const FloorplanComponent& part) {
             return distanceToRing(part.outer, center) < radius;
           });
  });
}

}  // namespace

ClutterPoint drawOutlier(const SurfaceSampler& sampler, Random& random) {
  constexpr double kMargin = 0.1;  // of the box, on each side
  const double x = random.uniform(-kMargin, 1.0 + kMargin);
  const double y = random.uniform(-kMargin, 1.0 + kMargin);
  const double z = random.uniform(-kMargin, 1.0 + kMargin);
  const Vector3d at = Vector3d(x, y, z).cwiseProduct(sampler.box().sizes());
  return {sampler.box().min() + at, drawDirection(random)};
}

GroundAround::GroundAround(const SurfaceSampler& sampler, double relief)
    : sampler_(sampler), relief_(relief), area_(footprintBox(sampler)) {
  const Vector2d margin = Vector2d::Constant(0.5 * area_.sizes().maxCoeff());
  area_ = Eigen::AlignedBox2d(area_.min() - margin, area_.max() + margin);
}

double GroundAround::heightAt(const Vector2d& at) const {
  const Vector2d waves = 2.0 * M_PI * (at - area_.min()).cwiseQuotient(area_.sizes());
  return sampler_.box().min().z() +
         relief_ * (0.6 * std::sin(waves.x() + 0.7) + 0.4 * std::cos(1.7 * waves.y() + waves.x()));
}

ClutterPoint GroundAround::draw(Random& random) const {
  Vector2d at;
  do {
    const double u = random.uniform();
    const double v = random.uniform();
    at = area_.min() + Vector2d(u, v).cwiseProduct(area_.sizes());
  } while (contains(sampler_.layers().front().plan, at));
  const double step = 1e-3 * area_.sizes().maxCoeff();
  const double height = heightAt(at);
  const double slope_x = (heightAt(at + Vector2d(step, 0.0)) - height) / step;
  const double slope_y = (heightAt(at + Vector2d(0.0, step)) - height) / step;
  return {{at.x(), at.y(), height}, Vector3d(-slope_x, -slope_y, 1.0).normalized()};
}

TreesAround::TreesAround(const SurfaceSampler& sampler, const GroundAround& ground, int count,
                         Random& random) {
  constexpr int kTries = 1000;
  const Eigen::AlignedBox2d box = footprintBox(sampler);
  const double width = box.sizes().maxCoeff();
  const double height = sampler.box().sizes().z();
  for (int tries = 0; static_cast<int>(trees_.size()) < count && tries < kTries; ++tries) {
    const double u = random.uniform(-0.3, 1.3);
    const double v = random.uniform(-0.3, 1.3);
    const Vector2d at = box.min() + Vector2d(u, v).cwiseProduct(box.sizes());
    const double radius = width * random.uniform(0.05, 0.11);
    const double crown = std::min(height * random.uniform(0.15, 0.4), 4.0 * radius) + radius;
    if (isClear(sampler, at, radius)) {
      trees_.push_back({{at.x(), at.y(), ground.heightAt(at)}, radius, crown});
    }
  }
  if (trees_.empty()) {  // no room beside it within the margin: one well away
    const Vector2d at = box.max() + Vector2d::Constant(0.3 * width);
    trees_.push_back({{at.x(), at.y(), ground.heightAt(at)}, 0.08 * width, 0.2 * width});
  }
}

ClutterPoint TreesAround::draw(Random& random) const {
  constexpr double kTrunkShare = 0.08;
  constexpr double kSurfaceShare = 0.7;
  const Tree& tree =
      trees_[static_cast<std::size_t>(random.below(static_cast<int>(trees_.size())))];
  const bool on_trunk = random.chance(kTrunkShare);
  const bool on_surface = random.chance(kSurfaceShare);
  const double depth = random.uniform();
  const Vector3d direction = drawDirection(random);
  if (on_trunk) {
    const Vector3d normal = Vector3d(direction.x(), direction.y(), 0.0).normalized();
    const Vector3d up(0.0, 0.0, tree.height * depth);
    return {tree.foot + 0.1 * tree.crown_radius * normal + up, normal};
  }
  const double radius = tree.crown_radius * (on_surface ? 1.0 - 0.15 * depth : std::cbrt(depth));
  // Leaves face anywhere: the normal of the ball, blurred beyond recognition.
  const Vector3d normal = (direction + 1.5 * drawDirection(random)).normalized();
  return {tree.foot + Vector3d(0.0, 0.0, tree.height) + radius * direction, normal};
}

}  // namespace storey::synth
