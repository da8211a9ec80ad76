// SPDX-License-Identifier: BSD-3-Clause
// Edge regions: linked points of one direction.
#include "stages/slices.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(argc, argv,
                                 {"storey_regions",
                                  "Adds the field region: linked points of a slice that have one "
                                  "direction, numbered from 1 through\n"
                                  "all slices, 0 = none. Needs storey_labels first.",
                                  {},
                                  {},
                                  [](storey::stages::StageCloud& cloud, unsigned int threads) {
                                    return growRegions(cloud, threads);
                                  }});
}
