// SPDX-License-Identifier: BSD-3-Clause
#include "cli/spinning.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace storey::cli {
namespace {

constexpr const char* kVariable = "GOMP_SPINCOUNT";
constexpr const char* kSpins = "1000";  // what libgomp takes where threads outnumber cores

}  // namespace

void limitSpinning(char** arguments) {
  if (std::getenv(kVariable) != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown || setenv(kVariable, kSpins, 1) != 0) return;
  execv(program.c_str(), arguments);
}

}  // namespace storey::cli
