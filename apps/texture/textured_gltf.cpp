// SPDX-License-Identifier: BSD-3-Clause
#include "texture/textured_gltf.h"

#include <Eigen/Geometry>
#include <cmath>

#include "io/images/image_files.h"

namespace storey::texture {
namespace {

using exports::GlbFile;
using exports::yUp;

/// The corners of what one sheet is drawn on, three a triangle.
struct Corners {
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> coordinates;
  std::vector<float> facades;
};

void append(std::vector<float>& values, const Eigen::VectorXd& vector) {
  for (const double number : vector) values.push_back(static_cast<float>(number));
}

/// The middle, rounded so that it has few digits.
Eigen::Vector3d originOf(const io::PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : soup.vertices) box.extend(vertex);
  constexpr int kSteps = 10;  // binary digits of the extent
  const double step = std::exp2(std::ceil(std::log2(box.sizes().maxCoeff())) - kSteps);
  return (box.center() / step).array().round() * step;
}

class Builder {
 public:
  Builder(const io::PolygonSoup& soup, const ModelFacades& model,
          const std::vector<FacadeTexture>& textures, const TextureSheets& sheets)
      : soup_(soup),
        model_(model),
        textures_(textures),
        sheets_(sheets),
        origin_(originOf(soup)),
        file_("building", origin_),
        corners_(sheets.sheets.size() + 1) {}

  GlbFile build(const Eigen::Vector3d& vertical) {
    GlbFile::Json& json = file_.json();
    json["extensionsUsed"] = {"KHR_materials_unlit"};
    if (!soup_.crs.empty()) json["asset"]["extras"] = {{"crs", soup_.crs}};
    const Eigen::Vector3d up = yUp(vertical);
    json["nodes"][0]["mesh"] = 0;
    json["nodes"][0]["extras"] = {{"up", {up.x(), up.y(), up.z()}}};
    for (std::size_t t = 0; t < model_.triangles.size(); ++t) addTriangle(t);
    GlbFile::Json primitives = GlbFile::Json::array();
    for (std::size_t s = 0; s < corners_.size(); ++s) {
      if (!corners_[s].facades.empty()) primitives.push_back(primitive(s));
    }
    json["meshes"] = GlbFile::Json::array({{{"name", "building"}, {"primitives", primitives}}});
    return std::move(file_);
  }

 private:
  /// On the sheet, from the upper left corner to the lower right one.
  Eigen::Vector2d onSheet(std::size_t facade, const Eigen::Vector3d& point) const {
    const SheetPlace& place = sheets_.places[facade];
    const RgbImage& image = textures_[facade].image;
    const RgbImage& sheet = sheets_.sheets[static_cast<std::size_t>(place.sheet)];
    const Eigen::Vector2d at = textures_[facade].coordinates(point);
    return {(place.left + at.x() * image.width / place.shrink) / sheet.width,
            (place.top + (1.0 - at.y()) * image.height / place.shrink) / sheet.height};
  }

  void addTriangle(std::size_t triangle) {
    const std::size_t facade = model_.facade_of_triangle[triangle];
    const int sheet = sheets_.places[facade].sheet;
    const std::size_t slot = sheet >= 0 ? static_cast<std::size_t>(sheet) : corners_.size() - 1;
    std::array<Eigen::Vector3d, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      points[i] = soup_.vertices[static_cast<std::size_t>(model_.triangles[triangle][i])];
    }
    const Eigen::Vector3d& normal = model_.facades[facade].normal;
    const double turn = (points[1] - points[0]).cross(points[2] - points[0]).dot(normal);
    if (turn < 0.0) std::swap(points[1], points[2]);
    Corners& corners = corners_[slot];
    for (const Eigen::Vector3d& point : points) {
      append(corners.positions, yUp(Eigen::Vector3d(point - origin_)));
      append(corners.normals, yUp(normal));
      if (sheet >= 0) append(corners.coordinates, onSheet(facade, point));
      corners.facades.push_back(static_cast<float>(facade));
    }
  }

  GlbFile::Json primitive(std::size_t slot) {
    const Corners& corners = corners_[slot];
    GlbFile::Json attributes = {{"POSITION", file_.addAccessor(corners.positions, 3, "VEC3")},
                                {"NORMAL", file_.addAccessor(corners.normals, 3, "VEC3")}};
    if (!corners.coordinates.empty()) {
      attributes["TEXCOORD_0"] = file_.addAccessor(corners.coordinates, 2, "VEC2");
    }
    attributes["_FACE"] = file_.addAccessor(corners.facades, 1, "SCALAR");
    GlbFile::Json made = material(slot);
    GlbFile::Json& materials = file_.json()["materials"];
    materials.push_back(std::move(made));
    return {{"attributes", std::move(attributes)}, {"material", materials.size() - 1}};
  }

  GlbFile::Json material(std::size_t slot) {
    GlbFile::Json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", 0.9}};
    if (slot == sheets_.sheets.size()) {
      surface["baseColorFactor"] = {0.4, 0.4, 0.4, 1.0};  // linear: grey level 168
      return {{"name", "unseen"}, {"pbrMetallicRoughness", std::move(surface)}};
    }
    const std::size_t texture = file_.addTexture(io::encodeJpeg(sheets_.sheets[slot]));
    surface["baseColorTexture"] = {{"index", texture}};
    return {{"name", "photos_" + std::to_string(slot)},
            {"pbrMetallicRoughness", std::move(surface)},
            {"extensions", {{"KHR_materials_unlit", GlbFile::Json::object()}}}};
  }

  const io::PolygonSoup& soup_;
  const ModelFacades& model_;
  const std::vector<FacadeTexture>& textures_;
  const TextureSheets& sheets_;
  Eigen::Vector3d origin_;
  GlbFile file_;
  std::vector<Corners> corners_;  // of each sheet, and last of what no photo sees
};

}  // namespace

exports::GlbFile toTexturedGlb(const io::PolygonSoup& soup, const ModelFacades& model,
                               const std::vector<FacadeTexture>& textures,
                               const TextureSheets& sheets, const Eigen::Vector3d& vertical) {
  return Builder(soup, model, textures, sheets).build(vertical);
}

}  // namespace storey::texture
