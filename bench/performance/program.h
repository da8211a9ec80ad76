// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace storey::bench {

/// A program that was run and waited for.
struct ProgramRun {
  int status = 0;  ///< of its exit; -1: ended by a signal, or it could not be run
  double wall = 0.0;
  double cpu = 0.0;
  double peak_bytes = 0.0;
};

/// Runs a program that lies beside this one, with its output thrown away.
ProgramRun runProgram(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace storey::bench
