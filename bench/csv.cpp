// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "bench/suites.h"
#include "bench/summary.h"
#include "bench/tables.h"
#include "io/output_file.h"

namespace storey::bench {
namespace {

constexpr const char* kHeader =
    "building,cloud,method,seed,points,error,error_deviation,error_limit,corner,worst_corner,"
    "corner_limit,iou,polygons,true_polygons,corners,true_corners,hidden_walls,worst_shown_corner,"
    "valid,exact,exact_where_shown,seconds,problem\n";

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string rowOf(const Experiment& experiment, const Outcome& outcome) {
  const Measures& m = outcome.measures;
  char numbers[500];
  std::snprintf(
      numbers, sizeof numbers,
      "%llu,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%zu,%zu,%zu,%zu,%zu,%.9g,%d,%d,%d,%.3f,",
      static_cast<unsigned long long>(experiment.sampling.seed), m.points, m.error,
      m.error_deviation, m.error_limit, m.corner, m.worst_corner, m.corner_limit, m.iou, m.polygons,
      m.true_polygons, m.corners, m.true_corners, m.hidden_walls, m.worst_shown_corner,
      m.valid ? 1 : 0, isExact(outcome) ? 1 : 0, isExactWhereShown(outcome) ? 1 : 0, m.seconds);
  return experiment.building + "," + quoted(experiment.label) + "," +
         methodName(experiment.method) + "," + numbers + quoted(outcome.problem) + "\n";
}

}  // namespace

std::vector<Outcome> perform(const Request& request, const std::vector<Experiment>& experiments) {
  const std::vector<Outcome> outcomes = perform(experiments, request.jobs);
  if (request.csv.empty()) return outcomes;
  io::OutputFile file(request.csv);
  file.write(kHeader);
  for (std::size_t i = 0; i < outcomes.size(); ++i) file.write(rowOf(experiments[i], outcomes[i]));
  file.commit();
  return outcomes;
}

}  // namespace storey::bench
