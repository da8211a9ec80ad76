// SPDX-License-Identifier: BSD-3-Clause
// The dominant direction of each point of a slice, smoothly over neighbours.
#include "stages/slices.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(argc, argv,
                                 {"storey_labels",
                                  "Sets the field direction of each point of a slice to one of the "
                                  "dominant directions, smoothly\n"
                                  "over neighbours, 0 = none. Needs storey_dominant_directions, "
                                  "storey_slices and storey_normals\n"
                                  "first.",
                                  {},
                                  {},
                                  [](storey::stages::StageCloud& cloud, unsigned int threads) {
                                    return labelPoints(cloud, threads);
                                  }});
}
