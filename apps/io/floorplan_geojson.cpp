// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::io {
namespace {

using Json = nlohmann::ordered_json;  // members in the order written here

// A direction cosine off 1 by less than this is rounding, not a tilt (2^-40).
constexpr double kVerticalTolerance = 9.1e-13;

bool keepsVertical(const Eigen::Isometry3d& transform) {
  return (transform.linear().col(2) - Eigen::Vector3d::UnitZ()).norm() < kVerticalTolerance;
}

Json ringCoordinates(const FloorplanRing& ring, const Eigen::Isometry3d& transform) {
  Json coordinates = Json::array();
  for (std::size_t i = 0; i <= ring.size(); ++i) {  // GeoJSON repeats the first corner
    const Eigen::Vector2d& corner = ring.vertices[i % ring.size()];
    const Eigen::Vector3d p = transform * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
    coordinates.push_back({p.x(), p.y()});
  }
  return coordinates;
}

/// `member` of the edges of a component, as one array for each ring.
template <typename T>
Json edgeValues(const FloorplanComponent& component, T FloorplanEdge::*member) {
  const auto ringValues = [member](const FloorplanRing& ring) {
    Json values = Json::array();
    for (const FloorplanEdge& edge : ring.edges) values.push_back(edge.*member);
    return values;
  };
  Json rings = Json::array({ringValues(component.outer)});
  for (const FloorplanRing& hole : component.holes) rings.push_back(ringValues(hole));
  return rings;
}

Json feature(const FloorplanLayer& layer, const Eigen::Isometry3d& transform) {
  Json polygons = Json::array();
  Json walls = Json::array();
  Json hypothetical = Json::array();
  for (const FloorplanComponent& component : layer.plan.components) {
    Json rings = Json::array({ringCoordinates(component.outer, transform)});
    for (const FloorplanRing& hole : component.holes) {
      rings.push_back(ringCoordinates(hole, transform));
    }
    polygons.push_back(std::move(rings));
    walls.push_back(edgeValues(component, &FloorplanEdge::wall));
    hypothetical.push_back(edgeValues(component, &FloorplanEdge::hypothetical));
  }
  const double rise = transform.translation().z();
  Json result;
  result["type"] = "Feature";
  result["properties"] = {{"z_min", layer.z_min + rise}, {"z_max", layer.z_max + rise},
                          {"area", area(layer.plan)},    {"perimeter", perimeter(layer.plan)},
                          {"walls", std::move(walls)},   {"hypothetical", std::move(hypothetical)}};
  result["geometry"] = {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}};
  return result;
}

Json matrixRows(const Eigen::Isometry3d& transform) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d r = transform.matrix().row(row);
    rows.push_back({r[0], r[1], r[2], r[3]});
  }
  return rows;
}

}  // namespace

void writeFloorplansGeoJson(const std::string& path, const std::vector<FloorplanLayer>& layers,
                            const Eigen::Isometry3d& local_to_input) {
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  const bool upright = keepsVertical(local_to_input);
  Json collection;
  collection["type"] = "FeatureCollection";
  collection["frame_to_input"] = matrixRows(upright ? identity : local_to_input);
  collection["features"] = Json::array();
  for (const FloorplanLayer& layer : layers) {
    collection["features"].push_back(feature(layer, upright ? local_to_input : identity));
  }
  OutputFile file(path);
  file.write(collection.dump() + "\n");
  file.commit();
}

}  // namespace storey::io
