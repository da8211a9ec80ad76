// SPDX-License-Identifier: BSD-3-Clause
// storey_reconstruct CLOUD -o DIRECTORY: a small closed model of a building from its point cloud.
#include <cstdio>
#include <optional>

#include "cli/command_line.h"
#include "cli/spinning.h"
#include "io/failure.h"
#include "io/output_file.h"
#include "reconstruct/intermediate.h"
#include "reconstruct/options.h"
#include "reconstruct/pictures.h"
#include "reconstruct/pipeline.h"
#include "reconstruct/report.h"
#include "stages/stage_cloud_io.h"

namespace storey::reconstruct {
namespace {

int run(int argc, char** argv) {
  Options options;
  if (!parseOptions(argc, argv, options)) return io::Ok;
  if (options.threads != 1) cli::limitSpinning(argv);
  std::optional<PictureProgram> pictures;  // before the work, for it may not be there
  if (options.pictures) pictures.emplace();
  std::optional<io::OutputDirectory> directory;  // made when there is something to write
  const auto file = [&](const std::string& name) {
    if (!directory) directory.emplace(options.output_directory);
    return directory->file(name);
  };
  Observers observers;
  observers.progress = [&](const std::string& line) {
    if (!options.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  };
  if (options.intermediate) {
    observers.cloud = [&](const std::string& name, const stages::StageCloud& cloud) {
      writeStageCloud(file(name + ".pcd"), cloud);
    };
  }
  const Result result = reconstruct(options, observers);
  const exports::Exported exported{result.model.model, result.local_to_input, options.attitude.crs,
                                   describe(options, result)};
  for (const exports::Format& format : options.formats) {
    format.write(file(format.file), exported);
  }
  if (options.intermediate) writeIntermediate(*directory, options, result);
  io::OutputFile report(file("report.json"));  // last: all the others are there
  report.write(exported.report);
  report.commit();
  if (!result.model.check.ok()) {
    throw io::Failure(io::Internal, options.input, "the model failed its checks",
                      "see report.json, and report it with the cloud");
  }
  if (pictures) pictures->draw(options.output_directory);
  return io::Ok;
}

}  // namespace
}  // namespace storey::reconstruct

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_reconstruct",
                              [&] { return storey::reconstruct::run(argc, argv); });
}
