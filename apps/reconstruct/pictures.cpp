// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/pictures.h"

#include <boost/process.hpp>
#include <filesystem>

#include "io/failure.h"

namespace storey::reconstruct {
namespace {

constexpr const char* kProgram = "storey_view";

std::string findProgram() {
  std::error_code none;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path beside = self.parent_path() / kProgram;
  if (!none && std::filesystem::exists(beside, none)) return beside.string();
  return boost::process::search_path(kProgram).string();
}

}  // namespace

PictureProgram::PictureProgram() : program_(findProgram()) {
  if (program_.empty()) {
    throw io::Failure(io::MissingInput, kProgram, "is not beside storey_reconstruct",
                      "install it, or leave out --pictures");
  }
}

void PictureProgram::draw(const std::string& directory) const {
  namespace process = boost::process;
  process::ipstream errors;
  process::child viewer(program_, directory, "--pictures", process::std_err > errors);
  std::string last;
  for (std::string line; std::getline(errors, line);) last = line;
  viewer.wait();
  if (viewer.exit_code() != 0) {
    throw io::Failure(static_cast<io::ExitStatus>(viewer.exit_code()), directory,
                      "has the model but not its pictures", last);
  }
}

}  // namespace storey::reconstruct
