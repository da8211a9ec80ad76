// SPDX-License-Identifier: BSD-3-Clause
// Smoothed normals of the points of slices.
#include "stages/slices.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(
      argc, argv,
      {"storey_normals",
       "Smooths the normals within each slice and keeps the creases. Only the points of slices "
       "are\n"
       "left, one slice after the other; they keep their heights. Needs storey_slices first.",
       {},
       {},
       [](storey::stages::StageCloud& cloud, unsigned int threads) {
         return smoothNormals(cloud, threads);
       }});
}
