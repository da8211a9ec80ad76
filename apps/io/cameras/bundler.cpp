// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "io/cameras/camera_formats.h"
#include "io/failure.h"
#include "io/limits.h"
#include "io/scan.h"

// P = R X + t, p = -P / P.z, pixel = f (1 + k1 |p|^2 + k2 |p|^4) p, counted from the middle of
// the image, x to the right and y up: the camera looks along its -z.
namespace storey::io {
namespace {

std::string_view nextLine(InputFile& file, const char* within) {
  std::string_view line;
  if (!file.nextBodyLine(line)) file.fail(std::string("ends within ") + within);
  return line;
}

Eigen::Vector3d nextTriple(InputFile& file, const char* within) {
  Eigen::Vector3d v;
  parseNumbers(file, nextLine(file, within), 3, v.data());
  return v;
}

/// False if the photo was not registered.
bool readPhoto(InputFile& file, Photo& photo) {
  const Eigen::Vector3d lens = nextTriple(file, "the cameras");
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = nextTriple(file, "the cameras");
  const Eigen::Vector3d translation = nextTriple(file, "the cameras");
  if (lens[0] == 0.0) return false;
  const Eigen::Vector3d ahead(1.0, -1.0, -1.0);  // their camera's frame to ours
  photo.camera.focal.setConstant(lens[0]);
  photo.camera.lens = Lens::perspective({lens[1], lens[2], 0.0});
  photo.principal_from_middle = true;
  if (!(lens[0] > 0.0)) file.failAtLine("ends a camera whose focal length is negative");
  if (!setPose(ahead.asDiagonal() * rotation, ahead.cwiseProduct(translation), photo.camera)) {
    file.failAtLine("ends a camera whose rotation is none");
  }
  return true;
}

void readPoint(InputFile& file, CameraSet& set) {
  set.points.push_back(nextTriple(file, "the points"));
  nextTriple(file, "the points");  // colour
  const std::vector<std::string_view> views = splitWords(nextLine(file, "the points"));
  std::uint64_t count = 0;
  if (!parseUnsigned(views[0], count) || count > views.size() || views.size() != 1 + 4 * count) {
    file.failAtLine("is no list of views: COUNT, then CAMERA KEY X Y for each");
  }
}

/// The first words of the lines of list.txt; empty without such a file.
std::vector<std::string> readNames(const std::string& path) {
  std::vector<std::string> names;
  if (!std::filesystem::exists(path)) return names;
  InputFile file(path, kMaxCameraFileBytes);
  std::string_view line;
  while (file.nextBodyLine(line)) {
    names.emplace_back(splitWords(line)[0]);
    if (names.back().size() > kMaxNameBytes) file.failAtLine("is no name of a photo");
  }
  return names;
}

}  // namespace

CameraSet readBundler(const std::string& path) {
  InputFile file(path, kMaxCameraFileBytes);
  if (file.peek(13) != "# Bundle file") file.fail("is no Bundler file");
  file.nextHeaderLine();
  double counts[2];
  parseNumbers(file, nextLine(file, "its header"), 2, counts);
  constexpr double kLeastBytes = 6.0;  // of a point: "0 0 0\n0 0 0\n0\n" and more
  const auto most = static_cast<double>(file.remaining()) / kLeastBytes;
  if (!(counts[0] >= 0.0 && counts[0] <= most && counts[1] >= 0.0 && counts[1] <= most)) {
    file.failAtLine("declares more cameras or points than the file can hold");
  }
  const std::vector<std::string> names =
      readNames((std::filesystem::path(path).parent_path() / "list.txt").string());
  CameraSet set;
  set.format = "Bundler";
  for (std::size_t i = 0; i < static_cast<std::size_t>(counts[0]); ++i) {
    Photo photo;
    photo.index = i;
    if (i < names.size()) photo.name = names[i];
    if (readPhoto(file, photo)) set.photos.push_back(photo);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(counts[1]); ++i) readPoint(file, set);
  std::string_view rest;
  if (file.nextBodyLine(rest)) file.failAtLine("is more than the header declares");
  if (set.photos.empty()) file.fail("has no camera that was registered");
  return set;
}

}  // namespace storey::io
