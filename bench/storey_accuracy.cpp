// SPDX-License-Identifier: BSD-3-Clause
// storey_accuracy SUITE: how good models are, measured on buildings whose truth is known.
#include <pcl/console/print.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <thread>

#include "bench/suites.h"
#include "io/failure.h"

namespace {

namespace bench = storey::bench;
namespace io = storey::io;
namespace po = boost::program_options;

using Suite = void (*)(const bench::Request&);

Suite suiteOf(const std::string& name) {
  if (name == "named") return bench::measureNamed;
  if (name == "random") return bench::measureRandom;
  if (name == "combined") return bench::measureCombined;
  if (name == "ablation") return bench::measureAblation;
  if (name == "defects") return bench::measureDefects;
  if (name == "shapes") return bench::measureShapes;
  if (name == "real") return bench::measureReal;
  return nullptr;
}

[[noreturn]] void failUsage(const std::string& reason) {
  throw io::Failure(io::Usage, "", reason, "see storey_accuracy --help");
}

storey::reconstruct::Method methodOf(const std::string& name) {
  if (name == "building") return storey::reconstruct::Method::Building;
  if (name == "paper") return storey::reconstruct::Method::Paper;
  failUsage("--method is '" + name + "', expected building or paper");
}

po::options_description describe(bench::Request& r) {
  po::options_description visible(
      "storey_accuracy SUITE [options]\n"
      "  named       the paper's buildings and other simple ones, by both methods\n"
      "  random      clean clouds of random buildings\n"
      "  combined    the same with all defects at once\n"
      "  ablation    clean and with all defects, without one step of the method at a time\n"
      "  defects     one defect at a time, at rising levels\n"
      "  shapes      a round building; other scales and places\n"
      "  real DIR    the .ply clouds of a folder, whose truth is not known\n"
      "Prints a section in Markdown; a line for each building goes to stderr.\n\n"
      "options");
  visible.add_options()("seed", po::value(&r.seed)->default_value(r.seed),
                        "of the first building or draw; the others follow")(
      "count", po::value(&r.count), "buildings, or draws of each [as the suite has it]")(
      "points", po::value(&r.points), "points of each cloud [as the suite has it]")(
      "method", po::value<std::string>(), "building or paper [building; named: both]")(
      "defect", po::value(&r.defect), "suite defects: only the one of this name")(
      "options", po::value(&r.cloud_options),
      "suite real: a file with lines 'NAME.ply options of storey_reconstruct'")(
      "csv", po::value(&r.csv), "also write all numbers to this file, a row each")(
      "jobs", po::value(&r.jobs)->default_value(r.jobs), "reconstructions at a time")("help,h",
                                                                                      "this text");
  return visible;
}

/// \return false if --help was all
bool parse(int argc, char** argv, bench::Request& r) {
  const po::options_description visible = describe(r);
  po::options_description all;
  all.add(visible).add_options()("suite", po::value(&r.suite))("folder", po::value(&r.folder));
  po::positional_options_description positional;
  positional.add("suite", 1).add("folder", 1);
  po::variables_map given;
  try {
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), given);
    po::notify(given);
  } catch (const po::error& error) {
    failUsage(error.what());
  }
  if (given.count("help") > 0) {
    std::cout << visible;
    return false;
  }
  if (given.count("method") > 0) r.method = methodOf(given["method"].as<std::string>());
  if (suiteOf(r.suite) == nullptr) failUsage("there is no suite '" + r.suite + "'");
  if ((r.suite == "real") == r.folder.empty()) failUsage("real, and only real, takes a folder");
  if (r.jobs == 0) failUsage("--jobs must be at least 1");
  return true;
}

int run(int argc, char** argv) {
  bench::Request request;
  request.jobs = std::max(1u, std::thread::hardware_concurrency());
  if (!parse(argc, argv, request)) return io::Ok;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // failures are in the tables
  suiteOf(request.suite)(request);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return io::runMain("storey_accuracy", [&] { return run(argc, argv); });
}
