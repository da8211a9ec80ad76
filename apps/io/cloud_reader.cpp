// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_reader.h"

#include <array>
#include <cmath>
#include <optional>

#include "io/cloud_offset.h"
#include "io/failure.h"
#include "io/input_file.h"
#include "io/line_of_sight.h"
#include "io/point_index.h"
#include "io/raw_cloud.h"

namespace storey::io {
namespace {

// The square of a distance between points closer to the origin than this fits into a float.
constexpr double kMaxLocalCoordinate = 1e18;
constexpr std::size_t kAhead = 16;  // points: time for memory to answer

std::array<float, 3> unitNormal(const RawCloud& raw, std::size_t i) {
  if (!raw.has_normal_fields) return {0.0f, 0.0f, 0.0f};
  const Eigen::Vector3d normal =
      Eigen::Map<const Eigen::Vector3f>(&raw.normals[3 * i]).cast<double>();
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {0.0f, 0.0f, 0.0f};
  const Eigen::Vector3f unit = (normal / length).cast<float>();
  return {unit.x(), unit.y(), unit.z()};
}

/// Of several normals at one place the greatest one stays: a choice that does not depend on the
/// order of the points and prefers any normal to none.
void mergeNormal(const std::array<float, 3>& normal, pcl::PointNormal& point) {
  const std::array<float, 3> old = {point.normal_x, point.normal_y, point.normal_z};
  constexpr std::array<float, 3> kNone = {0.0f, 0.0f, 0.0f};
  if (normal == kNone || (old != kNone && !(old < normal))) return;
  point.normal_x = normal[0];
  point.normal_y = normal[1];
  point.normal_z = normal[2];
}

/// The position in local coordinates; nothing if they are too far out.
std::optional<PointIndex::Position> localPosition(const RawCloud& raw, std::size_t i,
                                                  const Eigen::Vector3d& offset) {
  const Eigen::Vector3d local = Eigen::Map<const Eigen::Vector3d>(&raw.positions[3 * i]) - offset;
  if (!(local.cwiseAbs().maxCoeff() < kMaxLocalCoordinate)) return std::nullopt;
  const Eigen::Vector3f position = local.cast<float>() + Eigen::Vector3f::Zero();  // -0 becomes 0
  return PointIndex::Position{position.x(), position.y(), position.z()};
}

void addPoint(const RawCloud& raw, std::size_t i, const PointIndex::Position& position,
              PointIndex& index, LoadedCloud& loaded) {
  const std::array<float, 3> normal = unitNormal(raw, i);
  const std::uint32_t known = index.findOrAdd(position);
  if (known < loaded.cloud->size()) {
    ++loaded.collapsed_duplicates;
    mergeNormal(normal, (*loaded.cloud)[known]);
    return;
  }
  loaded.cloud->points.emplace_back(position[0], position[1], position[2], normal[0], normal[1],
                                    normal[2]);
}

void addPoints(const RawCloud& raw, LoadedCloud& loaded) {
  PointIndex index(raw.size());
  std::array<std::optional<PointIndex::Position>, kAhead> ahead;
  for (std::size_t i = 0; i < raw.size() + kAhead; ++i) {
    std::optional<PointIndex::Position>& position = ahead[i % kAhead];
    if (i >= kAhead) {
      if (position) {
        addPoint(raw, i - kAhead, *position, index, loaded);
      } else {
        ++loaded.dropped_non_finite;
      }
    }
    if (i >= raw.size()) continue;
    position = localPosition(raw, i, loaded.offset);
    if (position) index.prefetch(*position);
  }
}

void judgeNormals(const RawCloud& raw, LoadedCloud& loaded) {
  if (!raw.has_normal_fields) return;
  for (const pcl::PointNormal& point : *loaded.cloud) {
    if (point.getNormalVector3fMap().isZero(0.0f)) ++loaded.zero_normals;
  }
  const auto size = static_cast<double>(loaded.cloud->size());
  const double usable = size - static_cast<double>(loaded.zero_normals);
  loaded.has_normals = usable >= kMinShareOfNormals * size;
  if (loaded.has_normals) return;
  for (pcl::PointNormal& point : *loaded.cloud) point.getNormalVector3fMap().setZero();
}

}  // namespace

LoadedCloud readCloud(const std::string& path, const CloudReaderOptions& options) {
  InputFile file(path, options.max_bytes);
  const ReadLimits& limits = options.limits;
  RawCloud raw = readRawCloud(file, hasVisibility(path) ? limits.wholeFile() : limits);
  const std::size_t turned = turnToViewers(path, limits.max_memory, raw);
  raw.thin(limits.max_points);
  file.checkMemory(raw.size() * limits.bytes_per_point, limits.max_memory,
                   std::to_string(raw.size()) + " points");
  LoadedCloud loaded = conditionCloud(raw, file);
  loaded.turned_normals = turned;
  return loaded;
}

LoadedCloud conditionCloud(const RawCloud& raw, const InputFile& file) {
  LoadedCloud loaded;
  loaded.cloud.reset(new pcl::PointCloud<pcl::PointNormal>);
  loaded.format = raw.format;
  loaded.declared = raw.declared;
  loaded.thinned_out = raw.declared - raw.size();
  loaded.offset = chooseOffset(raw.positions);
  loaded.cloud->points.reserve(raw.size());
  addPoints(raw, loaded);
  loaded.cloud->width = static_cast<std::uint32_t>(loaded.cloud->points.size());
  loaded.cloud->height = 1;
  loaded.cloud->is_dense = true;
  if (loaded.cloud->size() < kMinDistinctPoints) {
    file.fail("has " + std::to_string(loaded.cloud->size()) + " distinct finite points of " +
                  std::to_string(raw.declared) + ", at least " +
                  std::to_string(kMinDistinctPoints) + " are needed",
              "check the export of the cloud");
  }
  judgeNormals(raw, loaded);
  return loaded;
}

}  // namespace storey::io
