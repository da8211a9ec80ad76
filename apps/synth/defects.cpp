// SPDX-License-Identifier: BSD-3-Clause
#include "synth/defects.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey::synth {
namespace {

constexpr int kProbes = 20000;  // a share is known to 0.0035 then

bool isShare(double value) { return value >= 0.0 && value <= 1.0; }

/// Position along a side, from left to right for somebody who looks at it from outside.
double alongSide(const Eigen::Vector2d& normal, const Eigen::Vector3d& position) {
  return -normal.y() * position.x() + normal.x() * position.y();
}

}  // namespace

bool areValid(const Defects& d) {
  const bool shares = isShare(d.missing_patches) && d.missing_patches < 1.0 &&
                      isShare(d.missing_walls) && isShare(d.missing_side) &&
                      isShare(d.missing_foot) && isShare(d.heavy_tails) && isShare(d.windows) &&
                      isShare(d.flipped_normals);
  const bool added = d.outliers >= 0.0 && d.outliers <= 10.0 && d.ground >= 0.0 &&
                     d.ground <= 10.0 && d.trees >= 0.0 && d.trees <= 10.0;
  const bool lengths = d.patch_radius > 0.0 && d.window_pitch > 0.0 && d.window_depth >= 0.0 &&
                       d.ground_relief >= 0.0;
  return shares && added && lengths && d.density_falloff >= 1.0 && d.tail_factor >= 1.0 &&
         d.side_half_angle >= 0.0 && d.tree_count >= 1;
}

HiddenSurface::HiddenSurface(const SurfaceSampler& sampler, const Defects& defects,
                             std::uint64_t seed)
    : defects_(defects),
      z_min_(sampler.box().min().z()),
      height_(sampler.box().sizes().z()),
      is_wall_hidden_(static_cast<std::size_t>(sampler.numWalls()), 0) {
  Random wall_choice(seed, 1);
  Random side_choice(seed, 2);
  Random patch_choice(seed, 3);
  chooseWalls(sampler.numWalls(), wall_choice);
  chooseSide(sampler, side_choice);
  choosePatches(sampler, patch_choice);
}

void HiddenSurface::chooseWalls(int num_walls, Random& random) {
  if (defects_.missing_walls == 0.0) {
    return;
  }
  std::vector<std::size_t> order(static_cast<std::size_t>(num_walls));
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  const long wanted = std::lround(defects_.missing_walls * num_walls);
  order.resize(static_cast<std::size_t>(std::max(1L, wanted)));
  for (const std::size_t wall : order) {
    is_wall_hidden_[wall] = 1;
  }
}

void HiddenSurface::chooseSide(const SurfaceSampler& sampler, Random& random) {
  if (defects_.missing_side == 0.0) {
    return;
  }
  SurfaceSample sample = sampler.draw(random);
  while (sample.wall < 0) {
    sample = sampler.draw(random);
  }
  side_normal_ = sample.normal.head<2>();
  double low = INFINITY;
  double high = -INFINITY;
  for (int corner = 0; corner < 4; ++corner) {
    const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
    const double along = alongSide(side_normal_, sampler.box().corner(type));
    low = std::min(low, along);
    high = std::max(high, along);
  }
  side_end_ = low + defects_.missing_side * (high - low);
}

void HiddenSurface::choosePatches(const SurfaceSampler& sampler, Random& random) {
  if (defects_.missing_patches == 0.0) {
    return;
  }
  std::vector<Eigen::Vector3d> probes;
  for (int i = 0; i < kProbes; ++i) {
    probes.push_back(sampler.draw(random).position);
  }
  const double radius_sq = defects_.patch_radius * defects_.patch_radius;
  const auto wanted = static_cast<std::size_t>((1.0 - defects_.missing_patches) * kProbes);
  while (probes.size() > wanted) {
    const Eigen::Vector3d center = sampler.draw(random).position;
    patch_centers_.push_back(center);
    const auto hidden = [&](const Eigen::Vector3d& probe) {
      return (probe - center).squaredNorm() < radius_sq;
    };
    probes.erase(std::remove_if(probes.begin(), probes.end(), hidden), probes.end());
  }
}

bool HiddenSurface::isOnHiddenSide(const SurfaceSample& sample) const {
  return defects_.missing_side > 0.0 && sample.wall >= 0 &&
         sample.normal.head<2>().dot(side_normal_) >= std::cos(defects_.side_half_angle) &&
         alongSide(side_normal_, sample.position) <= side_end_;
}

bool HiddenSurface::hides(const SurfaceSample& sample, Random& random) const {
  const double height = (sample.position.z() - z_min_) / height_;
  const bool too_thin = random.uniform() >= std::pow(defects_.density_falloff, -height);
  const bool wall_missing =
      sample.wall >= 0 && is_wall_hidden_[static_cast<std::size_t>(sample.wall)] != 0;
  if (too_thin || wall_missing || height < defects_.missing_foot || isOnHiddenSide(sample)) {
    return true;
  }
  const double radius_sq = defects_.patch_radius * defects_.patch_radius;
  return std::any_of(patch_centers_.begin(), patch_centers_.end(), [&](const auto& center) {
    return (sample.position - center).squaredNorm() < radius_sq;
  });
}

Eigen::Vector3d recessed(const SurfaceSample& sample, const Defects& defects) {
  if (sample.wall < 0 || defects.windows == 0.0) {
    return sample.position;
  }
  const double half_size = 0.5 * std::sqrt(defects.windows);
  const auto in_window = [&](double at) {
    const double cell = at / defects.window_pitch;
    return std::abs(cell - std::floor(cell) - 0.5) <= half_size;
  };
  if (!in_window(sample.along) || !in_window(sample.position.z())) {
    return sample.position;
  }
  return sample.position - defects.window_depth * sample.normal;
}

}  // namespace storey::synth
