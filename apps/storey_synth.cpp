// SPDX-License-Identifier: BSD-3-Clause
// Makes a building whose true model is known, and a point cloud of it.
#include <storey/surface/extrusion.h>

#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "io/failure.h"
#include "io/model_io.h"
#include "synth/accuracy_limit.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/photos/photo_files.h"
#include "synth/sampling.h"

namespace {

namespace io = storey::io;
namespace options = boost::program_options;
namespace synth = storey::synth;

constexpr double kDegree = M_PI / 180.0;

/// What the user asked for, as typed.
struct Request {
  std::string name;
  std::string output;
  std::vector<std::string> truths;
  std::string faces = "walls";
  std::string offset = "0,0,0";
  std::size_t points = 0;
  double normal_noise_degrees = 15.0;
  double yaw_degrees = 0.0;
  double tilt_degrees = 0.0;
  double side_half_angle_degrees = 35.0;
  bool no_normals = false;
  bool double_positions = false;
  synth::SamplingOptions sampling;
  std::string photos;
  synth::PhotoOptions photo;
};

[[noreturn]] void failUsage(const std::string& reason) {
  throw io::Failure(io::Usage, "", reason, "see storey_synth --help");
}

template <typename T>
options::typed_value<T>* into(T& value) {
  std::ostringstream text;  // 0.1, where the library would print 0.10000000000000001
  text << value;
  return options::value<T>(&value)->default_value(value, text.str());
}

options::options_description mainOptions(Request& r) {
  options::options_description text("Cloud (lengths in the building's units, before --scale)");
  text.add_options()("output,o", options::value(&r.output), "cloud to write, binary PLY")(
      "truth", options::value(&r.truths)->composing(),
      "true model to write, .ply or .obj, in the cloud's coordinates; may be repeated")(
      "points", options::value(&r.points),
      "points drawn on the building, before anything is missing [200000, syn1-3 the paper's]")(
      "noise", into(r.sampling.noise), "standard deviation of each coordinate")(
      "normal-noise", into(r.normal_noise_degrees), "standard deviation of the normals, degrees")(
      "faces", into(r.faces), "what is sampled: walls, roofs (and walls), all")(
      "seed", into(r.sampling.seed), "of all random choices but the building's")(
      "no-normals", options::bool_switch(&r.no_normals), "leave the normals out")(
      "double", options::bool_switch(&r.double_positions),
      "write double coordinates; done anyway where float is too coarse");
  return text;
}

options::options_description poseOptions(Request& r) {
  options::options_description text("Pose");
  text.add_options()("yaw", into(r.yaw_degrees), "turn about the vertical, degrees")(
      "tilt", into(r.tilt_degrees), "away from the vertical, degrees")(
      "scale", into(r.sampling.pose.scale), "factor on all lengths, noise included")(
      "offset", into(r.offset), "X,Y,Z added last");
  return text;
}

options::options_description defectOptions(Request& r) {
  synth::Defects& d = r.sampling.defects;
  options::options_description text("Defects (shares are between 0 and 1)");
  text.add_options()("patches", into(d.missing_patches), "share hidden by balls")(
      "patch-radius", into(d.patch_radius), "radius of these balls")(
      "missing-walls", into(d.missing_walls), "share of the walls without points, at least one")(
      "missing-side", into(d.missing_side), "share of one side, from its left end, without points")(
      "side-angle", into(r.side_half_angle_degrees),
      "walls whose normals are this near belong to that side, degrees")(
      "missing-foot", into(d.missing_foot), "share of the height without points, from below")(
      "falloff", into(d.density_falloff), "density at the foot / at the top, >= 1")(
      "heavy-tails", into(d.heavy_tails), "share of points with more noise")(
      "tail-factor", into(d.tail_factor), "how much more")(
      "windows", into(d.windows), "share of the wall area that is recessed")(
      "window-depth", into(d.window_depth), "of the recess")("window-pitch", into(d.window_pitch),
                                                             "from window to window")(
      "flipped", into(d.flipped_normals), "share of normals that point inwards")(
      "outliers", into(d.outliers), "uniform outliers, as a share of --points")(
      "ground", into(d.ground), "points of the ground, as a share of --points")(
      "relief", into(d.ground_relief), "amplitude of the ground's waves")(
      "trees", into(d.trees), "points of trees, as a share of --points")(
      "tree-count", into(d.tree_count), "number of trees");
  return text;
}

options::options_description photoOptions(Request& r) {
  options::options_description text("Photos (lengths in the building's units, before --scale)");
  text.add_options()("photos", options::value(&r.photos),
                     "folder for photos, their cameras and the true facades")(
      "views", into(r.photo.views), "number of photos")(
      "photo-width", into(r.photo.width), "pixels; the height is three quarters of it")(
      "photo-pitch", into(r.photo.window_pitch), "from one window to the next in the photos")(
      "recess", into(r.photo.recess), "depth of these windows; 0: they are painted")(
      "occluders", into(r.photo.occluders), "number of poles, trees and cars")(
      "exposure", into(r.photo.exposure), "photos are up to this share too dark or too bright")(
      "pixel-noise", into(r.photo.pixel_noise), "standard deviation, grey levels");
  return text;
}

Eigen::Vector3d parseOffset(const std::string& text) {
  Eigen::Vector3d offset;
  int end = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &offset[0], &offset[1], &offset[2], &end);
  if (read != 3 || static_cast<std::size_t>(end) != text.size() || !offset.allFinite()) {
    failUsage("--offset is '" + text + "', expected three numbers X,Y,Z");
  }
  return offset;
}

