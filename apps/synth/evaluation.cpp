// SPDX-License-Identifier: BSD-3-Clause
#include "synth/evaluation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "synth/polygon_mesh.h"
#include "synth/rebuilt_model.h"
#include "synth/triangle_tree.h"

namespace storey::synth {
namespace {

using Eigen::Vector3d;

Vector3d centerOf(const io::PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : soup.vertices) {
    box.extend(vertex);
  }
  return box.isEmpty() ? Vector3d(Vector3d::Zero()) : box.center();
}

io::PolygonSoup movedBy(io::PolygonSoup soup, const Vector3d& shift) {
  for (Vector3d& vertex : soup.vertices) {
    vertex += shift;
  }
  return soup;
}

double signedVolume(const TriangleMesh& mesh) {
  double six_times = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    six_times += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2)));
  }
  return six_times / 6.0;
}

std::size_t countOpenEdges(const io::PolygonSoup& soup) {
  std::map<std::pair<int, int>, std::pair<int, int>> runs;  // forwards, backwards
  for (const io::PolygonSoup::Polygon& polygon : soup.polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const int from = polygon.corners[i];
      const int to = polygon.corners[(i + 1) % polygon.corners.size()];
      (from < to ? runs[{from, to}].first : runs[{to, from}].second) += 1;
    }
  }
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const auto& run) {
    return run.second != std::make_pair(1, 1);
  }));
}

MeshFacts factsOf(const io::PolygonSoup& soup, const PolygonMesh& mesh) {
  MeshFacts facts;
  facts.polygons = mesh.num_polygons;
  facts.pieces = soup.polygons.size();
  facts.vertices = mesh.vertices.size();
  facts.corners = mesh.corners.size();
  facts.volume = signedVolume(mesh.triangles);
  facts.open_edges = countOpenEdges(soup);
  facts.broken_polygons = mesh.num_broken;
  return facts;
}

/// Distance of each point to the nearest target. Models have few vertices: no tree.
std::vector<double> distancesToPoints(const std::vector<Vector3d>& points,
                                      const std::vector<Vector3d>& targets) {
  std::vector<double> distances;
  for (const Vector3d& point : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& target : targets) {
      least = std::min(least, (point - target).norm());
    }
    distances.push_back(least);
  }
  return distances;
}

}  // namespace

DistanceSummary summarize(std::vector<double> distances) {
  DistanceSummary summary;
  summary.count = distances.size();
  if (distances.empty()) {
    return summary;
  }
  std::sort(distances.begin(), distances.end());
  const auto count = static_cast<double>(distances.size());
  for (const double distance : distances) {
    summary.mean += distance / count;
  }
  double variance = 0.0;
  for (const double distance : distances) {
    variance += (distance - summary.mean) * (distance - summary.mean) / count;
  }
  summary.deviation = std::sqrt(variance);
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * count)) - 1;
  summary.percentile_95 = distances[rank];
  summary.maximum = distances.back();
  return summary;
}

Evaluation evaluateModel(const io::PolygonSoup& model, const io::PolygonSoup& truth,
                         std::size_t surface_samples, int columns_per_side) {
  const Vector3d center = centerOf(truth);
  const io::PolygonSoup near_model = movedBy(model, -center);
  const io::PolygonSoup near_truth = movedBy(truth, -center);
  const PolygonMesh model_mesh = measurable(near_model);
  const PolygonMesh truth_mesh = measurable(near_truth);
  const TriangleTree model_tree(model_mesh.triangles);
  const TriangleTree truth_tree(truth_mesh.triangles);

  Evaluation evaluation;
  evaluation.model = factsOf(near_model, model_mesh);
  evaluation.truth = factsOf(near_truth, truth_mesh);
  evaluation.check = checkModel(rebuildModel(near_model, model_mesh, upOfModel(near_model)));
  evaluation.vertex_to_truth = summarize(truth_tree.distances(model_mesh.vertices));
  evaluation.truth_to_model = summarize(model_tree.distances(truth_mesh.vertices));
  evaluation.corner_to_vertex =
      summarize(distancesToPoints(truth_mesh.corners, model_mesh.vertices));
  std::vector<double> both_ways =
      truth_tree.distances(spreadOverSurface(model_mesh.triangles, surface_samples));
  const std::vector<double> back =
      model_tree.distances(spreadOverSurface(truth_mesh.triangles, surface_samples));
  both_ways.insert(both_ways.end(), back.begin(), back.end());
  evaluation.surface = summarize(std::move(both_ways));
  evaluation.overlap =
      overlapOfSolids(model_mesh.triangles, truth_mesh.triangles, columns_per_side);
  return evaluation;
}

}  // namespace storey::synth
