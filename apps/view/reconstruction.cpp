// SPDX-License-Identifier: BSD-3-Clause
#include "view/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/failure.h"
#include "io/label_names.h"
#include "io/limits.h"
#include "io/model_io.h"
#include "view/json_file.h"

namespace storey::view {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxSlices = 1000000;  // as many colours are made for the picture of slices

Eigen::Vector3d toVector(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

// The paper's method knows the types of slices, the other one those of blocks.
std::vector<int> layerTypes(const Json& json) {
  if (!json.contains("layers")) return {};
  const Json& layers = json.at("layers");
  std::vector<int> types = layers.value("slice_types", std::vector<int>{});
  return types.empty() ? layers.value("block_types", std::vector<int>{}) : types;
}

Report toReport(const Json& json) {
  Report report;
  const std::string input = json.at("input").at("file").get<std::string>();
  report.input = std::filesystem::path(input).filename().string();
  report.inside = json.at("space").at("side").get<std::string>() == "inside";
  report.planar_threshold = json.at("planar").at("T_k").get<double>();
  for (const Json& direction : json.at("directions")) {
    report.azimuths.push_back(direction.at("azimuth_deg").get<double>());
  }
  report.slice_thickness = json.at("slices").at("thickness").get<double>();
  report.num_slices = json.at("slices").at("count").get<std::size_t>();
  report.layer_types = layerTypes(json);
  report.grid = json.at("model").at("grid").get<double>();
  report.offset = toVector(json.at("input").at("offset"));
  return report;
}

// Takes the local frame to the input's: floorplans.geojson has it where the cloud was turned
// upright; else the report has the offset.
Eigen::Isometry3d localToInput(const std::string& floorplans, const Eigen::Vector3d& offset) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  readJson(floorplans, [&](const Json& json) {
    const Json& rows = json.at("frame_to_input");
    for (int row = 0; row < 3; ++row) {
      const Json& numbers = rows.at(static_cast<std::size_t>(row));
      transform.linear().row(row) = toVector(numbers);
      transform.translation()[row] = numbers.at(3).get<double>();
    }
  });
  if (transform.linear().isIdentity(0.0)) transform.translation() = offset;
  return transform;
}

WindowPart windowPart(std::uint8_t label) {
  if (label == io::kWindowLabel) return WindowPart::Pane;
  return label == io::kRevealLabel ? WindowPart::Reveal : WindowPart::None;
}

// Of a part of a window, which way it faces: files do not tell.
FaceLabel facing(const io::PolygonSoup& soup, const io::PolygonSoup::Polygon& polygon) {
  const auto at = [&](std::size_t i) {
    return soup.vertices[static_cast<std::size_t>(polygon.corners[i])];
  };
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i) {
    normal += (at(i) - at(0)).cross(at(i + 1) - at(0));
  }
  constexpr double kLevel = 0.5;  // of the normal: walls and level faces are far from it
  normal.normalize();
  if (std::abs(normal.z()) < kLevel) return FaceLabel::Wall;
  return normal.z() > 0.0 ? FaceLabel::Roof : FaceLabel::Ceiling;
}

PolyhedralModel toModel(const io::PolygonSoup& soup, double grid) {
  PolyhedralModel model;
  model.grid = grid;
  model.vertices = soup.vertices;
  for (const io::PolygonSoup::Polygon& polygon : soup.polygons) {
    PolyhedralFace face;
    face.outer = polygon.corners;
    face.window = windowPart(polygon.label);
    face.label = face.window == WindowPart::None ? static_cast<FaceLabel>(polygon.label)
                                                 : facing(soup, polygon);
    face.wall = polygon.wall;
    face.shell = polygon.shell;
    face.hypothetical = polygon.hypothetical;
    const bool measured = !soup.deviations.empty();
    face.coverage = measured ? polygon.coverage : 1.0;
    if (measured) face.deviation = polygon.deviation;
    model.faces.push_back(std::move(face));
    model.num_shells = std::max(model.num_shells, polygon.shell + 1);
  }
  return model;
}

}  // namespace

Reconstruction::Reconstruction(const std::string& directory) : directory_(directory) {
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error)) {
    throw io::Failure(io::MissingInput, directory, "is not a directory",
                      "give the output directory of storey_reconstruct");
  }
  if (!has("report.json")) {
    throw io::Failure(io::MissingInput, directory, "has no report.json",
                      "give the output directory of storey_reconstruct");
  }
  readJson(file("report.json"), [&](const Json& json) { report_ = toReport(json); });
  if (report_.num_slices > kMaxSlices) {
    throw io::Failure(io::BadInput, file("report.json"),
                      "counts " + std::to_string(report_.num_slices) + " slices",
                      "run storey_reconstruct again");
  }
}

bool Reconstruction::has(const std::string& name) const {
  std::error_code error;
  return std::filesystem::exists(file(name), error);
}

StageCloud Reconstruction::readLabels(const std::string& name, std::size_t num_labels,
                                      const std::string& field) const {
  StageCloud cloud = readStageCloud(file(name), field);
  const double limit =
      static_cast<double>(num_labels > 0 ? num_labels : std::size_t{io::kMaxPoints});
  const auto bad = [&](double label) { return !(label >= 0.0 && label <= limit); };
  if (std::any_of(cloud.values.begin(), cloud.values.end(), bad)) {
    throw io::Failure(io::BadInput, file(name), "has labels that report.json does not know",
                      "run storey_reconstruct again");
  }
  return cloud;
}

Eigen::Isometry3d Reconstruction::inputToLocal() const {
  return localToInput(file("floorplans.geojson"), report_.offset).inverse();
}

PolyhedralModel Reconstruction::readModel(const std::string& name) const {
  io::PolygonSoup soup = io::readPolygons(file(name));
  const Eigen::Isometry3d to_local = inputToLocal();
  for (Eigen::Vector3d& vertex : soup.vertices) vertex = to_local * vertex;
  return toModel(soup, report_.grid);
}

}  // namespace storey::view
