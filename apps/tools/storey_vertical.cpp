// SPDX-License-Identifier: BSD-3-Clause
// The first stage: a cloud set upright, with outward normals and its scale.
#include "stages/options.h"
#include "stages/sampling.h"
#include "tools/stage_program.h"

namespace {

namespace stages = storey::stages;

/// What later stages found holds no longer once the cloud is turned.
void startAgain(stages::StageCloud& cloud) {
  stages::StageCloud fresh;
  fresh.name = cloud.name;
  fresh.points = cloud.points;
  fresh.has_normals = cloud.has_normals;
  fresh.state.frame_to_input = cloud.state.frame_to_input;
  fresh.state.crs = cloud.state.crs;
  cloud = std::move(fresh);
}

std::string prepare(stages::StageCloud& cloud, const stages::AttitudeOptions& options,
                    int structure_points, unsigned int threads) {
  startAgain(cloud);
  if (!options.crs.empty()) cloud.state.crs = options.crs;
  stages::Attitude found;
  std::string lines = estimateMissingNormals(cloud, options, threads, found);
  findSampleSize(cloud, {structure_points, options.noise}, threads);
  lines = "normals " + lines + "\n" + setUpright(cloud, options, threads, found);
  lines += "\n" + orientOutwards(cloud, options, threads, found);
  return lines + "\n" + measureScale(cloud, options.noise, threads, found.scale);
}

}  // namespace

int main(int argc, char** argv) {
  stages::AttitudeOptions options;
  int structure_points = 0;
  return storey::tools::runStage(
      argc, argv,
      {"storey_vertical",
       "Sets the cloud of a building upright: +z is up afterwards, and the normals, estimated "
       "where\n"
       "there are none, point outwards. The header says how to get back to the input's "
       "coordinates\n"
       "(frame_to_input), and the noise and density of the walls.",
       [&](storey::cli::CommandLine& line) {
         declareAttitude(line, options);
         stages::declareStructurePoints(line, structure_points);
       },
       [&](const storey::cli::CommandLine& line) { checkAttitude(line, options); },
       [&](stages::StageCloud& cloud, unsigned int threads) {
         return prepare(cloud, options, structure_points, threads);
       }});
}
