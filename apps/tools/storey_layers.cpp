// SPDX-License-Identifier: BSD-3-Clause
// The last stage: floorplans and a cloud to a closed model.
#include <cstdio>

#include "cli/spinning.h"
#include "export/formats.h"
#include "io/failure.h"
#include "stages/floorplan_file.h"
#include "stages/options.h"
#include "stages/stage_cloud_io.h"
#include "tools/stage_program.h"

namespace storey::tools {
namespace {

struct Request {
  std::string cloud;
  std::string floorplans;
  std::vector<std::string> outputs;
  stages::SimplicityOptions simplicity;
  stages::ModelOptions model;
  unsigned int threads = 0;
  bool quiet = false;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line(
      "storey_layers", {"CLOUD FLOORPLANS MODEL... [options]"},
      "A closed model from floorplans and the upright cloud that they were found in: the dominant\n"
      "floorplans are chosen (method paper), their walls and heights fitted to all points of the\n"
      "cloud, and extruded.");
  line.argument("cloud", r.cloud,
                "with all points: of storey_vertical or storey_planar_confidence");
  line.argument("floorplans", r.floorplans, "of storey_floorplans (.geojson)");
  line.arguments(
      "model", r.outputs,
      "one or more files, in the coordinates of the first cloud (.ply, .obj, .json =\n"
      "                CityJSON, .glb, .stl, .vtk; the fitted floorplans: .geojson, .svg, .dxf)");
  stages::declareMaxTypes(line, r.simplicity);
  stages::declareMaxFaces(line, r.simplicity);
  stages::declareModel(line, r.model);
  line.threads(r.threads);
  stages::declareQuiet(line, r.quiet);
  if (!line.parse(argc, argv)) return false;
  if (r.outputs.empty()) line.fail("a cloud, floorplans and a model are needed");
  for (const std::string& output : r.outputs) {
    const exports::Format* format = exports::formatOfFile(output);
    if (format == nullptr || format == exports::findFormat("html")) {
      line.fail("'" + output +
                "' has none of the extensions .ply .obj .json .glb .stl .vtk .geojson "
                ".svg .dxf");
    }
  }
  return true;
}

/// What the cloud does not tell, its floorplans may.
void completeState(const stages::StageFloorplans& floorplans, stages::StageCloud& cloud) {
  const stages::StageState& other = floorplans.state;
  if (cloud.state.frame_to_input.matrix() != other.frame_to_input.matrix()) {
    refuse(cloud, "is in another frame than the floorplans",
           "give the cloud that the floorplans were found in");
  }
  if (cloud.state.noise > 0.0) return;
  cloud.state.noise = other.noise;
  cloud.state.density = other.density;
}

int run(int argc, char** argv) {
  Request r;
  if (!parse(argc, argv, r)) return io::Ok;
  if (r.threads != 1) cli::limitSpinning(argv);
  stages::StageCloud cloud = stages::readStageCloud(r.cloud);
  const stages::StageFloorplans floorplans = stages::readFloorplans(r.floorplans);
  completeState(floorplans, cloud);
  if (r.simplicity.max_faces > 0 && floorplans.method == stages::Method::Building) {
    throw io::Failure(io::Usage, r.floorplans, "--max-faces is for floorplans of slices",
                      "give it to storey_floorplans");
  }
  LayerwiseModel model;
  const std::string found = buildModel(cloud, floorplans.layers, floorplans.method, r.simplicity,
                                       r.model, r.threads, model);
  const exports::Exported exported{model.model, modelToInput(cloud, model), cloud.state.crs};
  for (const std::string& output : r.outputs) {
    exports::formatOfFile(output)->write(output, exported);
  }
  if (!r.quiet) std::fprintf(stderr, "%s\n", found.c_str());
  if (!model.check.ok()) {
    throw io::Failure(io::Internal, r.cloud, "the model failed its checks",
                      "report it with the cloud");
  }
  return io::Ok;
}

}  // namespace
}  // namespace storey::tools

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_layers", [&] { return storey::tools::run(argc, argv); });
}
