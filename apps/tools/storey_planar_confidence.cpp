// SPDX-License-Identifier: BSD-3-Clause
// How planar the neighbourhood of each point is.
#include "stages/options.h"
#include "stages/planar.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  double kept_share = storey::stages::kDefaultKeptShare;
  return storey::tools::runStage(
      argc, argv,
      {"storey_planar_confidence",
       "Adds the field intensity, how planar the neighbourhood of each point is (0 to 1). All "
       "points\n"
       "are kept; the later stages take those for planar whose intensity reaches the header's\n"
       "planar_threshold.",
       [&](storey::cli::CommandLine& line) { storey::stages::declareKeptShare(line, kept_share); },
       {},
       [&](storey::stages::StageCloud& cloud, unsigned int threads) {
         return measureConfidence(cloud, kept_share, threads);
       }});
}
