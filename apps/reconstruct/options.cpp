// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/options.h"

#include <boost/program_options.hpp>
#include <cmath>
#include <iostream>
#include <sstream>

#include "io/failure.h"

namespace storey::reconstruct {
namespace {

namespace po = boost::program_options;

[[noreturn]] void usageError(const std::string& reason) {
  throw io::Failure(io::Usage, "", reason, "see storey_reconstruct --help");
}

po::options_description describe(Options& o) {
  po::options_description all(
      "usage: storey_reconstruct CLOUD -o DIRECTORY [options]\n\n"
      "Makes a small closed model of a building from its point cloud (.ply or .pcd, with or\n"
      "without normals). Writes model.ply, model.obj, floorplans.geojson and report.json.\n"
      "Lengths are in the cloud's unit; those that are not given are derived from the cloud.\n\n"
      "options");
  all.add_options()("help,h", "print this and exit")("version", "print the version and exit")(
      "input", po::value(&o.input), "the cloud")("output,o", po::value(&o.output_directory),
                                                 "directory for the results; made if missing")(
      "up", po::value<std::string>(),
      "the direction up, 'x,y,z', good to 15 degrees [found from the walls, the side nearer to "
      "+z]")("space", po::value<std::string>()->default_value("auto"),
             "what the model fills: outside = a building seen from outside, inside = a room or "
             "yard seen from inside, auto = told from the normals")(
      "method", po::value<std::string>()->default_value("building"),
      "where the floorplans come from: building = walls of the whole building at once, paper = "
      "slice by slice")(
      "block-cost", po::value(&o.block_cost)->default_value(0.0),
      "method building: wall area that one more block must explain [0 = derived]")(
      "estimate-normals", po::bool_switch(&o.estimate_normals),
      "estimate and orient the normals even if the file has some")(
      "noise", po::value(&o.noise)->default_value(0.0),
      "standard deviation of the points about their walls, length [0 = measured]")(
      "kept-share", po::value(&o.kept_share)->default_value(0.85),
      "share of the points taken as planar, 0 to 1")(
      "slice-thickness", po::value(&o.slice_thickness)->default_value(0.0),
      "height of a slice, length [0 = derived]")(
      "smoothness", po::value(&o.smoothness)->default_value(0.1),
      "eta1: cost of a change of the floorplan from slice to slice, >= 0")(
      "label-cost", po::value(&o.label_cost)->default_value(0.5),
      "eta2: cost of one more floorplan type, >= 0")(
      "max-types", po::value(&o.max_types)->default_value(0),
      "greatest number of floorplan types [0 = no limit]")(
      "max-faces", po::value(&o.max_faces)->default_value(0),
      "method building: greatest number of polygons [0 = no limit]")(
      "trade-off", po::bool_switch(&o.trade_off),
      "method building: report what simpler models would leave unexplained")(
      "grid", po::value(&o.grid)->default_value(0.0),
      "unit of the model's coordinates, length [0 = about a millionth of the extent]")(
      "encoding", po::value<std::string>()->default_value("walls"),
      "how floorplans are compared: walls (position and shape) or turns (the paper's)")(
      "linking", po::value<std::string>()->default_value("optimal"),
      "how wall segments are linked: optimal, or greedy (the paper's Algorithm 1)")(
      "expansion", po::bool_switch()->default_value(false),
      "minimise the layers' energy by alpha-expansion, as the paper, instead of exactly")(
      "threads", po::value(&o.threads)->default_value(0), "number of threads [0 = all cores]")(
      "intermediate", po::bool_switch(&o.intermediate),
      "also write the cloud of each stage as binary PCD, for pcl_viewer")(
      "quiet,q", po::bool_switch(&o.quiet), "print nothing but errors");
  return all;
}

Eigen::Vector3d parseUp(const std::string& text) {
  std::istringstream stream(text);
  Eigen::Vector3d up;
  char comma1 = 0;
  char comma2 = 0;
  stream >> up.x() >> comma1 >> up.y() >> comma2 >> up.z();
  if (!stream || comma1 != ',' || comma2 != ',' || !(stream >> std::ws).eof() || !up.allFinite() ||
      !(up.norm() > 0.0)) {
    usageError("--up is '" + text + "', expected three numbers 'x,y,z' that are not all zero");
  }
  return up.normalized();
}

template <typename T>
T choose(const std::string& option, const std::string& value, const std::vector<std::string>& names,
         const std::vector<T>& values) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (value == names[i]) return values[i];
  }
  std::string expected;
  for (const std::string& name : names) expected += (expected.empty() ? "" : ", ") + name;
  usageError("--" + option + " is '" + value + "', expected one of " + expected);
}

void requireNonNegative(const std::string& option, double value) {
  if (!(value >= 0.0) || std::isinf(value)) {
    std::ostringstream reason;
    reason << "--" << option << " is " << value << ", expected a finite number >= 0";
    usageError(reason.str());
  }
}

}  // namespace

bool parseOptions(int argc, char** argv, Options& options) {
  const po::options_description all = describe(options);
  po::positional_options_description positional;
  positional.add("input", 1);
  po::variables_map given;
  try {
    // No guessing of shortened names; negative numbers are values, not options.
    const int style =
        po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::store(
        po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
        given);
    if (given.count("help") != 0) {
      std::cout << all << '\n';
      return false;
    }
    if (given.count("version") != 0) {
      std::cout << "storey " << STOREY_VERSION << '\n';
      return false;
    }
    po::notify(given);
  } catch (const po::error& error) {
    usageError(error.what());
  }
  if (options.input.empty()) usageError("no cloud given");
  if (options.output_directory.empty()) usageError("no output directory given (-o)");
  if (given.count("up") != 0) options.up = parseUp(given["up"].as<std::string>());
  options.side =
      choose<SpaceSide>("space", given["space"].as<std::string>(), {"auto", "outside", "inside"},
                        {SpaceSide::Auto, SpaceSide::Outside, SpaceSide::Inside});
  options.method = choose<Method>("method", given["method"].as<std::string>(),
                                  {"building", "paper"}, {Method::Building, Method::Paper});
  requireNonNegative("block-cost", options.block_cost);
  using Encoding = FloorplanGrammar::Encoding;
  options.encoding = choose<Encoding>("encoding", given["encoding"].as<std::string>(),
                                      {"walls", "turns"}, {Encoding::Walls, Encoding::Turns});
  using Linking = detail::LinkingMethod;
  options.linking = choose<Linking>("linking", given["linking"].as<std::string>(),
                                    {"optimal", "greedy"}, {Linking::Optimal, Linking::Greedy});
  options.exact = !given["expansion"].as<bool>();
  requireNonNegative("noise", options.noise);
  requireNonNegative("slice-thickness", options.slice_thickness);
  requireNonNegative("smoothness", options.smoothness);
  requireNonNegative("label-cost", options.label_cost);
  requireNonNegative("max-types", options.max_types);
  requireNonNegative("max-faces", options.max_faces);
  requireNonNegative("grid", options.grid);
  if (!(options.kept_share > 0.0 && options.kept_share <= 1.0)) {
    usageError("--kept-share must be above 0 and at most 1");
  }
  return true;
}

}  // namespace storey::reconstruct
