// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/options.h"

#include <sstream>

#include "cli/command_line.h"

namespace storey::reconstruct {
namespace {

std::string formatsHelp() {
  std::string names;
  for (const exports::Format& format : exports::allFormats()) {
    names += std::string(names.empty() ? "" : ", ") + format.name + " (" + format.file + ")";
  }
  return "what is written, separated by commas: " + names;
}

std::vector<exports::Format> parseFormats(const cli::CommandLine& line, const std::string& text) {
  std::vector<exports::Format> formats;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const exports::Format* format = exports::findFormat(name);
    if (format == nullptr) line.fail("--formats has '" + name + "'; " + formatsHelp());
    formats.push_back(*format);
  }
  return formats;
}

}  // namespace

bool parseOptions(int argc, char** argv, Options& o) {
  cli::CommandLine line(
      "storey_reconstruct", {"CLOUD -o DIRECTORY [options]"},
      "Makes a small closed model of a building from its point cloud (PLY, PCD, LAS, VTK, PMVS\n"
      "patches or lines x y z, with or without normals). Writes it and its floorplans in the\n"
      "formats asked for, and report.json.\n"
      "Lengths are in the cloud's unit; those that are not given are derived from the cloud.");
  line.argument("cloud", o.input, "the cloud");
  line.text("output,o", o.output_directory, "directory for the results; made if missing");
  std::string formats = "ply,obj,geojson,html";
  line.text("formats", formats, formatsHelp());
  line.whole(
      "max-points", o.max_points, 0,
      "keep no more than about so many points of a larger cloud in memory: the structure is found "
      "in a sample at random, walls and heights are fitted to all points as the file is read once "
      "more (PLY and PCD with normals) [0 = take all of them]");
  stages::declareAttitude(line, o.attitude);
  stages::declareStructurePoints(line, o.structure_points);
  stages::declareKeptShare(line, o.kept_share);
  stages::declareMethod(line, o.method);
  stages::declareBlocks(line, o.blocks);
  stages::declareMaxFaces(line, o.simplicity);
  stages::declareMaxTypes(line, o.simplicity);
  stages::declareTradeOff(line, o.simplicity);
  stages::declareThickness(line, o.slices);
  stages::declareLinking(line, o.slices);
  stages::declareModel(line, o.model);
  line.threads(o.threads);
  line.flag("intermediate", o.intermediate,
            "also write the cloud of each stage as binary PCD, for pcl_viewer");
  line.flag("pictures", o.pictures,
            "also draw every stage as PNG, into report.html too; writes what --intermediate does");
  stages::declareQuiet(line, o.quiet);
  if (!line.parse(argc, argv)) return false;
  if (o.input.empty()) line.fail("no cloud given");
  if (o.output_directory.empty()) line.fail("no output directory given (-o)");
  stages::checkAttitude(line, o.attitude);
  stages::checkMethod(line, o.method);
  o.formats = parseFormats(line, formats);
  o.intermediate |= o.pictures;
  return true;
}

}  // namespace storey::reconstruct
