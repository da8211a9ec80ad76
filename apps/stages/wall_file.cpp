// SPDX-License-Identifier: BSD-3-Clause
#include "stages/wall_file.h"

#include "io/crs_json.h"
#include "io/output_file.h"

namespace storey::stages {
namespace {

using Json = nlohmann::ordered_json;

Json toFeature(const storey::detail::WallLine& wall, std::size_t number) {
  Json lines = Json::array();
  for (const auto& [first, last] : wall.runs) {
    Json line = Json::array();
    for (const double s : {first, last}) {
      const Eigen::Vector2d end = wall.offset * wall.normal + s * wall.tangent();
      line.push_back({end.x(), end.y()});
    }
    lines.push_back(std::move(line));
  }
  return {{"type", "Feature"},
          {"properties",
           {{"wall", number},
            {"normal", {wall.normal.x(), wall.normal.y()}},
            {"offset", wall.offset},
            {"z_min", wall.z_min},
            {"z_max", wall.z_max},
            {"area", wall.support_area},
            {"points", wall.support},
            {"residual", wall.residual}}},
          {"geometry", {{"type", "MultiLineString"}, {"coordinates", std::move(lines)}}}};
}

}  // namespace

void writeWalls(const std::string& path, const std::vector<storey::detail::WallLine>& walls,
                const StageState& state) {
  Json collection;
  collection["type"] = "FeatureCollection";
  io::addCrs(state.crs, collection);
  collection["frame_to_input"] = io::matrixRows(state.frame_to_input);
  collection["features"] = Json::array();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    collection["features"].push_back(toFeature(walls[w], w + 1));
  }
  io::OutputFile file(path);
  file.write(collection.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

}  // namespace storey::stages
