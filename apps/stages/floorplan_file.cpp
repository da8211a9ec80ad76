// SPDX-License-Identifier: BSD-3-Clause
#include "stages/floorplan_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/crs_json.h"
#include "io/input_file.h"
#include "io/output_file.h"
#include "stages/stage_notes.h"

namespace storey::stages {
namespace {

using Json = nlohmann::ordered_json;  // members in the order written here

constexpr std::uint64_t kMaxBytes = std::uint64_t{256} << 20;  // floorplans take kilobytes
constexpr const char* kLayersOf[] = {"blocks", "slices"};      // in the order of `Method`

void addRing(const FloorplanRing& ring, Json& coordinates, Json& walls, Json& hypothetical) {
  Json corners = Json::array();
  Json wall_of = Json::array();
  Json unseen = Json::array();
  for (std::size_t i = 0; i <= ring.size(); ++i) {  // GeoJSON repeats the first corner
    const Eigen::Vector2d& corner = ring.vertices[i % ring.size()];
    corners.push_back({corner.x(), corner.y()});
  }
  for (const FloorplanEdge& edge : ring.edges) {
    wall_of.push_back(edge.wall);
    unseen.push_back(edge.hypothetical);
  }
  coordinates.push_back(std::move(corners));
  walls.push_back(std::move(wall_of));
  hypothetical.push_back(std::move(unseen));
}

Json toFeature(const FloorplanLayer& layer) {
  Json polygons = Json::array();
  Json properties = {{"z_min", layer.z_min},
                     {"z_max", layer.z_max},
                     {"walls", Json::array()},
                     {"hypothetical", Json::array()}};
  for (const FloorplanComponent& component : layer.plan.components) {
    Json rings = Json::array();
    Json walls = Json::array();
    Json hypothetical = Json::array();
    addRing(component.outer, rings, walls, hypothetical);
    for (const FloorplanRing& hole : component.holes) addRing(hole, rings, walls, hypothetical);
    polygons.push_back(std::move(rings));
    properties["walls"].push_back(std::move(walls));
    properties["hypothetical"].push_back(std::move(hypothetical));
  }
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}}}};
}

double finite(const Json& json) {
  const auto value = json.get<double>();
  if (!std::isfinite(value)) throw std::invalid_argument("a number is not finite");
  return value;
}

FloorplanRing toRing(const Json& corners, const Json& walls, const Json& hypothetical) {
  FloorplanRing ring;
  if (corners.size() < 4 || walls.size() + 1 != corners.size() ||
      hypothetical.size() != walls.size()) {
    throw std::invalid_argument("a ring has too few corners, or not as many edges");
  }
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    ring.vertices.emplace_back(finite(corners.at(i).at(0)), finite(corners.at(i).at(1)));
    ring.edges.push_back({walls.at(i).get<int>(), hypothetical.at(i).get<bool>()});
  }
  return ring;
}

FloorplanLayer toLayer(const Json& feature) {
  const Json& properties = feature.at("properties");
  FloorplanLayer layer;
  layer.z_min = finite(properties.at("z_min"));
  layer.z_max = finite(properties.at("z_max"));
  if (!(layer.z_min < layer.z_max)) throw std::invalid_argument("a layer has no height");
  const Json& polygons = feature.at("geometry").at("coordinates");
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const Json& rings = polygons.at(p);
    const Json& walls = properties.at("walls").at(p);
    const Json& hypothetical = properties.at("hypothetical").at(p);
    FloorplanComponent component;
    component.outer = toRing(rings.at(0), walls.at(0), hypothetical.at(0));
    for (std::size_t r = 1; r < rings.size(); ++r) {
      component.holes.push_back(toRing(rings.at(r), walls.at(r), hypothetical.at(r)));
    }
    layer.plan.components.push_back(std::move(component));
  }
  return layer;
}

StageFloorplans fromJson(const Json& collection, const io::InputFile& file) {
  StageFloorplans floorplans;
  const auto layers_of = collection.at("layers_of").get<std::string>();
  if (layers_of != kLayersOf[0] && layers_of != kLayersOf[1]) {
    throw std::invalid_argument("layers_of is neither blocks nor slices");
  }
  floorplans.method = layers_of == kLayersOf[0] ? Method::Building : Method::Paper;
  const auto state = fromNotes(collection.at("state").get<std::vector<std::string>>(), file);
  if (!state) throw std::invalid_argument("no frame_to_input in its state");
  floorplans.state = *state;
  for (const Json& feature : collection.at("features")) {
    floorplans.layers.push_back(toLayer(feature));
    const std::size_t n = floorplans.layers.size();
    if (n > 1 && floorplans.layers[n - 1].z_min < floorplans.layers[n - 2].z_min) {
      throw std::invalid_argument("the layers do not ascend");
    }
  }
  if (floorplans.layers.empty()) throw std::invalid_argument("no layers");
  return floorplans;
}

/// What is of use for a model: not how the floorplans were found.
StageState lastingState(const StageState& state) {
  StageState lasting;
  lasting.frame_to_input = state.frame_to_input;
  lasting.crs = state.crs;
  lasting.inside = state.inside;
  lasting.noise = state.noise;
  lasting.density = state.density;
  return lasting;
}

}  // namespace

void writeFloorplans(const std::string& path, const StageFloorplans& floorplans) {
  Json collection;
  collection["type"] = "FeatureCollection";
  io::addCrs(floorplans.state.crs, collection);
  collection["frame_to_input"] = io::matrixRows(floorplans.state.frame_to_input);
  collection["layers_of"] = kLayersOf[static_cast<int>(floorplans.method)];
  collection["state"] = toNotes(lastingState(floorplans.state));
  collection["features"] = Json::array();
  for (const FloorplanLayer& layer : floorplans.layers) {
    collection["features"].push_back(toFeature(layer));
  }
  io::OutputFile file(path);
  file.write(collection.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

StageFloorplans readFloorplans(const std::string& path) {
  io::InputFile file(path, kMaxBytes);
  const auto size = static_cast<std::size_t>(file.size());
  const auto* const text = reinterpret_cast<const char*>(file.take(size));
  const char* const hint = "it must be a file of storey_floorplans";
  try {
    return fromJson(Json::parse(text, text + size), file);
  } catch (const Json::exception& error) {
    file.fail(error.what(), hint);
  } catch (const std::invalid_argument& error) {
    file.fail(error.what(), hint);
  }
}

}  // namespace storey::stages
