// SPDX-License-Identifier: BSD-3-Clause
// Cuts a cloud along gravity.
#include "stages/options.h"
#include "stages/slices.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  storey::stages::SliceOptions options;
  return storey::tools::runStage(
      argc, argv,
      {"storey_slices",
       "Adds the field slice: the horizontal slice that each planar wall point is in, from 1 at "
       "the\n"
       "bottom, 0 = none. Their heights are in the header.",
       [&](storey::cli::CommandLine& line) { declareThickness(line, options); },
       {},
       [&](storey::stages::StageCloud& cloud, unsigned int) {
         return cutSlices(cloud, options.thickness);
       }});
}
