// SPDX-License-Identifier: BSD-3-Clause
// The floorplans of a building from its cloud.
#include <cstdio>

#include "cli/spinning.h"
#include "io/failure.h"
#include "stages/floorplan_file.h"
#include "stages/options.h"
#include "stages/slices.h"
#include "stages/stage_cloud_io.h"
#include "tools/stage_program.h"

namespace storey::tools {
namespace {

struct Request {
  std::string input;
  std::string output;
  stages::Method method = stages::Method::Building;
  stages::BlockOptions blocks;
  stages::SimplicityOptions simplicity;
  stages::SliceOptions slices;
  unsigned int threads = 0;
  bool quiet = false;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line("storey_floorplans", {"IN OUT.geojson [options]"},
                        "The floorplans of a building. Method building takes the walls of the "
                        "whole building and wants\n"
                        "a cloud of storey_planar_confidence (or any upright one with outward "
                        "normals); method paper\n"
                        "gives one floorplan a slice and wants a cloud of storey_positions.");
  line.argument("in", r.input, "the cloud");
  line.argument("out", r.output, "the floorplans (.geojson), in the upright frame of the cloud");
  stages::declareMethod(line, r.method);
  stages::declareBlocks(line, r.blocks);
  stages::declareMaxFaces(line, r.simplicity);
  stages::declareMaxTypes(line, r.simplicity);
  stages::declareLinking(line, r.slices);
  line.threads(r.threads);
  stages::declareQuiet(line, r.quiet);
  if (!line.parse(argc, argv)) return false;
  if (r.input.empty() || r.output.empty()) line.fail("a cloud and an output are needed");
  requireExtension(line, r.output, {".geojson"});
  stages::checkMethod(line, r.method);
  for (const char* const later : {"max-faces", "max-types"}) {
    if (r.method == stages::Method::Paper && line.given(later)) {
      line.fail(std::string("--") + later + " of floorplans of slices goes to storey_layers");
    }
  }
  return true;
}

int run(int argc, char** argv) {
  Request r;
  if (!parse(argc, argv, r)) return io::Ok;
  if (r.threads != 1) cli::limitSpinning(argv);
  stages::StageCloud cloud = stages::readStageCloud(r.input);
  stages::StageFloorplans floorplans;
  floorplans.method = r.method;
  std::string found;
  if (r.method == stages::Method::Building) {
    storey::detail::BuildingFloorplans building;
    found = extractBlocks(cloud, r.blocks, r.simplicity, r.threads, floorplans.layers, building);
  } else {
    stages::SliceFloorplans slices;
    found = outlineSlices(cloud, r.slices.linking, r.threads, slices);
    floorplans.layers = std::move(slices.layers);
  }
  floorplans.state = cloud.state;
  writeFloorplans(r.output, floorplans);
  if (!r.quiet) std::fprintf(stderr, "%s\n", found.c_str());
  return io::Ok;
}

}  // namespace
}  // namespace storey::tools

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_floorplans", [&] { return storey::tools::run(argc, argv); });
}
