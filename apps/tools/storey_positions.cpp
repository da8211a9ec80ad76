// SPDX-License-Identifier: BSD-3-Clause
// Moves the points of edge regions onto their walls.
#include "stages/slices.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(
      argc, argv,
      {"storey_positions",
       "Moves the points of edge regions onto their walls, and gives them the normals of their\n"
       "directions. Needs storey_regions first.",
       {},
       {},
       [](storey::stages::StageCloud& cloud, unsigned int threads) {
         return refinePositions(cloud, threads);
       }});
}
