// SPDX-License-Identifier: BSD-3-Clause
#include "export/report_page.h"

#include <array>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "export/local_mesh.h"
#include "export/materials.h"
#include "export/page_parts.h"
#include "export/svg.h"
#include "io/failure.h"
#include "io/input_file.h"
#include "io/limits.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kPicturesStart = "<!--pictures-->";
constexpr std::string_view kPicturesEnd = "<!--/pictures-->";

// JSON inside of HTML: a string in it must not end the script element.
std::string withoutTags(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

// In one pass: what is put in may hold braces itself.
std::string fill(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string filled;
  for (std::size_t open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const std::size_t close = text.find("}}", open);
    filled += text.substr(0, open);
    filled += values.at(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return filled.append(text);
}

Json describeFace(const PolyhedralFace& face, const LocalMesh& mesh,
                  const LocalMesh::Face& triangles) {
  Json corners = Json::array();
  double area = 0.0;
  for (const std::array<int, 3>& triangle : triangles.triangles) {
    for (const int corner : triangle) corners.push_back(corner);
    const auto at = [&](std::size_t i) {
      return mesh.vertices[static_cast<std::size_t>(triangle[i])].cast<double>();
    };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  Json rings = Json::array({face.outer});
  for (const std::vector<int>& hole : face.inner) rings.push_back(hole);
  return {{"label", static_cast<int>(face.label)},
          {"material", materialOf(face)},
          {"wall", face.wall},
          {"hypothetical", face.hypothetical},
          {"support", face.support},
          {"coverage", face.coverage},
          {"residual", face.residual},
          {"deviation", std::isfinite(face.deviation) ? Json(face.deviation) : Json(nullptr)},
          {"area", area},
          {"triangles", std::move(corners)},
          {"rings", std::move(rings)}};
}

std::string describeModel(const Exported& exported) {
  const LocalMesh mesh = toLocalMesh(exported);
  const Eigen::Vector3d up = exported.local_to_input.linear().col(2);
  Json model = {{"up", {up.x(), up.y(), up.z()}}};
  for (std::size_t m = 0; m < kNumMaterials; ++m) model["colours"].push_back(materialColour(m));
  for (const Eigen::Vector3f& v : mesh.vertices) {
    for (const float coordinate : v) model["vertices"].push_back(coordinate);
  }
  for (const LocalMesh::Face& face : mesh.faces) {
    model["faces"].push_back(describeFace(exported.model.faces[face.face], mesh, face));
  }
  return model.dump();
}

std::string readAll(const std::string& path) {
  io::InputFile file(path, io::kDefaultMaxFileBytes);
  const std::size_t size = file.size();
  return std::string(reinterpret_cast<const char*>(file.take(size)), size);
}

std::string encodeBase64(std::string bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.cbegin()), Digits(bytes.cend()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

std::string figureOf(const std::string& picture) {
  const std::string name = std::filesystem::path(picture).stem().string();
  return "<figure><img alt=\"" + name + "\" src=\"data:image/png;base64," +
         encodeBase64(readAll(picture)) + "\"><figcaption>" + name + "</figcaption></figure>\n";
}

}  // namespace

void writeReportPage(const std::string& path, const Exported& exported) {
  const std::string page = fill(kPageTemplate, {{"style", kPageStyle},
                                                {"plans", drawFloorplans(exported)},
                                                {"report", withoutTags(exported.report)},
                                                {"model", withoutTags(describeModel(exported))},
                                                {"licence", kThreeLicence},
                                                {"three", kThree},
                                                {"orbit", kOrbitControls},
                                                {"viewer", kPageViewer},
                                                {"tables", kPageTables}});
  io::OutputFile file(path);
  file.write(page);
  file.commit();
}

void addPictures(const std::string& path, const std::vector<std::string>& pictures) {
  std::string page = readAll(path);
  const std::size_t start = page.find(kPicturesStart);
  const std::size_t end = page.find(kPicturesEnd);
  if (start == std::string::npos || end == std::string::npos || end < start) {
    throw io::Failure(io::BadInput, path, "is no report of storey_reconstruct",
                      "run storey_reconstruct again");
  }
  std::string figures = pictures.empty() ? "" : "<h2>Pictures</h2>\n";
  for (const std::string& picture : pictures) figures += figureOf(picture);
  page.replace(start + kPicturesStart.size(), end - start - kPicturesStart.size(), figures);
  io::OutputFile file(path);
  file.write(page);
  file.commit();
}

}  // namespace storey::exports
