// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <limits>

#include "bench/markdown.h"
#include "bench/suites.h"
#include "bench/summary.h"

namespace storey::bench {
namespace {

constexpr const char* kShapesText = R"(## Shapes, scales and places

A cylinder of 64 facets, and other buildings, as made, scaled, and far from the origin. Moved: how far a vertex is from the
model of the cloud as made, in steps of the model's grid.

)";

constexpr std::size_t kPoints = 200000;
constexpr std::size_t kRandomBuildings = 2;

/// Where the same cloud is put. The first is where it was made.
struct Place {
  const char* name;
  double scale, offset;
};
constexpr Place kPlaces[] = {{"as made", 1.0, 0.0},
                             {"x 0.001", 1e-3, 0.0},
                             {"x 1000", 1e3, 0.0},
                             {"offset 1e5", 1.0, 1e5},
                             {"offset 1e7", 1.0, 1e7}};
constexpr std::size_t kNumPlaces = std::size(kPlaces);

/// Largest distance of a vertex of one model to the nearest of the other; infinite if there is one.
double largestMove(const Outcome& from, const Outcome& to) {
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : from.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& other : to.vertices) {
      nearest = std::min(nearest, (vertex - other).norm());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

std::vector<Experiment> placed(const Request& request, const std::string& building) {
  std::vector<Experiment> experiments;
  for (const Place& place : kPlaces) {
    Experiment experiment;
    experiment.building = building;
    experiment.label = place.name;
    experiment.method = request.method.value_or(reconstruct::Method::Building);
    experiment.sampling.points = request.pointsOr(kPoints);
    experiment.sampling.seed = request.seed;
    experiment.sampling.pose.scale = place.scale;
    experiment.sampling.pose.offset = place.offset * Eigen::Vector3d(1.0, -1.0, 0.001);
    experiments.push_back(experiment);
  }
  return experiments;
}

void addRow(const Experiment& experiment, const Outcome& outcome, const Outcome& as_made,
            Table& table) {
  const Measures& m = outcome.measures;
  if (!m.has_model || !as_made.measures.has_model) {
    table.add(
        {experiment.building, experiment.label, "-", "-", "-", "-", "-", "-", outcome.problem});
    return;
  }
  const double move = std::max(largestMove(outcome, as_made), largestMove(as_made, outcome));
  table.add({experiment.building, experiment.label, ofCount(m.polygons, m.true_polygons),
             ofCount(m.corners, m.true_corners), fixed(m.iou, 4), fixed(errorRatio(outcome), 2),
             m.valid ? "yes" : "no", fixed(move / as_made.measures.grid, 1), outcome.problem});
}

}  // namespace

void measureShapes(const Request& request) {
  std::vector<std::string> buildings = {"cylinder", "two_towers"};
  for (std::size_t i = 0; i < request.countOr(kRandomBuildings); ++i) {
    buildings.push_back("random:" + std::to_string(request.seed + i));
  }
  std::vector<Experiment> experiments;
  for (const std::string& building : buildings) {
    const std::vector<Experiment> places = placed(request, building);
    experiments.insert(experiments.end(), places.begin(), places.end());
  }
  const std::vector<Outcome> outcomes = perform(request, experiments);
  std::printf(kShapesText);
  Table table({"building", "cloud", "polygons", "corners", "IoU", "ratio", "valid", "moved",
               "what is wrong"});
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    addRow(experiments[i], outcomes[i], outcomes[i - i % kNumPlaces], table);
  }
  table.print();
}

}  // namespace storey::bench
