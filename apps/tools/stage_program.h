// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "cli/command_line.h"
#include "stages/stage_cloud.h"

namespace storey::tools {

/// A program that takes a cloud through one stage: PROGRAM IN OUT [options].
struct StageProgram {
  const char* name;
  const char* text;  ///< what it does and which fields it adds, for --help
  std::function<void(cli::CommandLine&)> declare;  ///< its own options; may be empty
  /// Checks the options after they are read; may be empty.
  std::function<void(const cli::CommandLine&)> check;
  /// \return a line that says what was found
  std::function<std::string(stages::StageCloud&, unsigned int threads)> work;
};

/// `main` of such a program. \return its exit status
int runStage(int argc, char** argv, const StageProgram& program);

/// Fails unless the file's name says one of these formats (".pcd").
void requireExtension(const cli::CommandLine& line, const std::string& path,
                      const std::vector<std::string>& extensions);

}  // namespace storey::tools
