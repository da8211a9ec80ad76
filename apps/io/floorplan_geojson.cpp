// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/crs_json.h"
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

/// What is known of the edges of a component, each as one array for each ring.
struct EdgeArrays {
  Json walls = Json::array();
  Json hypothetical = Json::array();
  Json coverage = Json::array();
  Json deviation = Json::array();

  void addRing(const PolyhedralModel& model, const FloorplanLayer& layer,
               const FloorplanRing& ring) {
    Json of_ring[4] = {Json::array(), Json::array(), Json::array(), Json::array()};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const FloorplanEdge& edge = ring.edges[i];
      const PolyhedralFace* face = wallFaceAt(model, layer, ring, i);
      of_ring[0].push_back(edge.wall);
      of_ring[1].push_back(edge.hypothetical || (face != nullptr && face->hypothetical));
      of_ring[2].push_back(face != nullptr ? Json(face->coverage) : Json(nullptr));
      const bool known = face != nullptr && std::isfinite(face->deviation);
      of_ring[3].push_back(known ? Json(face->deviation) : Json(nullptr));
    }
    walls.push_back(std::move(of_ring[0]));
    hypothetical.push_back(std::move(of_ring[1]));
    coverage.push_back(std::move(of_ring[2]));
    deviation.push_back(std::move(of_ring[3]));
  }
};

Json feature(const PolyhedralModel& model, const FloorplanLayer& layer,
             const Eigen::Isometry3d& transform) {
  Json polygons = Json::array();
  Json properties = {{"z_min", layer.z_min + transform.translation().z()},
                     {"z_max", layer.z_max + transform.translation().z()},
                     {"area", area(layer.plan)},
                     {"perimeter", perimeter(layer.plan)}};
  for (const char* name : {"walls", "hypothetical", "coverage", "deviation"}) {
    properties[name] = Json::array();
  }
  for (const FloorplanComponent& component : layer.plan.components) {
    Json rings = Json::array({ringCoordinates(component.outer, transform)});
    EdgeArrays edges;
    edges.addRing(model, layer, component.outer);
    for (const FloorplanRing& hole : component.holes) {
      rings.push_back(ringCoordinates(hole, transform));
      edges.addRing(model, layer, hole);
    }
    polygons.push_back(std::move(rings));
    properties["walls"].push_back(std::move(edges.walls));
    properties["hypothetical"].push_back(std::move(edges.hypothetical));
    properties["coverage"].push_back(std::move(edges.coverage));
    properties["deviation"].push_back(std::move(edges.deviation));
  }
  Json result;
  result["type"] = "Feature";
  result["properties"] = std::move(properties);
  result["geometry"] = {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}};
  return result;
}

}  // namespace

const PolyhedralFace* wallFaceAt(const PolyhedralModel& model, const FloorplanLayer& layer,
                                 const FloorplanRing& ring, std::size_t edge) {
  const int wall = ring.edges[edge].wall;
  Eigen::Vector3d middle(0.0, 0.0, 0.5 * (layer.z_min + layer.z_max));
  middle.head<2>() = 0.5 * (ring.vertices[edge] + ring.vertices[(edge + 1) % ring.size()]);
  const PolyhedralFace* found = nullptr;
  double smallest = std::numeric_limits<double>::infinity();
  for (const PolyhedralFace& face : model.faces) {
    if (face.label != FaceLabel::Wall || face.wall != wall || wall < 0) continue;
    Eigen::AlignedBox3d box;
    for (const int v : face.outer) box.extend(model.vertices[static_cast<std::size_t>(v)]);
    const double size = box.diagonal().norm();
    box.min().array() -= 2.0 * model.grid;  // vertices move by a grid unit
    box.max().array() += 2.0 * model.grid;
    if (!box.contains(middle) || size >= smallest) continue;
    smallest = size;
    found = &face;
  }
  return found;
}

Eigen::Isometry3d planFrame(const Eigen::Isometry3d& local_to_input) {
  return keepsVertical(local_to_input) ? local_to_input : Eigen::Isometry3d::Identity();
}

void writeFloorplansGeoJson(const std::string& path, const PolyhedralModel& model,
                            const Eigen::Isometry3d& local_to_input, const std::string& crs) {
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  const bool upright = keepsVertical(local_to_input);
  Json collection;
  collection["type"] = "FeatureCollection";
  addCrs(crs, collection);
  collection["frame_to_input"] = matrixRows(upright ? identity : local_to_input);
  collection["features"] = Json::array();
  for (const FloorplanLayer& layer : model.storeys) {
    collection["features"].push_back(feature(model, layer, planFrame(local_to_input)));
  }
  OutputFile file(path);
  file.write(collection.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

}  // namespace storey::io
