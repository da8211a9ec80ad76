// SPDX-License-Identifier: BSD-3-Clause
// A cloud that is denser than its noise, thinned to what shows its structure.
#include "cli/command_line.h"
#include "stages/sampling.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  int structure_points = 0;
  return storey::tools::runStage(
      argc, argv,
      {"storey_sampling",
       "Thins a cloud whose points lie closer together than their noise: an even part of them "
       "shows\n"
       "all that the noise lets tell apart, and the later stages are as much faster. Other clouds "
       "are\n"
       "left as they are. storey_layers then fits to all the points, of storey_vertical.",
       [&](storey::cli::CommandLine& line) {
         line.whole("structure-points", structure_points, 0,
                    "points to keep [0 = as many as storey_vertical has noted, or else as the "
                    "noise lets tell apart]");
       },
       {},
       [&](storey::stages::StageCloud& cloud, unsigned int threads) {
         if (cloud.state.sample_size == 0 || structure_points > 0)
           findSampleSize(cloud, {structure_points, 0.0}, threads);
         cloud = sampleOf(cloud);
         return storey::stages::format("%zu points kept", cloud.points->size());
       }});
}
