// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "bench/markdown.h"
#include "bench/suites.h"
#include "bench/summary.h"
#include "bench/tables.h"
#include "io/failure.h"

namespace storey::bench {
namespace {

constexpr const char* kDefectsText = R"(## One defect at a time

Each level on %zu buildings, random:%llu and those that follow, %zu points. A refusal has IoU 0. Ratios are to the limit of
the clean cloud with the same noise and points. Shares are of the surface (patches), the planes (walls), the height (foot),
the walls' area (windows, 0.2 deep) or the points; there are twice as many points of ground as of trees; a falloff of 9 is 1/9
of the density at the top. Where the foot has no points, the truth begins above it.

)";

constexpr double kDegree = M_PI / 180.0;
constexpr std::size_t kBuildings = 5;
constexpr std::size_t kPoints = 200000;
constexpr double kUsableIou = 0.95;

/// Something that is wrong with clouds, at rising levels.
struct Defect {
  std::string name;
  std::string unit;
  std::vector<double> levels;
  std::function<void(Experiment&, double)> damage;
};

Defect share(const std::string& name, std::vector<double> percent, double synth::Defects::*member) {
  return {name, " %", std::move(percent),
          [member](Experiment& e, double level) { e.sampling.defects.*member = level / 100.0; }};
}

std::vector<Defect> whatIsMissing() {
  using D = synth::Defects;
  return {share("missing side", {50, 100}, &D::missing_side),
          share("missing patches", {10, 20, 30, 50}, &D::missing_patches),
          share("missing walls", {5, 10, 20}, &D::missing_walls),
          share("missing foot", {5, 10, 20}, &D::missing_foot),
          {"density falloff",
           "",
           {3, 9, 27},
           [](Experiment& e, double level) { e.sampling.defects.density_falloff = level; }},
          {"points", "", {100000, 50000, 20000, 10000, 5000}, [](Experiment& e, double level) {
             e.sampling.points = static_cast<std::size_t>(level);
           }}};
}

std::vector<Defect> whatIsTooMuch() {
  using D = synth::Defects;
  return {share("outliers", {5, 10, 20, 40, 60}, &D::outliers),
          {"trees and ground",
           " %",
           {5, 10, 20},
           [](Experiment& e, double level) {
             e.sampling.defects.trees = level / 100.0;
             e.sampling.defects.ground = 2.0 * level / 100.0;
           }},
          share("windows", {10, 20, 30}, &D::windows)};
}

std::vector<Defect> whatIsNoisy() {
  using D = synth::Defects;
  return {share("heavy tails", {5, 10, 20}, &D::heavy_tails),
          {"noise", " x", {2, 4}, [](Experiment& e, double level) { e.sampling.noise *= level; }},
          {"noise of normals",
           " deg",
           {25, 35},
           [](Experiment& e, double level) { e.sampling.normal_noise = level * kDegree; }},
          share("flipped normals", {5, 10, 20, 30, 40}, &D::flipped_normals),
          {"no normals", " %", {100}, [](Experiment& e, double) { e.with_normals = false; }},
          {"tilt", " deg", {1, 2, 5, 10}, [](Experiment& e, double level) {
             e.sampling.pose.tilt = level * kDegree;
           }}};
}

std::vector<Defect> defectsOf(const Request& request) {
  std::vector<Defect> defects = {{"none", "", {0}, [](Experiment&, double) {}}};
  for (const auto& group : {whatIsMissing(), whatIsTooMuch(), whatIsNoisy()}) {
    defects.insert(defects.end(), group.begin(), group.end());
  }
  if (request.defect.empty()) return defects;
  std::string names;
  for (const Defect& defect : defects) {
    if (defect.name == request.defect) return {defect};
    names += (names.empty() ? "" : ", ") + defect.name;
  }
  throw io::Failure(io::Usage, "", "there is no defect '" + request.defect + "'",
                    "one of " + names);
}

std::string labelOf(const Defect& defect, double level) {
  return defect.name == "none" ? "none" : defect.name + " " + fixed(level, 0) + defect.unit;
}

std::vector<Experiment> experimentsOf(const Request& request, const std::vector<Defect>& defects,
                                      std::size_t buildings) {
  std::vector<Experiment> experiments;
  for (const Defect& defect : defects) {
    for (const double level : defect.levels) {
      for (std::size_t i = 0; i < buildings; ++i) {
        Experiment experiment;
        experiment.building = "random:" + std::to_string(request.seed + i);
        experiment.label = labelOf(defect, level);
        experiment.method = request.method.value_or(reconstruct::Method::Building);
        experiment.sampling.points = request.pointsOr(kPoints);
        experiment.sampling.seed = request.seed + i;
        defect.damage(experiment, level);
        experiments.push_back(experiment);
      }
    }
  }
  return experiments;
}

/// \param next the outcomes of the defect's first level; moved on behind its last
void addRows(const Defect& defect, std::size_t buildings,
             std::vector<Outcome>::const_iterator& next, Table& levels, Table& limits) {
  std::string usable = "-";
  std::string unusable = "-";
  for (const double level : defect.levels) {
    const auto end = next + static_cast<std::ptrdiff_t>(buildings);
    const Summary s = summarize({next, end}, kUsableIou);
    next = end;
    levels.add({labelOf(defect, level), std::to_string(s.models), std::to_string(s.valid),
                std::to_string(s.exact), fixed(s.iou_median, 4), fixed(s.iou_min, 4),
                s.models > 0 ? fixed(s.ratio_median, 2) : "-", fixed(s.seconds_median, 1)});
    if (unusable != "-") continue;
    (s.iou_median < kUsableIou ? unusable : usable) = fixed(level, 0) + defect.unit;
  }
  if (defect.name != "none") limits.add({defect.name, usable, unusable});
}

}  // namespace

void measureDefects(const Request& request) {
  const std::size_t buildings = request.countOr(kBuildings);
  const std::vector<Defect> defects = defectsOf(request);
  const std::vector<Experiment> experiments = experimentsOf(request, defects, buildings);
  const std::vector<Outcome> outcomes = perform(request, experiments);
  std::printf(kDefectsText, buildings, static_cast<unsigned long long>(request.seed),
              request.pointsOr(kPoints));
  Table levels(
      {"defect", "models", "valid", "exact", "IoU median", "IoU min", "ratio median", "CPU s"});
  Table limits({"defect", "median IoU at least 0.95 up to", "below from"});
  auto next = outcomes.begin();
  for (const Defect& defect : defects) addRows(defect, buildings, next, levels, limits);
  levels.print();
  if (!limits.empty()) limits.print();
  printNotValid(experiments, outcomes);
}

}  // namespace storey::bench
