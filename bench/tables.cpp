// SPDX-License-Identifier: BSD-3-Clause
#include "bench/tables.h"

#include <cstdio>

#include "bench/markdown.h"

namespace storey::bench {

std::string methodName(reconstruct::Method method) {
  return method == reconstruct::Method::Paper ? "paper" : "building";
}

namespace {

std::string foundOf(std::size_t found, std::size_t truth) {
  return found == truth ? std::to_string(found)
                        : std::to_string(found) + " of " + std::to_string(truth);
}

void print(const std::string& title, const std::vector<Experiment>& experiments,
           const std::vector<Outcome>& outcomes, bool (*isWanted)(const Outcome&)) {
  Table table({title, "cloud", "method", "points", "polygons", "corners", "worst corner / noise",
               "IoU", "ratio", "what is wrong"});
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    const Measures& m = outcome.measures;
    if (!isWanted(outcome)) continue;
    std::vector<std::string> row = {experiments[i].building, experiments[i].label,
                                    methodName(experiments[i].method), std::to_string(m.points)};
    if (m.has_model) {
      row.insert(row.end(),
                 {foundOf(m.polygons, m.true_polygons), foundOf(m.corners, m.true_corners),
                  fixed(m.worst_corner / m.noise, 1), fixed(m.iou, 4),
                  fixed(errorRatio(outcome), 2), m.valid ? "" : "not valid: " + outcome.problem});
    } else {
      row.insert(row.end(), {"-", "-", "-", "-", "-", outcome.problem});
    }
    table.add(row);
  }
  if (!table.empty()) table.print();
}

}  // namespace

void printNotExact(const std::vector<Experiment>& experiments,
                   const std::vector<Outcome>& outcomes) {
  print("not exact", experiments, outcomes,
        [](const Outcome& outcome) { return !isExact(outcome) || !outcome.measures.valid; });
}

void printNotValid(const std::vector<Experiment>& experiments,
                   const std::vector<Outcome>& outcomes) {
  print("not valid", experiments, outcomes,
        [](const Outcome& outcome) { return !outcome.measures.valid; });
}

}  // namespace storey::bench
