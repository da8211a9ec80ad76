// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/threads.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/markdown.h"
#include "bench/performance/program.h"
#include "io/failure.h"

namespace storey::bench {
namespace {

constexpr const char* kText = R"(## One thread and two

Wall seconds of storey_reconstruct, up to a million points the best of three runs. With files: from the start of the program
to its end, the cloud read and the model written. Without: the stages alone. The results are the same bytes.

)";

constexpr const char* kStagesText = R"(
Where the second thread helps, and where not: wall seconds of each stage of the default method, each the best of the runs.
Wall lines are taken one after the other, each from what those before it left, and outlines are simplified edge by edge, the
next trial on what the last one chose: `floorplans` can only work ahead where it is likely to be of use. More threads than
two hold no more there; elsewhere the loops over points go on to scale. Files are decoded by one thread.

)";
constexpr const char* kStages[] = {"read",   "sampling", "vertical",   "orientation", "scale",
                                   "planar", "classes",  "directions", "floorplans",  "model"};

std::string programName(const std::string& method, int threads) {
  return "program, " + method + ", " + std::to_string(threads) + " thread" +
         (threads > 1 ? "s" : "");
}

std::string stagesName(const std::string& method, int threads) {
  return "stages of " + programName(method, threads);
}

std::string stageName(const std::string& stage, const std::string& method, int threads) {
  return "stage " + stage + " of " + programName(method, threads);
}

using StageSeconds = std::map<std::string, double>;  // of wall time

/// Those of the program's own report.
StageSeconds stageSeconds(const std::string& folder) {
  std::ifstream file(folder + "/report.json");
  return nlohmann::json::parse(file).at("seconds").get<StageSeconds>();
}

void takeLesser(const StageSeconds& seconds, StageSeconds& least) {
  for (const auto& [stage, wall] : seconds) {
    const auto [known, is_new] = least.emplace(stage, wall);
    if (!is_new) known->second = std::min(known->second, wall);
  }
}

/// The stages of the default method, in their order, at the sizes that one and two threads ran.
void printStages(const Results& results) {
  std::printf("%s", kStagesText);
  const std::string method = "building";
  std::vector<std::string> header = {"stage"};
  std::vector<std::size_t> sizes;
  for (const std::size_t size : results.sizes()) {
    if (results.find(programName(method, 1), size) == nullptr) continue;
    sizes.push_back(size);
    header.insert(header.end(), {std::to_string(size) + ": 1 thread", "2 threads", "speed-up"});
  }
  Table table(header);
  for (const char* stage : kStages) {
    std::vector<std::string> cells = {stage};
    for (const std::size_t size : sizes) {
      const double one = results.find(stageName(stage, method, 1), size)->wall;
      const double two = results.find(stageName(stage, method, 2), size)->wall;
      cells.insert(cells.end(), {fixed(one, 3), fixed(two, 3), fixed(one / two, 2)});
    }
    table.add(cells);
  }
  table.print();
}

}  // namespace

void measurePrograms(std::size_t size, const std::string& cloud, const std::string& scratch,
                     const std::string& method, int runs, Results& results) {
  for (const int threads : {1, 2}) {
    Measured whole{programName(method, threads), 1e9, 1e9, 0.0};
    Measured stages{stagesName(method, threads), 1e9, 0.0, 0.0};
    StageSeconds each;
    for (int i = 0; i < runs; ++i) {
      const ProgramRun run =
          runProgram("storey_reconstruct", {cloud, "-o", scratch, "--quiet", "--method", method,
                                            "--threads", std::to_string(threads)});
      if (run.status != 0) throw io::Failure(io::Internal, cloud, "storey_reconstruct failed", "");
      whole.wall = std::min(whole.wall, run.wall);
      whole.cpu = std::min(whole.cpu, run.cpu);
      whole.bytes = std::max(whole.bytes, run.peak_bytes);
      const StageSeconds seconds = stageSeconds(scratch);
      stages.wall = std::min(stages.wall, seconds.at("total") - seconds.at("read"));
      takeLesser(seconds, each);
    }
    results.add(size, "", {whole});
    results.note(size, stages);
    for (const auto& [stage, wall] : each) {
      results.note(size, {stageName(stage, method, threads), wall, 0.0, 0.0});
    }
  }
}

void measureThinned(std::size_t size, const std::string& cloud, const std::string& scratch,
                    Results& results) {
  const ProgramRun run =
      runProgram("storey_reconstruct", {cloud, "-o", scratch, "--quiet", "--threads", "2",
                                        "--max-points", std::to_string(size / 10)});
  if (run.status != 0) throw io::Failure(io::Internal, cloud, "storey_reconstruct failed", "");
  results.add(size, "",
              {{"program, building, --max-points a tenth", run.wall, run.cpu, run.peak_bytes}});
}

void printSpeedUps(const Results& results) {
  std::printf("%s", kText);
  Table table({"method", "points", "with files: 1 thread", "2 threads", "speed-up",
               "without: 1 thread", "2 threads", "speed-up"});
  for (const std::string method : {"building", "paper"}) {
    for (const std::size_t size : results.sizes()) {
      const Measured* one = results.find(programName(method, 1), size);
      if (one == nullptr) continue;
      const double whole = results.find(programName(method, 2), size)->wall;
      const double before = results.find(stagesName(method, 1), size)->wall;
      const double after = results.find(stagesName(method, 2), size)->wall;
      table.add({method, std::to_string(size), fixed(one->wall, 2), fixed(whole, 2),
                 fixed(one->wall / whole, 2), fixed(before, 2), fixed(after, 2),
                 fixed(before / after, 2)});
    }
  }
  table.print();
  printStages(results);
}

}  // namespace storey::bench
