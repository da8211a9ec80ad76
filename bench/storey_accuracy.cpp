// SPDX-License-Identifier: BSD-3-Clause
// storey_accuracy SUITE: how good models are, measured on buildings whose truth is known.
#include <thread>

#include "bench/suites.h"
#include "cli/command_line.h"
#include "io/failure.h"

namespace {

namespace bench = storey::bench;
namespace io = storey::io;

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

/// \return false if --help was all
bool parse(int argc, char** argv, bench::Request& r) {
  using storey::reconstruct::Method;
  storey::cli::CommandLine line(
      "storey_accuracy", {"SUITE [options]", "real DIR [options]"},
      "Prints a section in Markdown; a line for each building goes to stderr. Suites:\n"
      "  named       the paper's buildings and other simple ones, by both methods\n"
      "  random      clean clouds of random buildings\n"
      "  combined    the same with all defects at once\n"
      "  ablation    clean and with all defects, without one step of the method at a time\n"
      "  defects     one defect at a time, at rising levels\n"
      "  shapes      a round building; other scales and places\n"
      "  real        the .ply clouds of a folder, whose truth is not known");
  Method method = Method::Building;
  line.argument("suite", r.suite, "what is measured");
  line.argument("folder", r.folder, "suite real: the folder");
  line.whole("seed", r.seed, decltype(r.seed){0},
             "of the first building or draw; the others follow");
  line.whole("count", r.count, decltype(r.count){0},
             "buildings, or draws of each [0 = as the suite has it]");
  line.whole("points", r.points, decltype(r.points){0},
             "points of each cloud [0 = as the suite has it]");
  line.choice<Method>("method", method, {{"building", Method::Building}, {"paper", Method::Paper}},
                      "where floorplans come from [named: both]");
  line.text("defect", r.defect, "suite defects: only the one of this name");
  line.text("options", r.cloud_options,
            "suite real: a file with lines 'NAME.ply options of storey_reconstruct'");
  line.text("csv", r.csv, "also write all numbers to this file, a row each");
  line.whole("jobs", r.jobs, 1u, "reconstructions at a time");
  if (!line.parse(argc, argv)) return false;
  if (line.given("method")) r.method = method;
  if (suiteOf(r.suite) == nullptr) line.fail("there is no suite '" + r.suite + "'");
  if ((r.suite == "real") == r.folder.empty()) line.fail("real, and only real, takes a folder");
  return true;
}

int run(int argc, char** argv) {
  bench::Request request;
  request.jobs = std::max(1u, std::thread::hardware_concurrency());
  if (!parse(argc, argv, request)) return io::Ok;
  suiteOf(request.suite)(request);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_accuracy", [&] { return run(argc, argv); });
}
