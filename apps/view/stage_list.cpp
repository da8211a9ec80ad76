// SPDX-License-Identifier: BSD-3-Clause
#include "view/stage_list.h"

namespace storey::view {

const std::vector<StageInfo>& allStages() {
  static const std::vector<StageInfo> stages = {
      {Stage::Upright, "upright", 1, {"01_upright.pcd"}},
      {Stage::Confidence, "confidence", 2, {"02_confidence.pcd"}},
      {Stage::Classes, "classes", 2, {"02_classes.pcd"}},
      {Stage::Directions, "directions", 3, {"03_directions.pcd"}},
      {Stage::Slices, "slices", 4, {"04_slices.pcd"}},
      {Stage::Normals, "normals", 5, {"05_normals.pcd"}},
      {Stage::Labels, "labels", 6, {"06_labels.pcd"}},
      {Stage::Regions, "regions", 7, {"07_regions.pcd"}},
      {Stage::Refined, "refined", 8, {"05_normals.pcd", "08_refined.pcd"}},
      {Stage::Slice,
       "slice",
       9,
       {"04_slices.pcd", "05_normals.pcd", "08_refined.pcd", "09_floorplans.vtk"}},
      {Stage::Segments,
       "segments",
       9,
       {"04_slices.pcd", "05_normals.pcd", "07_regions.pcd", "08_refined.pcd"}},
      {Stage::Walls, "walls", 9, {"09_walls.geojson"}},
      {Stage::Cells, "cells", 9, {"09_cells.geojson"}},
      {Stage::Floorplans, "floorplans", 9, {"09_floorplans.vtk"}},
      {Stage::Types, "types", 10, {"09_floorplans.geojson"}},
      {Stage::Model, "model", 11, {"model.ply", "floorplans.geojson"}},
      {Stage::Support, "support", 11, {"model.ply", "floorplans.geojson"}},
      {Stage::Deviation, "deviation", 11, {"model.ply", "floorplans.geojson"}},
      {Stage::Windows, "windows", 12, {"windows.ply", "floorplans.geojson"}},
      {Stage::Textured, "textured", 13, {"textured.obj", "facades.json", "floorplans.geojson"}},
      {Stage::Overlay, "overlay", 12, {"01_upright.pcd", "model.ply", "floorplans.geojson"}}};
  return stages;
}

const StageInfo& infoOf(Stage stage) { return allStages()[static_cast<std::size_t>(stage)]; }

bool isPlan(Stage stage) {
  return stage == Stage::Slice || stage == Stage::Segments || stage == Stage::Cells;
}

bool canOverlay(Stage stage) { return stage >= Stage::Walls && stage != Stage::Cells; }

}  // namespace storey::view
