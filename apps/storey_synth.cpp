// SPDX-License-Identifier: BSD-3-Clause
// Makes a building whose true model is known, and a point cloud of it.
#include <storey/surface/extrusion.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "io/failure.h"
#include "io/limits.h"
#include "io/model_io.h"
#include "synth/accuracy_limit.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/photos/photo_files.h"
#include "synth/sampling.h"

namespace {

namespace cli = storey::cli;
namespace io = storey::io;
namespace synth = storey::synth;

constexpr double kDegree = M_PI / 180.0;
constexpr std::uint64_t kBytesPerPoint = 125;  // of memory; 105 measured

/// What the user asked for, as typed.
struct Request {
  std::string name;
  std::string output;
  std::vector<std::string> truths;
  std::size_t points = 0;
  double normal_noise_degrees = 15.0;
  double yaw_degrees = 0.0;
  double tilt_degrees = 0.0;
  double side_half_angle_degrees = 35.0;
  bool no_normals = false;
  bool double_positions = false;
  bool list = false;
  synth::SamplingOptions sampling;
  std::string photos;
  synth::PhotoOptions photo;
};

void declareCloud(cli::CommandLine& line, Request& r) {
  using synth::SampledFaces;
  line.group("cloud (lengths in the building's units, before --scale)");
  line.text("output,o", r.output, "cloud to write, binary PLY");
  line.texts("truth", r.truths,
             "true model to write, .ply or .obj, in the cloud's coordinates; may be repeated");
  line.whole("points", r.points, std::size_t{0},
             "points drawn on the building, before anything is missing [0 = 200000, syn1-3 the "
             "paper's]");
  line.number("noise", r.sampling.noise, cli::kNonNegative,
              "standard deviation of each coordinate, length");
  line.number("normal-noise", r.normal_noise_degrees, cli::kNonNegative,
              "standard deviation of the normals, degrees");
  line.choice<SampledFaces>("faces", r.sampling.faces,
                            {{"walls", SampledFaces::Walls},
                             {"roofs", SampledFaces::WallsAndRoofs},
                             {"all", SampledFaces::All}},
                            "what is sampled: walls, roofs (and walls), all");
  line.whole("seed", r.sampling.seed, decltype(r.sampling.seed){0},
             "of all random choices but the building's");
  line.flag("no-normals", r.no_normals, "leave the normals out");
  line.flag("double", r.double_positions,
            "write double coordinates; done anyway where float is too coarse");
}

void declarePose(cli::CommandLine& line, Request& r) {
  line.group("pose");
  line.number("yaw", r.yaw_degrees, cli::kAnyNumber, "turn about the vertical, degrees");
  line.number("tilt", r.tilt_degrees, cli::kAnyNumber, "away from the vertical, degrees");
  line.number("scale", r.sampling.pose.scale, cli::kPositive,
              "factor on all lengths, noise included");
  line.vector("offset", r.sampling.pose.offset, "added last [0,0,0]");
}

void declareDefects(cli::CommandLine& line, Request& r) {
  synth::Defects& d = r.sampling.defects;
  line.group("defects (shares are between 0 and 1)");
  const auto share = [&line](const char* name, double& value, const char* text) {
    line.number(name, value, cli::kShare, text);
  };
  const auto size = [&line](const char* name, double& value, const char* text) {
    line.number(name, value, cli::kNonNegative, text);
  };
  share("patches", d.missing_patches, "share hidden by balls");
  size("patch-radius", d.patch_radius, "radius of these balls, length");
  share("missing-walls", d.missing_walls, "share of the walls without points, at least one");
  share("missing-side", d.missing_side, "share of one side, from its left end, without points");
  size("side-angle", r.side_half_angle_degrees,
       "walls whose normals are this near belong to that side, degrees");
  share("missing-foot", d.missing_foot, "share of the height without points, from below");
  line.number("falloff", d.density_falloff, {1.0}, "density at the foot / at the top");
  share("heavy-tails", d.heavy_tails, "share of points with more noise");
  size("tail-factor", d.tail_factor, "how much more");
  share("windows", d.windows, "share of the wall area that is recessed");
  size("window-depth", d.window_depth, "of the recess, length");
  size("window-pitch", d.window_pitch, "from window to window, length");
  share("flipped", d.flipped_normals, "share of normals that point inwards");
  size("outliers", d.outliers, "uniform outliers, as a share of --points");
  size("ground", d.ground, "points of the ground, as a share of --points");
  size("relief", d.ground_relief, "amplitude of the ground's waves, length");
  size("trees", d.trees, "points of trees, as a share of --points");
  line.whole("tree-count", d.tree_count, decltype(d.tree_count){0}, "number of trees");
}

void declarePhotos(cli::CommandLine& line, Request& r) {
  synth::PhotoOptions& photo = r.photo;
  line.group("photos (lengths in the building's units, before --scale)");
  line.text("photos", r.photos, "folder for photos, their cameras and the true facades");
  line.whole("views", photo.views, 1, "number of photos");
  line.whole("photo-width", photo.width, 16, "pixels; the height is three quarters of it");
  line.number("photo-pitch", photo.window_pitch, cli::kPositive,
              "from one window to the next in the photos, length");
  line.number("recess", photo.recess, cli::kNonNegative,
              "depth of these windows, length; 0: they are painted");
  line.whole("occluders", photo.occluders, 0, "number of poles, trees and cars");
  line.number("exposure", photo.exposure, cli::kNonNegative,
              "photos are up to this share too dark or too bright");
  line.number("pixel-noise", photo.pixel_noise, cli::kNonNegative,
              "standard deviation, grey levels");
}

void printList() {
  for (const synth::NamedBuilding& building : synth::namedBuildings()) {
    std::printf("%-12s %s\n", building.name.c_str(), building.description.c_str());
  }
}

/// The building and what to make of it, or nothing if --help or --list was all.
std::optional<synth::Building> parse(int argc, char** argv, Request& r) {
  cli::CommandLine line("storey_synth", {"NAME -o CLOUD.ply [--truth MODEL.ply] [options]"},
                        "A point cloud of a building whose true model is known.");
  line.argument("name", r.name, "the building, see --list");
  line.flag("list", r.list, "print the names of buildings and exit");
  declareCloud(line, r);
  declarePose(line, r);
  declareDefects(line, r);
  declarePhotos(line, r);
  if (!line.parse(argc, argv)) return std::nullopt;
  if (r.list) {
    printList();
    return std::nullopt;
  }
  constexpr int kMaxViews = 10000;
  constexpr int kMaxWidth = 20000;
  if (r.photo.views > kMaxViews) line.fail("--views is more than " + std::to_string(kMaxViews));
  if (r.photo.width > kMaxWidth)
    line.fail("--photo-width is more than " + std::to_string(kMaxWidth));
  if (r.name.empty() || r.output.empty()) line.fail("a building and an output (-o) are needed");
  if (std::filesystem::path(r.output).extension() != ".ply")
    line.fail("-o " + r.output + ": the cloud is written as PLY, expected a name with .ply");
  if (r.points > io::availableMemory() / kBytesPerPoint)
    line.fail("--points " + std::to_string(r.points) + " do not fit into memory");
  synth::Building building = synth::makeBuilding(r.name);
  if (building.layers.empty()) {
    line.fail("there is no building '" + r.name + "'; --list prints the names");
  }
  return building;
}

void completeSampling(const synth::Building& building, Request& r) {
  synth::SamplingOptions& sampling = r.sampling;
  sampling.points = r.points > 0 ? r.points : building.points;
  sampling.normal_noise = r.normal_noise_degrees * kDegree;
  sampling.defects.side_half_angle = r.side_half_angle_degrees * kDegree;
  sampling.pose.yaw = r.yaw_degrees * kDegree;
  sampling.pose.tilt = r.tilt_degrees * kDegree;
  r.photo.seed = sampling.seed;
}

void writeTruth(const std::string& path, io::PolygonSoup soup, const synth::Pose& pose) {
  for (Eigen::Vector3d& vertex : soup.vertices) {
    vertex = pose.apply(vertex);
  }
  const bool is_obj = path.size() > 4 && path.compare(path.size() - 4, 4, ".obj") == 0;
  if (is_obj) {
    io::writePolygonsObj(path, soup, Eigen::Isometry3d::Identity());
  } else {
    io::writePolygonsPly(path, soup, Eigen::Isometry3d::Identity());
  }
}

int run(int argc, char** argv) {
  Request request;
  const std::optional<synth::Building> made = parse(argc, argv, request);
  if (!made) return io::Ok;
  const synth::Building& building = *made;
  completeSampling(building, request);
  const synth::SamplingOptions& sampling = request.sampling;
  const synth::SyntheticCloud cloud = synth::sampleBuilding(building.layers, sampling);
  if (cloud.size() == 0) {
    throw io::Failure(io::Usage, "", "an option is out of its range, or no point is left",
                      "see storey_synth --help");
  }
  synth::writeCloudPly(request.output, cloud, request.double_positions || needsDouble(cloud),
                       !request.no_normals);
  const storey::PolyhedralModel model = storey::extrudeFloorplans(building.layers);
  for (const std::string& path : request.truths) {
    writeTruth(path, io::toPolygons(model), sampling.pose);
  }
  if (!request.photos.empty()) {
    synth::writePhotos(request.photos, model, request.photo, sampling.pose);
  }
  const synth::AccuracyLimit limit =
      synth::cramerRaoLimit(building.layers, sampling.points, sampling.noise, sampling.faces);
  std::printf("%s: %zu points, %zu floorplan types, %zu directions, %zu polygons, %zu corners\n",
              building.name.c_str(), cloud.size(), building.layers.size(),
              synth::countDirections(building.layers), model.faces.size(), model.vertices.size());
  std::printf("statistical limit of the mean vertex error without defects: %.3g\n",
              sampling.pose.scale * limit.vertex_to_facet);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::runMain("storey_synth", [&] { return run(argc, argv); });
}
