// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "bench/markdown.h"
#include "bench/suites.h"
#include "bench/summary.h"
#include "bench/tables.h"
#include "synth/random.h"

namespace storey::bench {
namespace {

constexpr const char* kRandomText = R"(## Random buildings

Clean clouds of random:%llu and those that follow, 200,000-400,000 points each unless told otherwise. Exact: as many polygons
and corners as the truth, and every true corner within 5 deviations of the noise (0.5) of a vertex of the model. Ratios are to
the statistical limit.

)";
constexpr const char* kCombinedText = R"(## All defects at once

The same buildings with 3 %% outliers, 5 %% trees, 8 %% ground, 15 %% of the surface hidden in patches, 5 %% of the walls without
points, density falling to 1/9 at the top, windows recessed by 2 deviations of the noise over 20 %% of the area, 5 %% heavy
tails, 2 %% flipped normals, 1.5 degrees of tilt. Ratios are to the limit of the clean cloud. Exact where shown: but for what
no point shows. Every true corner at which two walls with points meet is within 5 deviations of a vertex, no polygons and
corners are too many, and no more are missing than walls without points can have hidden, two polygons and four corners each.

)";

constexpr std::size_t kCleanBuildings = 100;
constexpr std::size_t kDamagedBuildings = 50;
constexpr double kCleanIou = 0.998;
constexpr double kDamagedIou = 0.97;
constexpr double kFewestPoints = 200000.0;
constexpr double kMostPoints = 400000.0;

void damage(synth::SamplingOptions& sampling) {
  synth::Defects& d = sampling.defects;
  d.outliers = 0.03;
  d.trees = 0.05;
  d.ground = 0.08;
  d.missing_patches = 0.15;
  d.missing_walls = 0.05;
  d.density_falloff = 9.0;
  d.windows = 0.2;
  d.window_depth = 2.0 * sampling.noise;
  d.heavy_tails = 0.05;
  d.flipped_normals = 0.02;
  sampling.pose.tilt = 1.5 * M_PI / 180.0;
}

void measure(const Request& request, const std::vector<Experiment>& experiments,
             double wanted_iou) {
  const std::vector<Outcome> outcomes = perform(request, experiments);
  const Summary s = summarize(outcomes, wanted_iou);
  Table table({"buildings", "valid", "exact", "exact where shown", "IoU >= " + fixed(wanted_iou, 3),
               "IoU min", "ratio median", "90 %", "max", "corners' ratio", "CPU s"});
  table.add({std::to_string(s.count), std::to_string(s.valid), std::to_string(s.exact),
             std::to_string(s.exact_where_shown), std::to_string(s.overlapping),
             fixed(s.iou_min, 4), fixed(s.ratio_median, 2), fixed(s.ratio_90, 2),
             fixed(s.ratio_max, 2), fixed(s.corner_ratio_median, 2), fixed(s.seconds_median, 1)});
  table.print();
  printNotExact(experiments, outcomes);
}

}  // namespace

std::vector<Experiment> randomBuildings(const Request& request, std::size_t count) {
  std::vector<Experiment> experiments;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t seed = request.seed + i;
    Experiment experiment;
    experiment.building = "random:" + std::to_string(seed);
    experiment.method = request.method.value_or(reconstruct::Method::Building);
    const double points = synth::Random(seed).uniform(kFewestPoints, kMostPoints);
    experiment.sampling.points = request.pointsOr(static_cast<std::size_t>(points));
    experiment.sampling.seed = seed;
    experiments.push_back(experiment);
  }
  return experiments;
}

std::vector<Experiment> damagedBuildings(const Request& request, std::size_t count) {
  std::vector<Experiment> experiments = randomBuildings(request, count);
  for (Experiment& experiment : experiments) damage(experiment.sampling);
  return experiments;
}

void measureRandom(const Request& request) {
  const std::vector<Experiment> experiments =
      randomBuildings(request, request.countOr(kCleanBuildings));
  std::printf(kRandomText, static_cast<unsigned long long>(request.seed));
  measure(request, experiments, kCleanIou);
}

void measureCombined(const Request& request) {
  const std::vector<Experiment> experiments =
      damagedBuildings(request, request.countOr(kDamagedBuildings));
  std::printf(kCombinedText);
  measure(request, experiments, kDamagedIou);
}

}  // namespace storey::bench
