// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/real.h"

#include <cstdio>
#include <filesystem>

#include "bench/markdown.h"
#include "bench/performance/program.h"
#include "bench/real_clouds.h"

namespace storey::bench {
namespace {

constexpr const char* kText = R"(## Real clouds

storey_reconstruct on all cores, from the file to the files of the model. Clouds without normals get them estimated, which
is in the time.

)";
constexpr const char* kNone = "No folder of real clouds was given: left out.\n\n";

}  // namespace

void measureRealClouds(const std::string& folder, const std::string& scratch) {
  namespace fs = std::filesystem;
  std::printf("%s", kText);
  if (folder.empty()) {
    std::printf("%s", kNone);
    return;
  }
  const std::string given = folder + "/options.txt";
  auto options = readCloudOptions(fs::exists(given) ? given : "");
  Table table({"cloud", "MB", "wall s", "CPU s", "peak MB", "ends with"});
  for (const std::string& cloud : cloudsIn(folder)) {
    const std::string name = fs::path(cloud).filename().string();
    std::vector<std::string> arguments = {cloud, "-o", scratch, "--quiet"};
    for (const std::string& word : wordsOf(options[name])) arguments.push_back(word);
    const ProgramRun run = runProgram("storey_reconstruct", arguments);
    std::fprintf(stderr, "%s: %.1f s\n", name.c_str(), run.wall);
    table.add({name, fixed(static_cast<double>(fs::file_size(cloud)) / 1048576.0, 1),
               fixed(run.wall, 2), fixed(run.cpu, 2), fixed(run.peak_bytes / 1048576.0, 0),
               run.status == 0 ? "a valid model" : "status " + std::to_string(run.status)});
  }
  table.print();
}

}  // namespace storey::bench
