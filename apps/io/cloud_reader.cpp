// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_reader.h"

#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/curve_sorting.h>

#include <algorithm>
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

/// The points of a file in local coordinates.
class LocalPoints {
 public:
  using Record = pcl::PointNormal;

  LocalPoints(const RawCloud& raw, const Eigen::Vector3d& offset) : raw_(raw), offset_(offset) {}

  std::size_t size() const { return raw_.size(); }

  /// NaN for what is too far out.
  Eigen::Vector3f position(std::size_t i) const {
    const Eigen::Vector3d local =
        Eigen::Map<const Eigen::Vector3d>(&raw_.positions[3 * i]) - offset_;
    if (!(local.cwiseAbs().maxCoeff() < kMaxLocalCoordinate)) {
      return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
    }
    return local.cast<float>() + Eigen::Vector3f::Zero();  // -0: 0
  }

  Record record(std::size_t i) const {
    const Eigen::Vector3f p = position(i);
    const Eigen::Vector3f n = unitNormal(i);
    return {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()};
  }

  static Eigen::Vector3f positionOf(const Record& point) { return point.getVector3fMap(); }

 private:
  /// 0 where it is of no use.
  Eigen::Vector3f unitNormal(std::size_t i) const {
    if (!raw_.has_normal_fields) return Eigen::Vector3f::Zero();
    const Eigen::Vector3d normal =
        Eigen::Map<const Eigen::Vector3f>(&raw_.normals[3 * i]).cast<double>();
    const double length = normal.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return Eigen::Vector3f::Zero();
    return (normal / length).cast<float>();
  }

  const RawCloud& raw_;
  const Eigen::Vector3d& offset_;
};

/// Of several normals at one place the greatest one stays: a choice that does not depend on the
/// order of the points and prefers any normal to none.
void mergeNormal(const pcl::PointNormal& other, pcl::PointNormal& point) {
  const auto normal = other.getNormalVector3fMap();
  auto kept = point.getNormalVector3fMap();
  const bool is_greater =
      std::lexicographical_compare(kept.data(), kept.data() + 3, normal.data(), normal.data() + 3);
  if (!normal.isZero(0.0f) && (kept.isZero(0.0f) || is_greater)) kept = normal;
}

/// Leaves one point at each place, of a cloud in which those at one place follow each other.
void mergeDuplicates(pcl::PointCloud<pcl::PointNormal>& cloud) {
  std::size_t last = 0;
  for (std::size_t i = 1; i < cloud.size(); ++i) {
    if (cloud[i].getVector3fMap() == cloud[last].getVector3fMap()) {
      mergeNormal(cloud[i], cloud[last]);
    } else if (++last != i) {
      cloud[last] = cloud[i];
    }
  }
  cloud.resize(std::min(last + 1, cloud.size()));
}

void judgeNormals(LoadedCloud& loaded, unsigned int threads) {
  const pcl::PointCloud<pcl::PointNormal>& cloud = *loaded.cloud;
  loaded.zero_normals = storey::detail::sumByChunks(
      cloud.size(), threads, std::vector<std::size_t>(1),
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& zeros) {
        for (std::size_t i = begin; i < end; ++i) {
          if (cloud[i].getNormalVector3fMap().isZero(0.0f)) ++zeros[0];
        }
      })[0];
  const auto size = static_cast<double>(loaded.cloud->size());
  const double usable = size - static_cast<double>(loaded.zero_normals);
  loaded.has_normals = usable >= kMinShareOfNormals * size;
  if (loaded.has_normals) return;
  for (pcl::PointNormal& point : *loaded.cloud) point.getNormalVector3fMap().setZero();
}

}  // namespace

LoadedCloud readCloud(const std::string& path, const CloudReaderOptions& options) {
  InputFile file(path, options.max_bytes);
  ReadLimits limits = options.limits;
  limits.threads = options.threads;
  RawCloud raw = readRawCloud(file, hasVisibility(path) ? limits.wholeFile() : limits);
  const std::size_t turned = turnToViewers(path, limits.max_memory, raw);
  raw.thin(limits.max_points);
  file.checkMemory(raw.size() * limits.bytes_per_point, limits.max_memory,
                   std::to_string(raw.size()) + " points");
  LoadedCloud loaded = conditionCloud(std::move(raw), file, options.threads);
  loaded.turned_normals = turned;
  return loaded;
}

LoadedCloud conditionCloud(RawCloud raw, const InputFile& file, unsigned int threads) {
  LoadedCloud loaded = conditionPoints(std::move(raw), threads);
  if (loaded.cloud->size() < kMinDistinctPoints) {
    file.fail("has " + std::to_string(loaded.cloud->size()) + " distinct finite points of " +
                  std::to_string(loaded.declared) + ", at least " +
                  std::to_string(kMinDistinctPoints) + " are needed",
              loaded.thinned_out > 0 ? "keep more of them" : "check the export of the cloud");
  }
  return loaded;
}

DistinctPoints distinctPoints(const RawCloud& raw, const Eigen::Vector3d& offset,
                              unsigned int threads) {
  DistinctPoints points;
  points.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  pcl::PointCloud<pcl::PointNormal>& cloud = *points.cloud;
  const std::size_t num_distinct =
      storey::detail::sortAlongCurve(LocalPoints(raw, offset), threads, cloud.points);
  points.dropped_non_finite = raw.size() - cloud.points.size();
  points.collapsed_duplicates = cloud.points.size() - num_distinct;
  if (points.collapsed_duplicates > 0) mergeDuplicates(cloud);
  cloud.width = static_cast<std::uint32_t>(num_distinct);
  cloud.height = 1;
  return points;
}

LoadedCloud conditionPoints(RawCloud raw, unsigned int threads) {
  LoadedCloud loaded;
  loaded.format = raw.format;
  loaded.declared = raw.declared;
  loaded.thinned_out = raw.declared - raw.size();
  loaded.offset = chooseOffset(raw.positions, threads);
  const DistinctPoints points = distinctPoints(raw, loaded.offset, threads);
  const bool may_have_normals = raw.has_normal_fields;
  raw = RawCloud();
  loaded.cloud = points.cloud;
  loaded.dropped_non_finite = points.dropped_non_finite;
  loaded.collapsed_duplicates = points.collapsed_duplicates;
  if (may_have_normals) judgeNormals(loaded, threads);
  return loaded;
}

}  // namespace storey::io