synth::SampledFaces parseFaces(const std::string& text) {
  if (text == "walls") return synth::SampledFaces::Walls;
  if (text == "roofs") return synth::SampledFaces::WallsAndRoofs;
  if (text == "all") return synth::SampledFaces::All;
  failUsage("--faces is '" + text + "', expected walls, roofs or all");
}

void printList() {
  for (const synth::NamedBuilding& building : synth::namedBuildings()) {
    std::printf("%-12s %s\n", building.name.c_str(), building.description.c_str());
  }
}

/// The request, or nothing if --help or --list was all.
bool parse(int argc, char** argv, Request& r) {
  options::options_description visible(
      "storey_synth NAME -o CLOUD.ply [--truth MODEL.ply] [options]\n"
      "A point cloud of a building whose true model is known");
  visible.add(mainOptions(r)).add(poseOptions(r)).add(defectOptions(r)).add(photoOptions(r));
  visible.add_options()("help,h", "this text")("list", "the names of buildings");
  options::options_description all;
  all.add(visible).add_options()("name", options::value(&r.name));
  options::positional_options_description positional;
  positional.add("name", 1);
  options::variables_map given;
  try {
    options::store(
        options::command_line_parser(argc, argv).options(all).positional(positional).run(), given);
    options::notify(given);
  } catch (const options::error& error) {
    failUsage(error.what());
  }
  if (given.count("help") > 0) {
    std::cout << visible;
    return false;
  }
  if (given.count("list") > 0) {
    printList();
    return false;
  }
  if (r.name.empty() || r.output.empty()) {
    failUsage("a building and an output (-o) are needed");
  }
  return true;
}

void completeSampling(const synth::Building& building, Request& r) {
  synth::SamplingOptions& sampling = r.sampling;
  sampling.points = r.points > 0 ? r.points : building.points;
  sampling.normal_noise = r.normal_noise_degrees * kDegree;
  sampling.faces = parseFaces(r.faces);
  sampling.defects.side_half_angle = r.side_half_angle_degrees * kDegree;
  sampling.pose.yaw = r.yaw_degrees * kDegree;
  sampling.pose.tilt = r.tilt_degrees * kDegree;
  sampling.pose.offset = parseOffset(r.offset);
  r.photo.seed = sampling.seed;
  constexpr int kMaxViews = 10000;
  constexpr int kMaxWidth = 20000;
  const synth::PhotoOptions& photo = r.photo;
  if (photo.views < 1 || photo.views > kMaxViews || photo.width < 16 || photo.width > kMaxWidth ||
      !(photo.window_pitch > 0.0) || !(photo.recess >= 0.0) || photo.occluders < 0 ||
      !(photo.exposure >= 0.0) || !(photo.pixel_noise >= 0.0)) {
    failUsage("an option of the photos is out of its range");
  }
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
  if (!parse(argc, argv, request)) {
    return io::Ok;
  }
  const synth::Building building = synth::makeBuilding(request.name);
  if (building.layers.empty()) {
    failUsage("there is no building '" + request.name + "'; --list prints the names");
  }
  completeSampling(building, request);
  const synth::SamplingOptions& sampling = request.sampling;
  const synth::SyntheticCloud cloud = synth::sampleBuilding(building.layers, sampling);
  if (cloud.size() == 0) {
    failUsage("an option is out of its range, or no point is left");
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
  return io::runMain("storey_synth", [&] { return run(argc, argv); });
}
