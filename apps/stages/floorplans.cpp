// SPDX-License-Identifier: BSD-3-Clause
#include "stages/floorplans.h"

#include <storey/segmentation/wall_extraction.h>

#include "stages/attitude.h"

namespace storey::stages {

std::string extractBlocks(StageCloud& cloud, const BlockOptions& options,
                          const SimplicityOptions& simplicity, unsigned int threads,
                          std::vector<FloorplanLayer>& blocks,
                          storey::detail::BuildingFloorplans& found,
                          const storey::detail::MethodSteps& steps) {
  ensureScale(cloud);
  BuildingFloorplanExtraction<Point> extraction;
  extraction.setInputCloud(cloud.points);
  extraction.setIndices(pcl::make_shared<pcl::Indices>(planarPoints(cloud)));
  extraction.setNoise(cloud.state.noise);
  extraction.setDensity(cloud.state.density);
  extraction.setBlockCost(options.block_cost);
  extraction.setMinWallArea(options.min_wall_area);
  extraction.setMaxFaces(static_cast<std::size_t>(simplicity.max_faces));
  extraction.setMaxTypes(static_cast<std::size_t>(simplicity.max_types));
  extraction.setWholeTradeOff(simplicity.trade_off);
  extraction.setSteps(steps);
  extraction.setNumberOfThreads(threads);
  if (!extraction.extract(blocks)) {
    refuse(
        cloud, "the walls enclose no building",
        "is half of it missing, the vertical wrong (--up), or are its walls small beside all of it "
        "(--min-wall-area)?");
  }
  found = extraction.getResult();
  std::string line = format("%zu walls, %zu cells, %zu layers in %zu blocks", found.walls.size(),
                            found.plan.cells.size(), found.levels.size() - 1, blocks.size());
  const std::size_t faces = found.trade_off.empty() ? 0 : found.trade_off.back().faces;
  if (simplicity.max_faces > 0 && faces > static_cast<std::size_t>(simplicity.max_faces)) {
    line +=
        format("; --max-faces %d cannot be kept, %zu are the fewest", simplicity.max_faces, faces);
  }
  return line;
}

std::string extractWalls(StageCloud& cloud, double min_area, unsigned int threads,
                         std::vector<storey::detail::WallLine>& lines) {
  ensureScale(cloud);
  WallExtraction<Point> extraction;
  extraction.setInputCloud(cloud.points);
  extraction.setIndices(pcl::make_shared<pcl::Indices>(planarPoints(cloud)));
  extraction.setNoise(cloud.state.noise);
  extraction.setDensity(cloud.state.density);
  extraction.setMinWallArea(min_area);
  extraction.setNumberOfThreads(threads);
  std::vector<pcl::PointIndices> walls;
  extraction.extract(walls);
  if (walls.empty())
    refuse(cloud, "shows no wall", "is the vertical wrong (storey_vertical --up)?");
  lines = extraction.getLines();
  std::vector<int>& wall_of = cloud.groups(Wall);
  wall_of.assign(cloud.points->size(), -1);
  std::size_t num_points = 0;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    num_points += walls[w].indices.size();
    for (const pcl::index_t i : walls[w].indices) {
      wall_of[static_cast<std::size_t>(i)] = static_cast<int>(w);
    }
  }
  return format("%zu walls, %zu of %zu points on them", walls.size(), num_points,
                cloud.points->size());
}

}  // namespace storey::stages
