// SPDX-License-Identifier: BSD-3-Clause
// The first stage: a cloud set upright, with outward normals and its scale.
#include "stages/options.h"
#include "tools/stage_program.h"

namespace {

namespace stages = storey::stages;

std::string prepare(stages::StageCloud& cloud, const stages::AttitudeOptions& options,
                    unsigned int threads) {
  stages::Attitude found;
  cloud.state.crs = options.crs;
  std::string lines = estimateMissingNormals(cloud, options, threads, found);
  lines = "normals " + lines + "\n" + setUpright(cloud, options, threads, found);
  lines += "\n" + orientOutwards(cloud, options, threads, found);
  return lines + "\n" + measureScale(cloud, options.noise, found.scale);
}

}  // namespace

int main(int argc, char** argv) {
  stages::AttitudeOptions options;
  return storey::tools::runStage(
      argc, argv,
      {"storey_vertical",
       "Sets the cloud of a building upright: +z is up afterwards, and the normals, estimated "
       "where\n"
       "there are none, point outwards. The header says how to get back to the input's "
       "coordinates\n"
       "(frame_to_input), and the noise and density of the walls.",
       [&](storey::cli::CommandLine& line) { declareAttitude(line, options); },
       [&](const storey::cli::CommandLine& line) { checkAttitude(line, options); },
       [&](stages::StageCloud& cloud, unsigned int threads) {
         return prepare(cloud, options, threads);
       }});
}
