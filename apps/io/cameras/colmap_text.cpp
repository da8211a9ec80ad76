// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <map>

#include "io/cameras/camera_formats.h"
#include "io/failure.h"
#include "io/limits.h"
#include "io/scan.h"

namespace storey::io {
namespace {

using Intrinsics = std::map<std::uint64_t, Camera>;

bool isComment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '#';
}

bool nextRecord(InputFile& file, std::string_view& line) {
  while (file.nextBodyLine(line)) {
    if (!isComment(line)) return true;
  }
  return false;
}

// CAMERA_ID MODEL WIDTH HEIGHT PARAMS...
Intrinsics readIntrinsics(const std::string& path) {
  InputFile file(path, kMaxCameraFileBytes);
  Intrinsics cameras;
  std::string_view line;
  while (nextRecord(file, line)) {
    const std::vector<std::string_view> words = splitWords(line);
    std::uint64_t id = 0;
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    const int model = words.size() < 4 ? -1 : colmapModel(words[1]);
    if (words.size() < 4 || !parseUnsigned(words[0], id) || !parseUnsigned(words[2], width) ||
        !parseUnsigned(words[3], height) || width == 0 || height == 0 || width > kMaxImageSide ||
        height > kMaxImageSide) {
      file.failAtLine("is no camera: CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
    }
    if (model < 0) {
      file.failAtLine("'" + printable(std::string(words[1]), 40) + "' is no camera model known",
                      "undistort the photos with COLMAP first");
    }
    std::vector<double> parameters(colmapParameters(model));
    const auto* const start = words[3].data() + words[3].size();
    parseNumbers(file, line.substr(static_cast<std::size_t>(start - line.data())),
                 parameters.size(), parameters.data());
    Camera camera;
    camera.width = static_cast<int>(width);
    camera.height = static_cast<int>(height);
    if (!setColmapIntrinsics(model, parameters.data(), camera)) {
      file.failAtLine("a parameter is out of its range");
    }
    if (!cameras.emplace(id, camera).second) file.failAtLine("a camera with this id came before");
  }
  return cameras;
}

// The second line of an image: X Y POINT3D_ID ... It may be blank; what it holds is not needed,
// but that it is there: without it, every second image would be lost.
void skipPoints(InputFile& file) {
  std::string_view line;
  if (!file.nextLine(line, kMaxBodyLineBytes)) return;
  NumberScanner scanner(line);
  double number = 0.0;
  std::size_t count = 0;
  NumberScanner::Result result;
  while ((result = scanner.next(number)) == NumberScanner::Result::Number) ++count;
  if (result == NumberScanner::Result::Malformed || count % 3 != 0) {
    file.failAtLine("is no list of image points: X Y POINT3D_ID ...",
                    "each image has two lines, the second may be blank");
  }
}

// IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, the name being the rest of the line.
Photo parsePhoto(const InputFile& file, std::string_view line, const Intrinsics& cameras) {
  constexpr std::size_t kNumNumbers = 9;
  const std::vector<std::string_view> words = splitWords(line);
  if (words.size() <= kNumNumbers) {
    file.failAtLine("is no image: IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
  }
  const auto name_at = static_cast<std::size_t>(words[kNumNumbers].data() - line.data());
  double n[kNumNumbers];
  parseNumbers(file, line.substr(0, name_at), kNumNumbers, n);
  std::uint64_t camera_id = 0;
  const bool valid_id = parseUnsigned(words[kNumNumbers - 1], camera_id);
  const auto found = cameras.find(camera_id);
  if (!valid_id || found == cameras.end()) {
    file.failAtLine("its camera '" + printable(std::string(words[kNumNumbers - 1]), 40) +
                    "' is not in the file of cameras");
  }
  Photo photo;
  photo.camera = found->second;
  const Eigen::Quaterniond rotation(n[1], n[2], n[3], n[4]);
  if (!(rotation.norm() > 0.0) ||
      !setPose(rotation.normalized().matrix(), {n[5], n[6], n[7]}, photo.camera)) {
    file.failAtLine("its rotation is none");
  }
  photo.name = std::string(line.substr(name_at, line.find_last_not_of(" \t\r") + 1 - name_at));
  if (photo.name.size() > kMaxNameBytes) file.failAtLine("its name is too long");
  return photo;
}

// POINT3D_ID X Y Z R G B ERROR TRACK...
std::vector<Eigen::Vector3d> readPoints(const std::string& path) {
  std::vector<Eigen::Vector3d> points;
  if (!std::filesystem::exists(path) || std::filesystem::file_size(path) == 0) return points;
  InputFile file(path, kMaxCameraFileBytes);
  std::string_view line;
  while (nextRecord(file, line)) {
    NumberScanner scanner(line);
    double id = 0.0;
    Eigen::Vector3d p;
    bool valid = scanner.next(id) == NumberScanner::Result::Number;
    for (int i = 0; i < 3; ++i) valid &= scanner.next(p[i]) == NumberScanner::Result::Number;
    if (!valid || !p.allFinite()) file.failAtLine("is no point: POINT3D_ID X Y Z R G B ERROR");
    points.push_back(p);
  }
  return points;
}

}  // namespace

CameraSet readColmapText(const std::string& folder) {
  const Intrinsics cameras = readIntrinsics(folder + "/cameras.txt");
  CameraSet set;
  set.format = "COLMAP text";
  InputFile file(folder + "/images.txt", kMaxCameraFileBytes);
  std::string_view line;
  while (nextRecord(file, line)) {
    set.photos.push_back(parsePhoto(file, line, cameras));
    set.photos.back().index = set.photos.size() - 1;
    skipPoints(file);
  }
  if (set.photos.empty()) file.fail("has no images");
  set.points = readPoints(folder + "/points3D.txt");
  return set;
}

}  // namespace storey::io
