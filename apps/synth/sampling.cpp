// SPDX-License-Identifier: BSD-3-Clause
#include "synth/sampling.h"

#include <cmath>
#include <numeric>

#include "synth/clutter.h"
#include "synth/random.h"

namespace storey::synth {
namespace {

using Eigen::Vector3d;

/// Streams of random numbers, by purpose; `HiddenSurface` has 1 to 3.
enum Stream : std::uint64_t {
  kPositions = 10,
  kVisibility,
  kNoise,
  kTails,
  kFlips,
  kOutliers,
  kGround,
  kTrees,
  kOrder
};

Vector3d drawNoise(Random& random, double deviation) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return deviation * Vector3d(x, y, z);
}

/// Turns the normal by N(0, deviation) about a random axis at right angles to it.
Vector3d disturbed(const Vector3d& normal, Random& random, double deviation) {
  const double azimuth = random.uniform(0.0, 2.0 * M_PI);
  const double angle = deviation * random.normal();
  const Vector3d first = normal.unitOrthogonal();
  const Vector3d aside = std::cos(azimuth) * first + std::sin(azimuth) * normal.cross(first);
  return (std::cos(angle) * normal + std::sin(angle) * aside).normalized();
}

class CloudMaker {
 public:
  CloudMaker(const std::vector<FloorplanLayer>& layers, const SamplingOptions& options)
      : options_(options),
        rotation_(options.pose.rotation()),
        sampler_(layers, options.faces),
        noise_(options.seed, kNoise) {}

  SyntheticCloud make() {
    addBuilding();
    addClutter();
    shuffle();
    return cloud_;
  }

 private:
  void add(const Vector3d& position, const Vector3d& normal, PointSource source) {
    cloud_.positions.push_back(options_.pose.offset + options_.pose.scale * (rotation_ * position));
    cloud_.normals.push_back(rotation_ * normal);
    cloud_.sources.push_back(source);
  }

  void addBuilding() {
    const Defects& defects = options_.defects;
    const HiddenSurface hidden(sampler_, defects, options_.seed);
    Random positions(options_.seed, kPositions);
    Random visibility(options_.seed, kVisibility);
    Random tails(options_.seed, kTails);
    Random flips(options_.seed, kFlips);
    for (std::size_t i = 0; i < options_.points; ++i) {
      const SurfaceSample sample = sampler_.draw(positions);
      const double factor = tails.chance(defects.heavy_tails) ? defects.tail_factor : 1.0;
      const Vector3d moved = recessed(sample, defects) + drawNoise(noise_, factor * options_.noise);
      const Vector3d normal = disturbed(sample.normal, noise_, options_.normal_noise);
      const bool flipped = flips.chance(defects.flipped_normals);
      if (!hidden.hides(sample, visibility)) {
        add(moved, flipped ? Vector3d(-normal) : normal, PointSource::Building);
      }
    }
  }

  std::size_t shareOfPoints(double share) const {
    return static_cast<std::size_t>(std::llround(share * static_cast<double>(options_.points)));
  }

  void addClutter() {
    const Defects& defects = options_.defects;
    Random outliers(options_.seed, kOutliers);
    for (std::size_t i = 0; i < shareOfPoints(defects.outliers); ++i) {
      const ClutterPoint point = drawOutlier(sampler_, outliers);
      add(point.position, point.normal, PointSource::Outlier);
    }
    const GroundAround ground(sampler_, defects.ground_relief);
    Random ground_draws(options_.seed, kGround);
    for (std::size_t i = 0; i < shareOfPoints(defects.ground); ++i) {
      const ClutterPoint point = ground.draw(ground_draws);
      add(point.position + drawNoise(ground_draws, options_.noise),
          disturbed(point.normal, ground_draws, options_.normal_noise), PointSource::Ground);
    }
    Random tree_draws(options_.seed, kTrees);
    const TreesAround trees(sampler_, ground, defects.tree_count, tree_draws);
    for (std::size_t i = 0; i < shareOfPoints(defects.trees); ++i) {
      const ClutterPoint point = trees.draw(tree_draws);
      add(point.position + drawNoise(tree_draws, options_.noise), point.normal, PointSource::Tree);
    }
  }

  /// Otherwise all clutter would stand at the end, a hint that no real cloud gives.
  void shuffle() {
    std::vector<std::size_t> order(cloud_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random(options_.seed, kOrder).shuffle(order);
    SyntheticCloud shuffled;
    for (const std::size_t i : order) {
      shuffled.positions.push_back(cloud_.positions[i]);
      shuffled.normals.push_back(cloud_.normals[i]);
      shuffled.sources.push_back(cloud_.sources[i]);
    }
    cloud_ = shuffled;
  }

  const SamplingOptions& options_;
  Eigen::Matrix3d rotation_;
  SurfaceSampler sampler_;
  Random noise_;
  SyntheticCloud cloud_;
};

}  // namespace

Eigen::Matrix3d Pose::rotation() const {
  const Vector3d axis(std::cos(tilt_azimuth), std::sin(tilt_azimuth), 0.0);
  return (Eigen::AngleAxisd(tilt, axis) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()))
      .toRotationMatrix();
}

Vector3d Pose::apply(const Vector3d& point) const { return offset + scale * (rotation() * point); }

SyntheticCloud sampleBuilding(const std::vector<FloorplanLayer>& layers,
                              const SamplingOptions& options) {
  const bool valid = !layers.empty() && options.noise >= 0.0 && options.normal_noise >= 0.0 &&
                     options.pose.scale > 0.0 && areValid(options.defects);
  return valid ? CloudMaker(layers, options).make() : SyntheticCloud();
}

}  // namespace storey::synth
