// SPDX-License-Identifier: BSD-3-Clause
#include "stages/cell_file.h"

#include "io/crs_json.h"
#include "io/output_file.h"

namespace storey::stages {
namespace {

using Json = nlohmann::ordered_json;

Json toFeature(const storey::detail::BuildingFloorplans& found, std::size_t cell) {
  const std::vector<Eigen::Vector2d>& corners = found.plan.cells[cell].corners;
  Json ring = Json::array();
  for (std::size_t i = 0; i <= corners.size(); ++i) {  // GeoJSON repeats the first corner
    const Eigen::Vector2d& corner = corners[i % corners.size()];
    ring.push_back({corner.x(), corner.y()});
  }
  Json inside = Json::array();
  for (std::size_t b = 0; b < found.blocks.size(); ++b) {
    if (found.blocks[b].inside[cell] != 0) inside.push_back(b);
  }
  return {{"type", "Feature"},
          {"properties", {{"cell", cell}, {"inside", std::move(inside)}}},
          {"geometry", {{"type", "Polygon"}, {"coordinates", Json::array({std::move(ring)})}}}};
}

}  // namespace

void writeCells(const std::string& path, const storey::detail::BuildingFloorplans& found,
                const StageState& state) {
  Json collection;
  collection["type"] = "FeatureCollection";
  io::addCrs(state.crs, collection);
  collection["frame_to_input"] = io::matrixRows(state.frame_to_input);
  collection["blocks"] = Json::array();
  for (const auto& [z_min, z_max] : found.block_heights) {
    collection["blocks"].push_back({z_min, z_max});
  }
  collection["features"] = Json::array();
  for (std::size_t cell = 0; cell < found.plan.cells.size(); ++cell) {
    collection["features"].push_back(toFeature(found, cell));
  }
  io::OutputFile file(path);
  file.write(collection.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

}  // namespace storey::stages
