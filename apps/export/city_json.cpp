// SPDX-License-Identifier: BSD-3-Clause
#include "export/city_json.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "export/solids.h"
#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

using Json = nlohmann::ordered_json;
using Integers = std::array<std::int64_t, 3>;

// The `vertices` and the `transform` of the file. Parts that touch share vertices in the file.
class VertexPool {
 public:
  explicit VertexPool(const Exported& exported)
      : turn_(exported.local_to_input.linear()),
        scale_(turn_.isIdentity(0.0) ? exported.model.grid : exported.model.grid / 10.0) {
    low_.fill(std::numeric_limits<std::int64_t>::max());
    high_.fill(std::numeric_limits<std::int64_t>::lowest());
    for (const Eigen::Vector3d& v : exported.model.vertices) {
      const Integers p = round(v);
      for (std::size_t i = 0; i < 3; ++i) {
        low_[i] = std::min(low_[i], p[i]);
        high_[i] = std::max(high_[i], p[i]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      translate_[static_cast<int>(i)] = exported.local_to_input.translation()[static_cast<int>(i)] +
                                        static_cast<double>(low_[i]) * scale_;
    }
  }

  /// The index of a vertex of the local frame.
  std::size_t add(const Eigen::Vector3d& vertex) {
    Integers p = round(vertex);
    for (std::size_t i = 0; i < 3; ++i) p[i] -= low_[i];
    const auto [found, is_new] = index_.emplace(p, index_.size());
    if (is_new) vertices_.push_back(p);
    return found->second;
  }

  Json vertices() const { return vertices_; }
  Json transform() const {
    return {{"scale", {scale_, scale_, scale_}},
            {"translate", {translate_.x(), translate_.y(), translate_.z()}}};
  }
  Json extent() const {
    Json extent = {translate_.x(), translate_.y(), translate_.z()};
    for (std::size_t i = 0; i < 3; ++i) {
      extent.push_back(translate_[static_cast<int>(i)] +
                       static_cast<double>(high_[i] - low_[i]) * scale_);
    }
    return extent;
  }

 private:
  Integers round(const Eigen::Vector3d& vertex) const {
    const Eigen::Vector3d p = turn_ * vertex / scale_;
    return {std::llround(p.x()), std::llround(p.y()), std::llround(p.z())};
  }

  Eigen::Matrix3d turn_;
  double scale_;
  Integers low_;
  Integers high_;
  Eigen::Vector3d translate_;
  std::map<Integers, std::size_t> index_;
  std::vector<Integers> vertices_;
};

const char* surfaceType(const PolyhedralFace& face) {
  if (face.window == WindowPart::Pane) return "Window";
  if (face.window == WindowPart::Reveal) return "WallSurface";
  switch (face.label) {
    case FaceLabel::Wall:
      return "WallSurface";
    case FaceLabel::Roof:
      return "RoofSurface";
    case FaceLabel::Ground:
      return "GroundSurface";
    case FaceLabel::Ceiling:
      break;
  }
  return "OuterCeilingSurface";
}

Json describeSurface(const PolyhedralFace& face, bool fitted) {
  Json surface = {{"type", surfaceType(face)}};
  if (face.wall >= 0) surface["wall"] = face.wall;
  if (!fitted) return surface;
  surface["hypothetical"] = face.hypothetical;
  surface["support"] = face.support;
  surface["coverage"] = face.coverage;
  surface["residual"] = face.residual;
  surface["deviation"] = std::isfinite(face.deviation) ? Json(face.deviation) : Json(nullptr);
  return surface;
}

Json polygonOf(const PolyhedralModel& model, const PolyhedralFace& face, VertexPool& pool) {
  const auto ring = [&](const std::vector<int>& indices) {
    Json corners = Json::array();
    for (const int i : indices) {
      corners.push_back(pool.add(model.vertices[static_cast<std::size_t>(i)]));
    }
    return corners;
  };
  Json polygon = Json::array({ring(face.outer)});
  for (const std::vector<int>& hole : face.inner) polygon.push_back(ring(hole));
  return polygon;
}

Json solidGeometry(const PolyhedralModel& model, const Solid& solid, const char* lod,
                   VertexPool& pool) {
  std::vector<int> shells = {solid.outer};
  shells.insert(shells.end(), solid.cavities.begin(), solid.cavities.end());
  Json boundaries = Json::array();
  Json surfaces = Json::array();
  Json values = Json::array();
  for (const int shell : shells) {
    Json polygons = Json::array();
    Json of_shell = Json::array();
    for (const PolyhedralFace& face : model.faces) {
      if (face.shell != shell) continue;
      polygons.push_back(polygonOf(model, face, pool));
      of_shell.push_back(surfaces.size());
      surfaces.push_back(describeSurface(face, !model.covariances.empty()));
    }
    boundaries.push_back(std::move(polygons));
    values.push_back(std::move(of_shell));
  }
  return {{"type", "Solid"},
          {"lod", lod},
          {"boundaries", std::move(boundaries)},
          {"semantics", {{"surfaces", std::move(surfaces)}, {"values", std::move(values)}}}};
}

Json geometriesOf(const PolyhedralModel& model, const Solid& solid, VertexPool& pool) {
  const PolyhedralModel block = blockOver(model, solid.outer);
  return Json::array(
      {solidGeometry(block, {}, "1.2", pool), solidGeometry(model, solid, "2.2", pool)});
}

Json describeStoreys(const Exported& exported) {
  const double foot = io::planFrame(exported.local_to_input).translation().z();
  Json storeys = Json::array();
  for (const FloorplanLayer& storey : exported.model.storeys) {
    storeys.push_back({{"z_min", foot + storey.z_min},
                       {"z_max", foot + storey.z_max},
                       {"area", area(storey.plan)},
                       {"perimeter", perimeter(storey.plan)}});
  }
  return storeys;
}

Json cityObjects(const Exported& exported, VertexPool& pool) {
  const std::vector<Solid> solids = solidsOf(exported.model);
  Json objects;
  Json& building = objects["building"];
  building = {{"type", "Building"}, {"attributes", {{"storeys", describeStoreys(exported)}}}};
  if (solids.size() == 1) {
    building["geometry"] = geometriesOf(exported.model, solids[0], pool);
    return objects;
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const std::string id = "building_part_" + std::to_string(i);
    objects["building"]["children"].push_back(id);
    objects[id] = {{"type", "BuildingPart"},
                   {"parents", {"building"}},
                   {"geometry", geometriesOf(exported.model, solids[i], pool)}};
  }
  return objects;
}

}  // namespace

void writeCityJson(const std::string& path, const Exported& exported) {
  VertexPool pool(exported);
  Json city = {{"type", "CityJSON"}, {"version", "2.0"}};
  city["transform"] = pool.transform();
  city["metadata"] = {{"geographicalExtent", pool.extent()}};
  city["CityObjects"] = cityObjects(exported, pool);
  const std::string authority = "EPSG:";
  if (exported.crs.rfind(authority, 0) == 0) {
    city["metadata"]["referenceSystem"] =
        "https://www.opengis.net/def/crs/EPSG/0/" + exported.crs.substr(authority.size());
  } else if (!exported.crs.empty()) {  // the format's own member has no place for a mere name
    city["CityObjects"]["building"]["attributes"]["crs"] = exported.crs;
  }
  city["vertices"] = pool.vertices();
  io::OutputFile file(path);
  file.write(city.dump() + "\n");
  file.commit();
}

}  // namespace storey::exports
