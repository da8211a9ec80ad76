// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_reader.h"

#include <storey/filters/detail/distinct_positions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/cloud_offset.h"
#include "io/failure.h"
#include "io/input_file.h"
#include "io/line_of_sight.h"
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

/// In local coordinates; NaN for what is too far out.
std::vector<Eigen::Vector3f> localPositions(const RawCloud& raw, const Eigen::Vector3d& offset) {
  std::vector<Eigen::Vector3f> positions(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Eigen::Vector3d local = Eigen::Map<const Eigen::Vector3d>(&raw.positions[3 * i]) - offset;
    positions[i] = local.cwiseAbs().maxCoeff() < kMaxLocalCoordinate
                       ? Eigen::Vector3f(local.cast<float>() + Eigen::Vector3f::Zero())  // -0: 0
                       : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  }
  return positions;
}

/// The distinct positions in their order, and which of them each point is at.
std::vector<pcl::index_t> addPositions(const RawCloud& raw, unsigned int threads,
                                       LoadedCloud& loaded) {
  storey::detail::DistinctPositions distinct =
      storey::detail::findDistinctPositions(localPositions(raw, loaded.offset), threads);
  distinct.multiplicity = {};  // the points need the memory
  loaded.cloud->points.reserve(distinct.cloud->size());
  for (const pcl::PointXYZ& p : *distinct.cloud) loaded.cloud->points.emplace_back(p.x, p.y, p.z);
  return std::move(distinct.id_of_input);
}

void addPoints(const RawCloud& raw, unsigned int threads, LoadedCloud& loaded) {
  const std::vector<pcl::index_t> place = addPositions(raw, threads, loaded);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const pcl::index_t soon = place[std::min(i + kAhead, place.size() - 1)];
    if (soon >= 0) __builtin_prefetch(&loaded.cloud->points[static_cast<std::size_t>(soon)], 1);
    if (place[i] < 0) {
      ++loaded.dropped_non_finite;
    } else if (raw.has_normal_fields) {
      mergeNormal(unitNormal(raw, i), loaded.cloud->points[static_cast<std::size_t>(place[i])]);
    }
  }
  loaded.collapsed_duplicates = place.size() - loaded.dropped_non_finite - loaded.cloud->size();
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
  LoadedCloud loaded = conditionCloud(raw, file, options.threads);
  loaded.turned_normals = turned;
  return loaded;
}

LoadedCloud conditionCloud(const RawCloud& raw, const InputFile& file, unsigned int threads) {
  LoadedCloud loaded = conditionPoints(raw, threads);
  if (loaded.cloud->size() < kMinDistinctPoints) {
    file.fail("has " + std::to_string(loaded.cloud->size()) + " distinct finite points of " +
                  std::to_string(raw.declared) + ", at least " +
                  std::to_string(kMinDistinctPoints) + " are needed",
              "check the export of the cloud");
  }
  return loaded;
}

LoadedCloud conditionPoints(const RawCloud& raw, unsigned int threads) {
  LoadedCloud loaded;
  loaded.cloud.reset(new pcl::PointCloud<pcl::PointNormal>);
  loaded.format = raw.format;
  loaded.declared = raw.declared;
  loaded.thinned_out = raw.declared - raw.size();
  loaded.offset = chooseOffset(raw.positions);
  addPoints(raw, threads, loaded);
  loaded.cloud->width = static_cast<std::uint32_t>(loaded.cloud->points.size());
  loaded.cloud->height = 1;
  loaded.cloud->is_dense = true;
  judgeNormals(raw, loaded);
  return loaded;
}

}  // namespace storey::io
