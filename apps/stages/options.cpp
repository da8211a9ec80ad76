// SPDX-License-Identifier: BSD-3-Clause
#include "stages/options.h"

#include <string>
#include <vector>

#include "io/crs.h"

namespace storey::stages {

void declareAttitude(cli::CommandLine& line, AttitudeOptions& o) {
  line.vector("up", o.up,
              "the direction up, good to 15 degrees [found from the walls, the side nearer to +z]");
  line.choice<SpaceSide>(
      "space", o.side,
      {{"auto", SpaceSide::Auto}, {"outside", SpaceSide::Outside}, {"inside", SpaceSide::Inside}},
      "what the model fills: outside = a building seen from outside, inside = a "
      "room or yard seen from inside, auto = told from the normals");
  line.flag("estimate-normals", o.estimate_normals,
            "estimate and orient the normals even if the file has some");
  line.vector("sensor", o.sensor,
              "position that all points were seen from, in the cloud's coordinates: normals are "
              "turned to it [not known]");
  line.number("noise", o.noise, cli::kNonNegative,
              "standard deviation of the points about their walls, length [0 = measured]");
  line.text("crs", o.crs,
            "coordinate reference system of the cloud, for the outputs, as EPSG:25832");
}

void checkAttitude(const cli::CommandLine& line, AttitudeOptions& o) {
  if (line.given("up") && o.up.isZero()) line.fail("--up is zero, expected a direction");
  o.up.normalize();  // zero, where it is not given, stays zero
  if (!io::isCrs(o.crs)) {
    line.fail("--crs is '" + o.crs + "', expected EPSG: and a number above 0, or a name");
  }
}

void declareStructurePoints(cli::CommandLine& line, int& structure_points) {
  line.whole("structure-points", structure_points, 0,
             "points that the structure is found with; walls and heights are fitted to all points "
             "[0 = as many as the noise lets tell apart; method paper: all, but for the vertical]");
}

void declareKeptShare(cli::CommandLine& line, double& kept_share) {
  line.number("kept-share", kept_share, cli::kPositiveShare,
              "share of the points taken as planar, 0 to 1");
}

void declareMethod(cli::CommandLine& line, Method& method) {
  line.choice<Method>("method", method, {{"building", Method::Building}, {"paper", Method::Paper}},
                      "where the floorplans come from: building = walls of the whole building at "
                      "once, paper = slice by slice");
}

void checkMethod(const cli::CommandLine& line, Method method) {
  const bool paper = method == Method::Paper;
  const std::vector<std::string> others =
      paper ? std::vector<std::string>{"min-wall-area", "block-cost", "trade-off"}
            : std::vector<std::string>{"slice-thickness", "linking",  "smoothness",
                                       "label-cost",      "encoding", "expansion"};
  for (const std::string& other : others) {
    if (!line.given(other)) continue;
    line.fail("--" + other + " goes with --method " + (paper ? "building" : "paper"));
  }
}

void declareThickness(cli::CommandLine& line, SliceOptions& o) {
  line.number("slice-thickness", o.thickness, cli::kNonNegative,
              "method paper: height of a slice, length [0 = derived]");
}

void declareLinking(cli::CommandLine& line, SliceOptions& o) {
  using Linking = storey::detail::LinkingMethod;
  line.choice<Linking>("linking", o.linking,
                       {{"optimal", Linking::Optimal}, {"greedy", Linking::Greedy}},
                       "method paper: how wall segments are linked: optimal, or greedy (the "
                       "paper's Algorithm 1)");
}

void declareBlocks(cli::CommandLine& line, BlockOptions& blocks) {
  line.number(
      "min-wall-area", blocks.min_wall_area, cli::kNonNegative,
      "method building: least area of a wall that has points, squared length [0 = derived]");
  line.number("block-cost", blocks.block_cost, cli::kNonNegative,
              "method building: wall area that one more block must explain, squared length [0 = "
              "derived]");
}

void declareTradeOff(cli::CommandLine& line, SimplicityOptions& o) {
  line.flag("trade-off", o.trade_off,
            "method building: report what simpler models would leave unexplained");
}

void declareMaxFaces(cli::CommandLine& line, SimplicityOptions& o) {
  line.whole("max-faces", o.max_faces, 0, "greatest number of polygons [0 = no limit]");
}

void declareMaxTypes(cli::CommandLine& line, SimplicityOptions& o) {
  line.whole("max-types", o.max_types, 0, "greatest number of floorplan types [0 = no limit]");
}

void declareModel(cli::CommandLine& line, ModelOptions& o) {
  using Encoding = FloorplanGrammar::Encoding;
  line.number("smoothness", o.smoothness, cli::kNonNegative,
              "method paper, eta1: cost of a change of the floorplan from slice to slice");
  line.number("label-cost", o.label_cost, cli::kNonNegative,
              "method paper, eta2: cost of one more floorplan type");
  line.choice<Encoding>("encoding", o.encoding,
                        {{"walls", Encoding::Walls}, {"turns", Encoding::Turns}},
                        "method paper: how floorplans are compared: walls (position and shape) or "
                        "turns (the paper's)");
  line.flag("expansion", o.expansion,
            "method paper: minimise the layers' energy by alpha-expansion instead of exactly");
  line.number("grid", o.grid, cli::kNonNegative,
              "unit of the model's coordinates, length [0 = about a millionth of the extent]");
}

void declareQuiet(cli::CommandLine& line, bool& quiet) {
  line.flag("quiet,q", quiet, "print nothing but errors");
}

}  // namespace storey::stages
