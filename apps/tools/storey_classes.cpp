// SPDX-License-Identifier: BSD-3-Clause
// What each point is of: a wall, a level face, the ground and so on.
#include "stages/classes.h"
#include "tools/stage_program.h"

int main(int argc, char** argv) {
  return storey::tools::runStage(
      argc, argv,
      {"storey_classes",
       "Adds the field class, what each point is of: 1 wall, 2 level face, 3 ground, 4 sloped "
       "surface,\n"
       "5 no surface, 6 a small group apart from the rest, 7 a surface smaller than any wall. The\n"
       "classes only describe; the later stages do without. Needs an upright cloud with outward\n"
       "normals, as of storey_vertical; without storey_planar_confidence before it all points "
       "count\n"
       "as planar.",
       {},
       {},
       [](storey::stages::StageCloud& cloud, unsigned int threads) {
         return classify(cloud, threads);
       }});
}
