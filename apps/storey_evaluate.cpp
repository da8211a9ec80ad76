// SPDX-License-Identifier: BSD-3-Clause
// Measures a model against the true one, or against the cloud it was made from.
#include <storey/features/pca_normals.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/wall_relief.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "io/model_io.h"
#include "synth/cloud_evaluation.h"
#include "synth/evaluation.h"
#include "synth/polygon_mesh.h"

namespace {

namespace io = storey::io;
namespace cli = storey::cli;
namespace synth = storey::synth;
using Json = nlohmann::ordered_json;

struct Request {
  std::string model;
  std::string truth;
  std::string cloud;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  // zero: from the model's roofs
  double sigma = 0.0;
  bool json = false;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line(
      "storey_evaluate",
      {"MODEL TRUTH [--json]", "MODEL --cloud CLOUD [--sigma S] [--up X,Y,Z] [--json]"},
      "Measures a closed model against the true one, or against a cloud.\n"
      "Lengths are in the unit of the files.");
  line.argument("model", r.model, "the model (.ply, .obj)");
  line.argument("truth", r.truth, "the true one");
  line.text("cloud", r.cloud, "cloud (.ply, .pcd) to compare with");
  line.number("sigma", r.sigma, cli::kNonNegative,
              "deviation of the points about their walls, length [0 = estimated, relief included]");
  line.vector("up", r.up, "the vertical [from the model's roofs, else 0,0,1]");
  line.flag("json", r.json, "print JSON");
  if (!line.parse(argc, argv)) return false;
  if (r.model.empty() || r.truth.empty() == r.cloud.empty()) {
    line.fail("a model and either the true model or --cloud are needed");
  }
  if (line.given("up") && r.up.isZero()) line.fail("--up is zero, expected a direction");
  r.up.normalize();  // zero, where it is not given, stays zero
  return true;
}

Json toJson(const synth::DistanceSummary& s) {
  return {{"count", s.count},
          {"mean", s.mean},
          {"deviation", s.deviation},
          {"percentile_95", s.percentile_95},
          {"maximum", s.maximum}};
}

Json toJson(const synth::MeshFacts& facts) {
  return {{"polygons", facts.polygons},
          {"pieces", facts.pieces},
          {"vertices", facts.vertices},
          {"corners", facts.corners},
          {"volume", facts.volume},
          {"open_edges", facts.open_edges},
          {"broken_polygons", facts.broken_polygons}};
}

Json toJson(const synth::Evaluation& e) {
  return {{"vertex_to_truth", toJson(e.vertex_to_truth)},
          {"truth_to_model", toJson(e.truth_to_model)},
          {"corner_to_vertex", toJson(e.corner_to_vertex)},
          {"surface_distance", toJson(e.surface)},
          {"iou", e.overlap.iou()},
          {"open_columns", e.overlap.open_columns},
          {"valid", e.check.ok()},
          {"problems", e.check.problems},
          {"model", toJson(e.model)},
          {"truth", toJson(e.truth)}};
}

Json toJson(const synth::CloudEvaluation& e) {
  return {{"sigma", e.sigma},
          {"cell_size", e.cell_size},
          {"wall_points", e.wall_points},
          {"explained_share", e.explainedShare()},
          {"wall_area", e.wall_area},
          {"supported_share", e.supportedShare()}};
}

void printRow(const char* name, const synth::DistanceSummary& s) {
  std::printf("%-34s %10.6g %10.6g %10.6g %10.6g %8zu\n", name, s.mean, s.deviation,
              s.percentile_95, s.maximum, s.count);
}

void printFacts(const char* name, const synth::MeshFacts& facts) {
  std::printf(
      "%-6s %zu polygons (%zu pieces), %zu vertices, %zu corners, volume %.6g, "
      "%zu open edges%s\n",
      name, facts.polygons, facts.pieces, facts.vertices, facts.corners, facts.volume,
      facts.open_edges, facts.broken_polygons > 0 ? ", BROKEN POLYGONS" : "");
}

void print(const synth::Evaluation& e) {
  std::printf("%-34s %10s %10s %10s %10s %8s\n", "distance", "mean", "deviation", "95 %", "max",
              "count");
  printRow("model vertices to true facets", e.vertex_to_truth);
  printRow("true vertices to model facets", e.truth_to_model);
  printRow("true corners to model vertices", e.corner_to_vertex);
  printRow("surface to surface, both ways", e.surface);
  std::printf("IoU    %.5f%s\n", e.overlap.iou(),
              e.overlap.open_columns > 0 ? " (a mesh is not closed)" : "");
  printFacts("model", e.model);
  printFacts("truth", e.truth);
  std::printf("checks %s\n", e.check.ok() ? "all passed" : "FAILED:");
  for (const std::string& problem : e.check.problems) {
    std::printf("       %s\n", problem.c_str());
  }
}

void print(const synth::CloudEvaluation& e) {
  std::printf("noise %.4g, cells %.4g\n", e.sigma, e.cell_size);
  std::printf("wall points within 3 deviations of the model: %.1f %% of %zu\n",
              100.0 * e.explainedShare(), e.wall_points);
  std::printf("wall area with points: %.1f %% of %.6g\n", 100.0 * e.supportedShare(), e.wall_area);
}

template <typename T>
void report(const T& result, bool json) {
  if (json) {
    std::cout << toJson(result).dump(2) << "\n";
  } else {
    print(result);
  }
}

// Deviation of the points about their walls, relief included, as the reconstruction sees it.
double wallNoise(const pcl::PointCloud<pcl::PointNormal>& cloud, const storey::CloudScale& scale,
                 const Eigen::Vector3d& up) {
  const Eigen::Quaternionf upright =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).cast<float>();
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  for (const pcl::PointNormal& p : cloud) {
    const Eigen::Vector3f normal = upright * p.getNormalVector3fMap();
    if (!(std::abs(normal.z()) < synth::kWallPoint)) continue;
    positions.push_back(upright * p.getVector3fMap());
    normals.push_back(normal);
  }
  return storey::detail::estimateWallNoise(positions, normals, scale.noise, scale.extent);
}

