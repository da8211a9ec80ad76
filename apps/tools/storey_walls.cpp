// SPDX-License-Identifier: BSD-3-Clause
// The walls of a building: which points are of which wall, and their lines in plan.
#include "stages/floorplans.h"
#include "stages/wall_file.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  namespace stages = storey::stages;
  double min_area = 0.0;
  std::string segments;
  return storey::tools::runStage(
      argc, argv,
      {"storey_walls",
       "Adds the field wall: the vertical plane that each planar point lies on, the one with most\n"
       "points first, from 1, 0 = none. The two faces of a free-standing wall are two walls. Needs "
       "an\n"
       "upright cloud with outward normals, as of storey_vertical; with storey_planar_confidence\n"
       "before it only planar points count.",
       [&](storey::cli::CommandLine& line) {
         line.number("min-area", min_area, storey::cli::kNonNegative,
                     "least area of a wall that has points, squared length [0 = derived]");
         line.text("segments", segments,
                   "also write the walls to this file (.geojson): where they were seen in plan");
       },
       [&](const storey::cli::CommandLine& line) {
         if (!segments.empty()) storey::tools::requireExtension(line, segments, {".geojson"});
       },
       [&](stages::StageCloud& cloud, unsigned int threads) {
         std::vector<storey::detail::WallLine> lines;
         const std::string found = extractWalls(cloud, min_area, threads, lines);
         if (!segments.empty()) writeWalls(segments, lines, cloud.state);
         return found;
       }});
}
