// SPDX-License-Identifier: BSD-3-Clause
#include "bench/experiment.h"

#include <storey/surface/extrusion.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <type_traits>
#include <utility>

#include "bench/isolation.h"
#include "bench/shown_truth.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "io/model_io.h"
#include "reconstruct/pipeline.h"
#include "synth/accuracy_limit.h"
#include "synth/buildings.h"
#include "synth/evaluation.h"

namespace storey::bench {
namespace {

using Eigen::Vector3d;

// The surface distance is not reported. Volumes are good to 3e-4 with these columns.
constexpr std::size_t kSurfaceSamples = 1;
constexpr int kColumnsPerSide = 512;

/// The cloud as the reader would give it.
io::LoadedCloud toLoaded(const synth::SyntheticCloud& cloud, bool with_normals) {
  io::RawCloud raw;
  raw.format = "generated";
  raw.declared = cloud.size();
  raw.has_normal_fields = with_normals;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    raw.positions.insert(raw.positions.end(), cloud.positions[i].data(),
                         cloud.positions[i].data() + 3);
    if (!with_normals) continue;
    const Eigen::Vector3f normal = cloud.normals[i].cast<float>();
    raw.normals.insert(raw.normals.end(), normal.data(), normal.data() + 3);
  }
  return io::conditionPoints(std::move(raw));
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The model in the frame of the unposed building.
io::PolygonSoup unposed(const reconstruct::Result& result, const synth::Pose& pose) {
  io::PolygonSoup model = io::toPolygons(result.model.model);
  const Eigen::Matrix3d back = pose.rotation().transpose() / pose.scale;
  for (Vector3d& vertex : model.vertices) {
    vertex = back * (result.local_to_input * vertex - pose.offset);
  }
  return model;
}

void compare(const io::PolygonSoup& model, const ModelCheck& check, const io::PolygonSoup& truth,
             Outcome& outcome) {
  const synth::Evaluation e = synth::evaluateModel(model, truth, kSurfaceSamples, kColumnsPerSide);
  Measures& m = outcome.measures;
  m.error = e.vertex_to_truth.mean;
  m.error_deviation = e.vertex_to_truth.deviation;
  m.corner = e.corner_to_vertex.mean;
  m.worst_corner = e.corner_to_vertex.maximum;
  m.iou = e.overlap.iou();
  m.polygons = e.model.polygons;
  m.corners = e.model.corners;
  // Not the check of the polygons read back: where walls are nearly coplanar, that one judges what
  // merging made of them.
  m.valid = check.ok() && e.model.open_edges == 0;
  if (!check.ok()) outcome.problem = check.problems.front();
}

/// \param sampling whose clouds have points on walls only
ShownTruth shownOf(const PolyhedralModel& truth, const std::vector<FloorplanLayer>& layers,
                   const synth::SyntheticCloud& cloud, const synth::SamplingOptions& sampling) {
  const Eigen::Matrix3d back = sampling.pose.rotation().transpose() / sampling.pose.scale;
  std::vector<Vector3d> positions;
  std::vector<Vector3d> normals;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.sources[i] != synth::PointSource::Building) continue;
    positions.emplace_back(back * (cloud.positions[i] - sampling.pose.offset));
    normals.emplace_back((back * cloud.normals[i]).normalized());
  }
  const double area = synth::SurfaceSampler(layers, sampling.faces).wallArea();
  return findShownTruth(truth, positions, normals, sampling.noise,
                        static_cast<double>(sampling.points) / area);
}

