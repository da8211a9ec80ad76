// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stage_program.h"

#include <algorithm>
#include <cstdio>

#include "cli/spinning.h"
#include "io/cloud_writer.h"
#include "io/failure.h"
#include "stages/options.h"
#include "stages/stage_cloud_io.h"

namespace storey::tools {
namespace {

int run(int argc, char** argv, const StageProgram& program) {
  std::string input;
  std::string output;
  unsigned int threads = 0;
  bool quiet = false;
  cli::CommandLine line(program.name, {"IN OUT [options]"}, program.text);
  line.argument("in", input, "the cloud (PCD, PLY, LAS, VTK, PMVS patches, lines x y z)");
  line.argument("out", output, "the cloud with what was found (.pcd, .ply)");
  if (program.declare) program.declare(line);
  line.threads(threads);
  stages::declareQuiet(line, quiet);
  if (!line.parse(argc, argv)) return io::Ok;
  if (input.empty() || output.empty()) line.fail("an input and an output are needed");
  requireExtension(line, output, {".pcd", ".ply"});
  if (program.check) program.check(line);
  if (threads != 1) cli::limitSpinning(argv);
  stages::StageCloud cloud = stages::readStageCloud(input);
  const std::string found = program.work(cloud, threads);
  stages::writeStageCloud(output, cloud);
  if (!quiet) std::fprintf(stderr, "%s\n", found.c_str());
  return io::Ok;
}

}  // namespace

int runStage(int argc, char** argv, const StageProgram& program) {
  return cli::runMain(program.name, [&] { return run(argc, argv, program); });
}

void requireExtension(const cli::CommandLine& line, const std::string& path,
                      const std::vector<std::string>& extensions) {
  std::string expected;
  for (const std::string& extension : extensions) {
    if (io::hasExtension(path, extension)) return;
    expected += (expected.empty() ? "" : ", ") + extension;
  }
  line.fail("the output '" + path + "' is none of " + expected);
}

}  // namespace storey::tools
