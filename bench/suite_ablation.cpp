// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/markdown.h"
#include "bench/suites.h"
#include "bench/summary.h"

namespace storey::bench {
namespace {

constexpr const char* kAblationText = R"(## Without one step at a time

The first %zu of the random buildings, clean and with all defects at once, by the default method without one of its steps
(`detail::MethodSteps`). Polygons off: mean difference of the number of polygons from the truth's.

)";

constexpr std::size_t kBuildings = 20;
constexpr double kWantedIou = 0.97;

struct Variant {
  std::string name;
  bool detail::MethodSteps::*step;  // null: nothing is left out
};

std::vector<Variant> variants() {
  using S = detail::MethodSteps;
  return {{"nothing", nullptr},
          {"locked directions", &S::locked_directions},
          {"thin heights", &S::thin_heights},
          {"thin facades", &S::thin_facades},
          {"main tiles", &S::main_tiles},
          {"setbacks", &S::setbacks},
          {"flatness", &S::flatness},
          {"bends", &S::bends},
          {"surface test", &S::surface_test},
          {"short walls", &S::short_walls},
          {"leftovers dropped", &S::leftovers},
          {"hypotheses", &S::hypotheses},
          {"wall ends", &S::wall_ends},
          {"saturated tiles", &S::saturated_tiles},
          {"pruning", &S::pruning},
          {"transitions", &S::transitions},
          {"second pass", &S::second_pass},
          {"panes", &S::panes},
          {"shared directions", &S::shared_directions},
          {"divided walls", &S::divided_walls},
          {"upright", &S::upright},
          {"unseen walls", &S::unseen_walls},
          {"facets dropped", &S::facets}};
}

double polygonsOff(const std::vector<Outcome>& outcomes) {
  double sum = 0.0;
  double models = 0.0;
  for (const Outcome& outcome : outcomes) {
    const Measures& m = outcome.measures;
    if (!m.has_model) continue;
    sum += std::abs(static_cast<double>(m.polygons) - static_cast<double>(m.true_polygons));
    models += 1.0;
  }
  return models > 0.0 ? sum / models : 0.0;
}

void addRow(const std::string& name, const std::string& clouds,
            const std::vector<Outcome>& outcomes, Table& table) {
  const Summary s = summarize(outcomes, kWantedIou);
  table.add({name, clouds, std::to_string(s.valid), std::to_string(s.exact), fixed(s.iou_median, 4),
             fixed(s.iou_min, 4), fixed(s.ratio_median, 2), fixed(polygonsOff(outcomes), 1),
             fixed(s.seconds_median, 1)});
}

}  // namespace

void measureAblation(const Request& request) {
  const std::size_t count = request.countOr(kBuildings);
  std::vector<Experiment> experiments;
  for (const Variant& variant : variants()) {
    for (std::vector<Experiment> group :
         {randomBuildings(request, count), damagedBuildings(request, count)}) {
      for (Experiment& experiment : group) {
        experiment.label = "without " + variant.name;
        if (variant.step != nullptr) experiment.steps.*variant.step = false;
        experiments.push_back(std::move(experiment));
      }
    }
  }
  const std::vector<Outcome> outcomes = perform(request, experiments);
  std::printf(kAblationText, count);
  Table table({"without", "clouds", "valid", "exact", "IoU median", "IoU min", "ratio median",
               "polygons off", "CPU s"});
  auto next = outcomes.begin();
  for (const Variant& variant : variants()) {
    for (const char* clouds : {"clean", "all defects"}) {
      const auto end = next + static_cast<std::ptrdiff_t>(count);
      addRow(variant.name, clouds, {next, end}, table);
      next = end;
    }
  }
  table.print();
}

}  // namespace storey::bench