double worstDistance(const std::vector<Vector3d>& corners, const std::vector<Vector3d>& vertices) {
  double worst = 0.0;
  for (const Vector3d& corner : corners) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3d& v : vertices) nearest = std::min(nearest, (v - corner).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// The building as far as it can be known: nothing tells how far down a foot without points goes.
std::vector<FloorplanLayer> knownPart(const std::vector<FloorplanLayer>& layers,
                                      const synth::Defects& defects) {
  const double low = layers.front().z_min;
  const double foot = low + defects.missing_foot * (layers.back().z_max - low);
  std::vector<FloorplanLayer> known;
  for (FloorplanLayer layer : layers) {
    layer.z_min = std::max(layer.z_min, foot);
    if (layer.z_min < layer.z_max) known.push_back(std::move(layer));
  }
  return known;
}

Outcome performHere(const Experiment& experiment) {
  const synth::SamplingOptions& sampling = experiment.sampling;
  const std::vector<FloorplanLayer> layers = synth::makeBuilding(experiment.building).layers;
  const PolyhedralModel truth = extrudeFloorplans(knownPart(layers, sampling.defects));
  const synth::AccuracyLimit limit =
      synth::cramerRaoLimit(layers, sampling.points, sampling.noise, sampling.faces);
  Outcome outcome;
  Measures& m = outcome.measures;
  m.noise = sampling.noise;
  m.true_polygons = truth.faces.size();
  m.true_corners = truth.vertices.size();
  m.error_limit = limit.vertex_to_facet;
  m.corner_limit = limit.corner_displacement;
  const synth::SyntheticCloud points = synth::sampleBuilding(layers, sampling);
  const ShownTruth shown = shownOf(truth, layers, points, sampling);
  m.hidden_walls = shown.hidden_walls;
  io::LoadedCloud cloud = toLoaded(points, experiment.with_normals);
  m.points = cloud.cloud->size();
  reconstruct::Options options;
  options.method = experiment.method;
  options.threads = 1;
  options.steps = experiment.steps;
  const double start = cpuSeconds();
  try {
    const reconstruct::Result result = reconstruct::reconstruct(std::move(cloud), options);
    m.seconds = cpuSeconds() - start;
    const io::PolygonSoup model = unposed(result, sampling.pose);
    outcome.vertices = model.vertices;
    compare(model, result.model.check, io::toPolygons(truth), outcome);
    m.worst_shown_corner = worstDistance(shown.corners, model.vertices);
    m.has_model = true;
    m.grid = result.model.model.grid / sampling.pose.scale;
  } catch (const io::Failure& refusal) {
    m.seconds = cpuSeconds() - start;
    outcome.problem = refusal.what();
  }
  return outcome;
}

/// The bytes of the measures, the vertices, and the problem.
std::string pack(const Outcome& outcome) {
  static_assert(std::is_trivially_copyable_v<Measures>);
  const std::size_t num_vertices = outcome.vertices.size();
  std::string bytes(reinterpret_cast<const char*>(&outcome.measures), sizeof(Measures));
  bytes.append(reinterpret_cast<const char*>(&num_vertices), sizeof num_vertices);
  bytes.append(reinterpret_cast<const char*>(outcome.vertices.data()),
               num_vertices * sizeof(Vector3d));
  return bytes + outcome.problem;
}

Outcome unpack(const std::string& bytes) {
  Outcome outcome;
  std::size_t num_vertices = 0;
  const char* at = bytes.data();
  const auto take = [&](void* target, std::size_t size) {
    std::memcpy(target, at, size);
    at += size;
  };
  take(&outcome.measures, sizeof(Measures));
  take(&num_vertices, sizeof num_vertices);
  outcome.vertices.resize(num_vertices);
  for (Vector3d& vertex : outcome.vertices) take(vertex.data(), sizeof(Vector3d));
  outcome.problem.assign(at, bytes.data() + bytes.size());
  return outcome;
}

Outcome toOutcome(const Report& report) {
  if (report.failure.empty()) return unpack(report.result);
  Outcome outcome;
  outcome.problem = report.failure;
  return outcome;
}

void tell(const Experiment& experiment, const Outcome& outcome) {
  const Measures& m = outcome.measures;
  std::fprintf(stderr, "%-12s %-8s %-28s ", experiment.building.c_str(),
               experiment.method == reconstruct::Method::Paper ? "paper" : "building",
               experiment.label.c_str());
  if (m.has_model) {
    std::fprintf(stderr, "polygons %zu/%zu corners %zu/%zu IoU %.5f error/limit %.2f%s %.1f s\n",
                 m.polygons, m.true_polygons, m.corners, m.true_corners, m.iou,
                 m.error / m.error_limit, m.valid ? "" : " NOT VALID", m.seconds);
  } else {
    std::fprintf(stderr, "%s\n", outcome.problem.c_str());
  }
}

}  // namespace

std::vector<Outcome> perform(const std::vector<Experiment>& experiments, unsigned int jobs) {
  std::vector<Task> tasks;
  for (const Experiment& experiment : experiments) {
    tasks.emplace_back([&experiment] { return pack(performHere(experiment)); });
  }
  const auto finished = [&](std::size_t i, const Report& report) {
    tell(experiments[i], toOutcome(report));
  };
  std::vector<Outcome> outcomes;
  for (const Report& report : runIsolated(tasks, jobs, finished)) {
    outcomes.push_back(toOutcome(report));
  }
  return outcomes;
}

}  // namespace storey::bench
