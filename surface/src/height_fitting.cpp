// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/filters/detail/threads.h>
#include <storey/surface/detail/level_fitting.h>

#include <algorithm>

namespace storey {
namespace {

constexpr double kMinLayer = 3.0;  // noise deviations

// One level for two that a layer thinner than the noise lies between.
HeightFit merged(const HeightFit& lower, const HeightFit& upper, double z) {
  HeightFit both = lower.deviation > upper.deviation ? lower : upper;
  both.z = z;
  return both;
}

// Puts the layers between their levels; those that shrink below the noise go.
std::vector<HeightFit> applyLevels(std::vector<FloorplanLayer>& layers,
                                   std::vector<HeightFit> levels, double min_height) {
  std::vector<FloorplanLayer> kept;
  std::vector<HeightFit> kept_levels;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    HeightFit& low = levels[k];
    HeightFit& high = levels[k + 1];
    if (high.z - low.z < min_height) {
      const bool at_end = kept.empty() || k + 1 == layers.size();
      high = merged(low, high, at_end ? low.z : 0.5 * (low.z + high.z));
      if (!kept.empty()) kept.back().z_max = high.z;
      continue;
    }
    layers[k].z_min = low.z;
    layers[k].z_max = high.z;
    kept.push_back(layers[k]);
    kept_levels.push_back(low);
  }
  if (kept.empty()) return {};
  kept_levels.push_back(levels.back());
  layers = std::move(kept);
  return kept_levels;
}

std::vector<HeightFit> fitLevels(const std::vector<detail::LevelFitting>& fittings, double tails,
                                 unsigned int threads) {
  std::vector<HeightFit> levels(fittings.size());
#pragma omp parallel for num_threads(detail::threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(levels.size()); ++i) {
    const auto k = static_cast<std::size_t>(i);
    levels[k] = fittings[k].fit(tails);
  }
  return levels;
}

}  // namespace

std::vector<HeightFit> fitHeights(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                  const FitOptions& options) {
  if (!(options.noise > 0.0) || !(options.max_shift > 0.0)) {
    PCL_ERROR("[storey::fitHeights] noise is %g and max_shift %g, expected > 0.\n", options.noise,
              options.max_shift);
    return {};
  }
  if (layers.empty()) return {};
  return detail::fitHeights(layers, detail::collectLevelEvidence(layers, points, options), options);
}

std::vector<HeightFit> detail::fitHeights(std::vector<FloorplanLayer>& layers,
                                          const std::vector<LevelEvidence>& evidence,
                                          const FitOptions& options) {
  std::vector<LevelFitting> fittings;
  for (const LevelEvidence& level : evidence) {
    fittings.emplace_back(level, options.noise, options.max_shift, options.threads);
  }
  std::vector<HeightFit> levels = fitLevels(fittings, 0.0, options.threads);
  const double tails = tailsOf(evidence, levels, options.noise);
  if (tails > 0.0) levels = fitLevels(fittings, tails, options.threads);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    levels[k].z = std::max(levels[k].z, levels[k - 1].z);
  }
  return applyLevels(layers, std::move(levels), kMinLayer * options.noise);
}

}  // namespace storey
