// SPDX-License-Identifier: BSD-3-Clause
#include "export/report_page.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "export/local_mesh.h"
#include "export/materials.h"
#include "export/page_parts.h"
#include "export/page_text.h"
#include "export/svg.h"

namespace storey::exports {
namespace {

using Json = nlohmann::ordered_json;

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

std::string figureOf(const std::string& picture) {
  const std::string name = std::filesystem::path(picture).stem().string();
  return "<figure><img alt=\"" + name + "\" src=\"data:image/png;base64," +
         encodeBase64(readBytes(picture)) + "\"><figcaption>" + name + "</figcaption></figure>\n";
}

}  // namespace

void writeReportPage(const std::string& path, const Exported& exported) {
  const Page page(fillPage(kPageTemplate, {{"style", kPageStyle},
                                           {"plans", drawFloorplans(exported)},
                                           {"report", withoutTags(exported.report)},
                                           {"model", withoutTags(describeModel(exported))},
                                           {"licence", kThreeLicence},
                                           {"three", kThree},
                                           {"orbit", kOrbitControls},
                                           {"turntable", kPageTurntable},
                                           {"viewer", kPageViewer},
                                           {"tables", kPageTables}}));
  page.write(path);
}

void addPictures(const std::string& path, const std::vector<std::string>& pictures) {
  Page page = Page::read(path);
  std::string figures = pictures.empty() ? "" : "<h2>Pictures</h2>\n";
  for (const std::string& picture : pictures) figures += figureOf(picture);
  page.replacePart(path, "pictures", figures);
  page.write(path);
}

}  // namespace storey::exports
