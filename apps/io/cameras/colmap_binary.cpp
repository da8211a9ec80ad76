// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <filesystem>
#include <map>

#include "io/cameras/camera_formats.h"

// Little-endian, as the host.
namespace storey::io {
namespace {

using Intrinsics = std::map<std::uint32_t, Camera>;

template <typename T>
T take(InputFile& file) {
  T value;
  std::memcpy(&value, file.take(sizeof(T)), sizeof(T));
  return value;
}

template <typename Vector>
Vector takeVector(InputFile& file) {
  Vector v;
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = take<double>(file);
  if (!v.allFinite()) file.failAtByte("a number is not finite");
  return v;
}

std::uint64_t takeCount(InputFile& file, std::uint64_t bytes_of_each, const char* what) {
  const auto count = take<std::uint64_t>(file);
  if (count > file.remaining() / bytes_of_each) {
    file.failAtByte("is too short for the " + std::to_string(count) + " " + what +
                    " that it declares");
  }
  return count;
}

Intrinsics readIntrinsics(const std::string& path) {
  InputFile file(path, kMaxCameraFileBytes);
  constexpr std::uint64_t kLeastBytes = 4 + 4 + 8 + 8 + 3 * 8;
  const std::uint64_t count = takeCount(file, kLeastBytes, "cameras");
  Intrinsics cameras;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = take<std::uint32_t>(file);
    const auto model = take<std::int32_t>(file);
    const auto width = take<std::uint64_t>(file);
    const auto height = take<std::uint64_t>(file);
    if (colmapParameters(model) == 0) {
      file.failAtByte(std::to_string(model) + " is no camera model known",
                      "undistort the photos with COLMAP first");
    }
    if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide) {
      file.failAtByte("an image size is out of its range");
    }
    std::vector<double> parameters(colmapParameters(model));
    for (double& parameter : parameters) parameter = take<double>(file);
    Camera camera;
    camera.width = static_cast<int>(width);
    camera.height = static_cast<int>(height);
    if (!setColmapIntrinsics(model, parameters.data(), camera)) {
      file.failAtByte("a camera parameter is out of its range");
    }
    if (!cameras.emplace(id, camera).second) file.failAtByte("two cameras have the same id");
  }
  file.expectEnd();
  return cameras;
}

std::string takeName(InputFile& file) {
  std::string name;
  for (char c; (c = take<char>(file)) != '\0';) {
    if (name.size() == kMaxNameBytes) file.failAtByte("an image's name is too long");
    name += c;
  }
  return name;
}

Photo takePhoto(InputFile& file, const Intrinsics& cameras) {
  take<std::uint32_t>(file);  // id
  const auto q = takeVector<Eigen::Vector4d>(file);
  const auto translation = takeVector<Eigen::Vector3d>(file);
  const auto found = cameras.find(take<std::uint32_t>(file));
  if (found == cameras.end()) file.failAtByte("an image's camera is not in the file of cameras");
  Photo photo;
  photo.camera = found->second;
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (!(rotation.norm() > 0.0) ||
      !setPose(rotation.normalized().matrix(), translation, photo.camera)) {
    file.failAtByte("an image's rotation is none");
  }
  photo.name = takeName(file);
  constexpr std::uint64_t kPointBytes = 8 + 8 + 8;  // x, y, id of the 3D point: not needed
  file.skip(kPointBytes * takeCount(file, kPointBytes, "image points"));
  return photo;
}

std::vector<Eigen::Vector3d> readPoints(const std::string& path) {
  std::vector<Eigen::Vector3d> points;
  if (!std::filesystem::exists(path)) return points;
  InputFile file(path, kMaxCameraFileBytes);
  constexpr std::uint64_t kLeastBytes = 8 + 3 * 8 + 3 + 8 + 8;
  const std::uint64_t count = takeCount(file, kLeastBytes, "points");
  for (std::uint64_t i = 0; i < count; ++i) {
    file.skip(8);  // id
    points.push_back(takeVector<Eigen::Vector3d>(file));
    file.skip(3 + 8);  // colour, error
    file.skip(8 * takeCount(file, 8, "track entries"));
  }
  file.expectEnd();
  return points;
}

}  // namespace

CameraSet readColmapBinary(const std::string& folder) {
  const Intrinsics cameras = readIntrinsics(folder + "/cameras.bin");
  CameraSet set;
  set.format = "COLMAP binary";
  InputFile file(folder + "/images.bin", kMaxCameraFileBytes);
  constexpr std::uint64_t kLeastBytes = 4 + 7 * 8 + 4 + 1 + 8;
  const std::uint64_t count = takeCount(file, kLeastBytes, "images");
  for (std::uint64_t i = 0; i < count; ++i) {
    set.photos.push_back(takePhoto(file, cameras));
    set.photos.back().index = i;
  }
  file.expectEnd();
  if (set.photos.empty()) file.fail("has no images");
  set.points = readPoints(folder + "/points3D.bin");
  return set;
}

}  // namespace storey::io
