// SPDX-License-Identifier: BSD-3-Clause
// The dominant directions of the walls of a cloud.
#include "stages/planar.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(argc, argv,
                                 {"storey_dominant_directions",
                                  "Adds the field direction: which of the dominant wall directions "
                                  "each planar point has, from 1,\n"
                                  "0 = none. The directions are in the header.",
                                  {},
                                  {},
                                  [](storey::stages::StageCloud& cloud, unsigned int threads) {
                                    return findDirections(cloud, threads);
                                  }});
}
