// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_of_sight.h"

#include <filesystem>
#include <optional>

#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/input_file.h"
#include "io/limits.h"
#include "io/scalar.h"

namespace storey::io {
namespace {

namespace fs = std::filesystem;

/// Reads COLMAP's list of the photos of each point: their number, then for each point how many, and
/// their places in the model, as little-endian integers.
void readVisibility(const std::string& path, std::uint64_t max_memory, RawCloud& raw) {
  InputFile file(path, kDefaultMaxFileBytes);
  const auto next = [&](Scalar type) {
    return static_cast<std::uint64_t>(decodeScalar(file.take(sizeOf(type)), type, false));
  };
  const char* const hint = "take it from the same run as the cloud, or away";
  const std::uint64_t num_points = next(Scalar::UInt64);
  if (num_points != raw.size()) {
    file.fail("is of " + std::to_string(num_points) + " points, the cloud has " +
                  std::to_string(raw.size()),
              hint);
  }
  file.checkMemory(file.size() + num_points * (kLoaderBytesPerPoint + 8), max_memory,
                   "the photos of its points");
  for (std::uint64_t i = 0; i < num_points; ++i) {
    const std::uint64_t count = next(Scalar::UInt32);
    if (count > file.remaining() / sizeOf(Scalar::UInt32)) {
      file.failAtByte("announces " + std::to_string(count) + " photos, more than the file holds");
    }
    for (std::uint64_t k = 0; k < count; ++k) {
      raw.viewers.photos.push_back(static_cast<std::uint32_t>(next(Scalar::UInt32)));
    }
    raw.viewers.ends.push_back(raw.viewers.photos.size());
  }
  if (file.remaining() > 0) file.failAtByte("goes on after its last point", hint);
}

/// The cameras around a cloud, if there are any.
std::optional<CameraSet> findCameras(const fs::path& cloud, bool patches) {
  const fs::path folder = cloud.parent_path();
  const fs::path root = patches ? folder / ".." : folder;
  std::error_code ignored;
  for (const char* mark : {"cameras.bin", "cameras.txt", "sparse/cameras.bin", "sparse/cameras.txt",
                           "txt/00000000.txt"}) {
    if (fs::exists(root / mark, ignored)) return readCameras(root.empty() ? "." : root.string());
  }
  return std::nullopt;
}

/// By the place in the file that the cloud counts photos by; those without a camera are none.
std::vector<std::optional<Eigen::Vector3d>> centresOf(const CameraSet& cameras) {
  std::vector<std::optional<Eigen::Vector3d>> centres;
  for (const Photo& photo : cameras.photos) {
    if (photo.index >= centres.size()) centres.resize(photo.index + 1);
    centres[photo.index] = photo.camera.center();
  }
  return centres;
}

}  // namespace

bool hasVisibility(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path + ".vis", ignored);
}

std::size_t turnToViewers(const std::string& path, std::uint64_t max_memory, RawCloud& raw) {
  const bool patches = !raw.viewers.ends.empty();
  if (!raw.has_normal_fields || (!patches && !hasVisibility(path))) return 0;
  const std::optional<CameraSet> cameras = findCameras(path, patches);
  if (!cameras) return 0;
  if (!patches) readVisibility(path + ".vis", max_memory, raw);
  const auto centres = centresOf(*cameras);
  std::size_t num_turned = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> position(&raw.positions[3 * i]);
    Eigen::Map<Eigen::Vector3f> normal(&raw.normals[3 * i]);
    int before = 0;
    for (; next < raw.viewers.ends[i]; ++next) {
      const std::uint32_t photo = raw.viewers.photos[next];
      if (photo >= centres.size()) {
        throw Failure(BadInput, path,
                      "point " + std::to_string(i) + " was seen by photo " + std::to_string(photo) +
                          ", counted from 0, of " + std::to_string(centres.size()),
                      "take the cameras of the same run");
      }
      if (!centres[photo]) continue;
      before += (*centres[photo] - position).dot(normal.cast<double>()) < 0.0 ? -1 : 1;
    }
    if (before >= 0) continue;
    normal *= -1.0f;
    ++num_turned;
  }
  return num_turned;
}

}  // namespace storey::io