synth::CloudEvaluation againstCloud(const Request& request, io::PolygonSoup model) {
  const io::LoadedCloud loaded = io::readCloud(request.cloud);
  const Eigen::Vector3d up = request.up.isZero() ? synth::upOfModel(model) : request.up;
  if (!loaded.has_normals) {
    storey::estimateNormals(*loaded.cloud);
  }
  const storey::CloudScale scale = storey::estimateCloudScale(*loaded.cloud);
  const double sigma = request.sigma > 0.0 ? request.sigma : wallNoise(*loaded.cloud, scale, up);
  if (!(sigma > 0.0 && scale.density > 0.0)) {
    throw io::Failure(io::BadInput, request.cloud, "noise or density cannot be told from the cloud",
                      "give --sigma, or a cloud with more points");
  }
  for (Eigen::Vector3d& vertex : model.vertices) {
    vertex -= loaded.offset;
  }
  std::vector<synth::OrientedPosition> points;
  for (const pcl::PointNormal& p : *loaded.cloud) {
    points.push_back({p.getVector3fMap().cast<double>(), p.getNormalVector3fMap().cast<double>()});
  }
  return synth::evaluateAgainstCloud(model, points, up, sigma, scale.density);
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) {
    return io::Ok;
  }
  const io::PolygonSoup model = io::readPolygons(request.model);
  if (request.cloud.empty()) {
    report(synth::evaluateModel(model, io::readPolygons(request.truth)), request.json);
  } else {
    report(againstCloud(request, model), request.json);
  }
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::runMain("storey_evaluate", [&] { return run(argc, argv); });
}
