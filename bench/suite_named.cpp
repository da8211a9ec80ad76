// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "bench/markdown.h"
#include "bench/suites.h"
#include "bench/summary.h"
#include "bench/tables.h"
#include "synth/buildings.h"

namespace storey::bench {
namespace {

constexpr const char* kNamedText = R"(## Named buildings

syn1-3 at the paper's numbers of points, %zu draws; the others once. Error: mean distance of the model's vertices to the
nearest true facet, in units in which the noise is 0.1, and its deviation; medians over the draws. Ratio: the error over its
statistical limit. Corners' ratio: the mean distance of the true corners to the model's vertices over its limit.

)";

using reconstruct::Method;

constexpr std::size_t kDraws = 5;

/// [Sui et al. 2016, Sec. 6.1]: mean and standard deviation of its error.
struct Published {
  const char* name;
  double error, deviation;
};
constexpr Published kPublished[] = {
    {"syn1", 0.0181, 0.0240}, {"syn2", 0.0097, 0.0112}, {"syn3", 0.0139, 0.0144}};

const Published* publishedOf(const std::string& name) {
  for (const Published& published : kPublished) {
    if (name == published.name) return &published;
  }
  return nullptr;
}

/// The draws of one building by one method.
struct Group {
  std::string building;
  Method method;
  std::vector<Outcome> outcomes;
};

std::vector<Group> groupsOf(const Request& request, std::vector<Experiment>& experiments) {
  std::vector<Group> groups;
  for (const synth::NamedBuilding& named : synth::namedBuildings()) {
    const synth::Building building = synth::makeBuilding(named.name);
    if (building.layers.empty()) continue;  // random:SEED is no single building
    for (const Method method : {Method::Building, Method::Paper}) {
      if (request.method.value_or(method) != method) continue;
      const std::size_t draws = publishedOf(named.name) ? request.countOr(kDraws) : 1;
      for (std::size_t draw = 0; draw < draws; ++draw) {
        Experiment experiment;
        experiment.building = named.name;
        experiment.label = "draw " + std::to_string(request.seed + draw);
        experiment.method = method;
        experiment.sampling.points = request.pointsOr(building.points);
        experiment.sampling.seed = request.seed + draw;
        experiments.push_back(experiment);
      }
      groups.push_back({named.name, method, std::vector<Outcome>(draws)});
    }
  }
  return groups;
}

/// "28", or "27-28 of 28" if not always right.
std::string polygonsOf(const std::vector<Outcome>& outcomes) {
  std::vector<double> counts;
  std::size_t truth = 0;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.measures.has_model) continue;
    counts.push_back(static_cast<double>(outcome.measures.polygons));
    truth = outcome.measures.true_polygons;
  }
  if (counts.empty()) return "-";
  const std::string least = fixed(quantile(counts, 0.0), 0);
  const std::string most = fixed(quantile(counts, 1.0), 0);
  const std::string range = least == most ? least : least + "-" + most;
  return range == std::to_string(truth) ? range : range + " of " + std::to_string(truth);
}

void addRow(const Group& group, Table& table) {
  const Summary s = summarize(group.outcomes, 0.0);
  const Published* published = publishedOf(group.building);
  table.add({group.building, methodName(group.method), fixed(s.error_median, 4),
             fixed(s.error_deviation_median, 4), published ? fixed(published->error, 4) : "-",
             published ? fixed(published->deviation, 4) : "-",
             fixed(group.outcomes.front().measures.error_limit, 4), fixed(s.ratio_median, 2),
             fixed(s.ratio_max, 2), fixed(s.corner_ratio_median, 2), polygonsOf(group.outcomes),
             ofCount(s.valid, s.count), ofCount(s.exact, s.count), fixed(s.iou_min, 4),
             fixed(s.seconds_median, 1)});
}

}  // namespace

void measureNamed(const Request& request) {
  std::vector<Experiment> experiments;
  std::vector<Group> groups = groupsOf(request, experiments);
  const std::vector<Outcome> outcomes = perform(request, experiments);
  auto next = outcomes.begin();
  for (Group& group : groups) {
    const auto end = next + static_cast<std::ptrdiff_t>(group.outcomes.size());
    group.outcomes.assign(next, end);
    next = end;
  }
  std::printf(kNamedText, request.countOr(kDraws));
  Table table({"building", "method", "error", "deviation", "the paper", "its deviation", "limit",
               "ratio", "max", "corners' ratio", "polygons", "valid", "exact", "IoU min", "CPU s"});
  for (const Group& group : groups) addRow(group, table);
  table.print();
  printNotExact(experiments, outcomes);
}

}  // namespace storey::bench
