// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "io/cameras/camera_formats.h"
#include "io/failure.h"

namespace storey::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxMatrixBytes = 64u << 10;

// "CONTOUR", then three rows of four numbers.
Camera readCamera(const std::string& path) {
  InputFile file(path, kMaxMatrixBytes);
  std::string_view line;
  if (!file.nextBodyLine(line) || line.substr(0, 7) != "CONTOUR") {
    file.fail("does not begin with CONTOUR");
  }
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> projection;
  for (int row = 0; row < 3; ++row) {
    if (!file.nextBodyLine(line)) file.fail("ends within its matrix");
    parseNumbers(file, line, 4, projection.data() + 4 * row);
  }
  if (file.nextBodyLine(line)) file.failAtLine("is more than a 3 x 4 matrix");
  Camera camera;
  if (!setProjection(projection, camera)) file.fail("its matrix projects nothing");
  return camera;
}

bool isNumbered(const fs::path& path) {
  const std::string stem = path.stem().string();
  return path.extension() == ".txt" && stem.size() == 8 &&
         stem.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

CameraSet readPmvs(const std::string& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (isNumbered(entry.path())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  CameraSet set;
  set.format = "PMVS";
  for (const std::string& path : files) {
    Photo photo;
    photo.index = set.photos.size();
    photo.name = fs::path(path).stem().string();
    photo.camera = readCamera(path);
    set.photos.push_back(photo);
  }
  return set;
}

}  // namespace storey::io
