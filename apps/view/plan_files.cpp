// SPDX-License-Identifier: BSD-3-Clause
#include "view/plan_files.h"

#include "view/json_file.h"

namespace storey::view {
namespace {

using Json = nlohmann::json;

Eigen::Vector2d toPoint(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

SeenWall toWall(const Json& feature) {
  const Json& properties = feature.at("properties");
  SeenWall wall;
  wall.normal = toPoint(properties.at("normal"));
  wall.z_min = properties.at("z_min").get<double>();
  wall.z_max = properties.at("z_max").get<double>();
  for (const Json& line : feature.at("geometry").at("coordinates")) {
    wall.runs.emplace_back(toPoint(line.at(0)), toPoint(line.at(1)));
  }
  return wall;
}

PlanCells::Cell toCell(const Json& feature, std::size_t num_blocks) {
  constexpr std::size_t kTriangle = 4;  // the first corner is repeated
  PlanCells::Cell cell;
  const Json& ring = feature.at("geometry").at("coordinates").at(0);
  if (ring.size() < kTriangle) throw std::invalid_argument("a cell has too few corners");
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) cell.corners.push_back(toPoint(ring.at(i)));
  cell.inside.resize(num_blocks);
  for (const Json& json : feature.at("properties").at("inside")) {
    const auto block = json.get<std::size_t>();
    if (block >= num_blocks) throw std::invalid_argument("a cell is in a block that is none");
    cell.inside[block] = true;
  }
  return cell;
}

}  // namespace

std::vector<SeenWall> readWalls(const std::string& path) {
  std::vector<SeenWall> walls;
  readJson(path, [&](const Json& json) {
    for (const Json& feature : json.at("features")) walls.push_back(toWall(feature));
  });
  return walls;
}

PlanCells readCells(const std::string& path) {
  PlanCells plan;
  readJson(path, [&](const Json& json) {
    for (const Json& heights : json.at("blocks")) {
      const Eigen::Vector2d z = toPoint(heights);
      plan.blocks.emplace_back(z.x(), z.y());
    }
    for (const Json& feature : json.at("features")) {
      plan.cells.push_back(toCell(feature, plan.blocks.size()));
    }
  });
  return plan;
}

}  // namespace storey::view
