// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/options.h"

#include <charconv>
#include <sstream>

#include "cli/command_line.h"

namespace storey::reconstruct {
namespace {

void declareSimplicity(cli::CommandLine& line, Options& o) {
  line.whole("max-types", o.max_types, 0, "greatest number of floorplan types [0 = no limit]");
  line.whole("max-faces", o.max_faces, 0,
             "method building: greatest number of polygons [0 = no limit]");
  line.flag("trade-off", o.trade_off,
            "method building: report what simpler models would leave unexplained");
}

void declareLayers(cli::CommandLine& line, Options& o) {
  using Encoding = FloorplanGrammar::Encoding;
  line.number("smoothness", o.smoothness, cli::kNonNegative,
              "eta1: cost of a change of the floorplan from slice to slice");
  line.number("label-cost", o.label_cost, cli::kNonNegative,
              "eta2: cost of one more floorplan type");
  line.number("grid", o.grid, cli::kNonNegative,
              "unit of the model's coordinates, length [0 = about a millionth of the extent]");
  line.choice<Encoding>("encoding", o.encoding,
                        {{"walls", Encoding::Walls}, {"turns", Encoding::Turns}},
                        "how floorplans are compared: walls (position and shape) or turns (the "
                        "paper's)");
  line.flag("expansion", o.expansion,
            "minimise the layers' energy by alpha-expansion, as the paper, instead of exactly");
}

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

int parseCrs(const cli::CommandLine& line, const std::string& text) {
  const std::string authority = "EPSG:";
  const char* end = text.data() + text.size();
  int code = 0;
  if (text.rfind(authority, 0) != 0 ||
      std::from_chars(text.data() + authority.size(), end, code).ptr != end || code <= 0) {
    line.fail("--crs is '" + text + "', expected EPSG: and a number above 0");
  }
  return code;
}

}  // namespace

bool parseOptions(int argc, char** argv, Options& o) {
  using Linking = detail::LinkingMethod;
  cli::CommandLine line(
      "storey_reconstruct", {"CLOUD -o DIRECTORY [options]"},
      "Makes a small closed model of a building from its point cloud (.ply or .pcd, with or\n"
      "without normals). Writes it and its floorplans in the formats asked for, and report.json.\n"
      "Lengths are in the cloud's unit; those that are not given are derived from the cloud.");
  line.argument("cloud", o.input, "the cloud");
  line.text("output,o", o.output_directory, "directory for the results; made if missing");
  std::string formats = "ply,obj,geojson,html";
  line.text("formats", formats, formatsHelp());
  std::string crs;
  line.text("crs", crs,
            "coordinate reference system of the cloud, EPSG:n, for the formats that name it");
  line.vector("up", o.up,
              "the direction up, good to 15 degrees [found from the walls, the side nearer to +z]");
  line.choice<SpaceSide>(
      "space", o.side,
      {{"auto", SpaceSide::Auto}, {"outside", SpaceSide::Outside}, {"inside", SpaceSide::Inside}},
      "what the model fills: outside = a building seen from outside, inside = a "
      "room or yard seen from inside, auto = told from the normals");
  line.choice<Method>("method", o.method,
                      {{"building", Method::Building}, {"paper", Method::Paper}},
                      "where the floorplans come from: building = walls of the whole building at "
                      "once, paper = slice by slice");
  line.number("block-cost", o.block_cost, cli::kNonNegative,
              "method building: wall area that one more block must explain [0 = derived]");
  line.flag("estimate-normals", o.estimate_normals,
            "estimate and orient the normals even if the file has some");
  line.number("noise", o.noise, cli::kNonNegative,
              "standard deviation of the points about their walls, length [0 = measured]");
  line.number("kept-share", o.kept_share, cli::kPositiveShare,
              "share of the points taken as planar, 0 to 1");
  line.number("slice-thickness", o.slice_thickness, cli::kNonNegative,
              "method paper: height of a slice, length [0 = derived]");
  line.choice<Linking>("linking", o.linking,
                       {{"optimal", Linking::Optimal}, {"greedy", Linking::Greedy}},
                       "method paper: how wall segments are linked: optimal, or greedy (the "
                       "paper's Algorithm 1)");
  declareSimplicity(line, o);
  declareLayers(line, o);
  line.threads(o.threads);
  line.flag("intermediate", o.intermediate,
            "also write the cloud of each stage as binary PCD, for pcl_viewer");
  line.flag("quiet,q", o.quiet, "print nothing but errors");
  if (!line.parse(argc, argv)) return false;
  if (o.input.empty()) line.fail("no cloud given");
  if (o.output_directory.empty()) line.fail("no output directory given (-o)");
  o.formats = parseFormats(line, formats);
  if (line.given("crs")) o.epsg = parseCrs(line, crs);
  if (line.given("up") && o.up.isZero()) line.fail("--up is zero, expected a direction");
  o.up.normalize();  // zero, where it is not given, stays zero
  return true;
}

}  // namespace storey::reconstruct
