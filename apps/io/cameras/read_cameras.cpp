// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "io/cameras/camera_formats.h"
#include "io/failure.h"

namespace storey::io {
namespace {

namespace fs = std::filesystem;

/// Reads the cameras that lie in this very folder; false if there are none.
bool readFolder(const fs::path& folder, CameraSet& set) {
  std::error_code ignored;
  const auto has = [&](const char* name) { return fs::exists(folder / name, ignored); };
  if (has("cameras.bin") && has("images.bin")) {
    set = readColmapBinary(folder.string());
  } else if (has("cameras.txt") && has("images.txt")) {
    set = readColmapText(folder.string());
  } else if (has("bundle.out")) {
    set = readBundler((folder / "bundle.out").string());
  } else if (has("00000000.txt")) {
    set = readPmvs(folder.string());
  } else {
    return false;
  }
  return true;
}

}  // namespace

CameraSet readCameras(const std::string& path) {
  std::error_code error;
  CameraSet set;
  if (!fs::is_directory(path, error)) return readBundler(path);
  for (const char* below : {"", "sparse", "sparse/0", "txt"}) {
    if (readFolder(fs::path(path) / below, set)) return set;
  }
  throw Failure(BadInput, path, "holds no cameras",
                "name the folder of a COLMAP model (cameras, images), of bundle.out, or of PMVS's "
                "00000000.txt");
}

}  // namespace storey::io
