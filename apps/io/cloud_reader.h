// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>

#include "io/input_file.h"
#include "io/limits.h"
#include "io/point_records.h"

namespace storey::io {

/// Clouds with fewer distinct points than this are refused: they span no plane.
constexpr std::size_t kMinDistinctPoints = 3;

/// Share of the points that must have a finite normal of length > 0 for a cloud to count as one
/// with normals.
constexpr double kMinShareOfNormals = 0.99;

/// A cloud as every later stage may rely on it: finite, without duplicates, close to the origin.
struct LoadedCloud {
  /// Local coordinates (the file's less `offset`), along a Morton curve: neighbours are near each
  /// other in memory, and the order is that of the positions, not that of the file. All positions
  /// are finite and no two are equal; `is_dense` is true. Normals have length 1 or, where the file
  /// has none that can be used, 0. Without `has_normals` all are 0.
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud;
  /// Subtracted in double before the cast to float, so that `point + offset` is the file's
  /// coordinate. 0 on an axis where the coordinates are small already, else a multiple of a power
  /// of ten about as large as the cloud. Depends on the set of points, not on their order.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  bool has_normals = false;
  std::size_t declared = 0;              ///< points that the file declares, all of them read
  std::size_t thinned_out = 0;           ///< of them, for `ReadLimits::max_points`
  std::size_t dropped_non_finite = 0;    ///< NaN, infinite, or too far out for float distances
  std::size_t collapsed_duplicates = 0;  ///< further points at the place of another
  std::size_t zero_normals = 0;          ///< normals of the file that cannot be used
  std::size_t turned_normals = 0;        ///< to the photos that saw their points
  std::string format;                    ///< e.g. "ply binary_little_endian float64"
};

struct CloudReaderOptions {
  std::uint64_t max_bytes = kDefaultMaxFileBytes;  ///< largest file that is read, in bytes
  ReadLimits limits;
  unsigned int threads = 1;  ///< that read and order the points, 0: all cores
};

/// Reads a PCD (ascii, binary, binary_compressed) or PLY (ascii, binary of both byte orders) file,
/// LAS, the points of legacy VTK, PMVS's patches or lines of numbers (`import_formats.h`), told
/// apart by their content. Coordinates may be float, double or integers; normals are taken
/// from `normal_x ..` or `nx ..`; further fields, lists and elements are passed over. Where photos
/// are known that saw the points, the normals are turned to them (`turnToViewers`).
/// No number in the file is trusted: whatever is wrong ends in a `Failure` before memory is taken.
/// \throws Failure (BadInput, MissingInput, IoError)
LoadedCloud readCloud(const std::string& path, const CloudReaderOptions& options = {});

/// The second half of it: what the stages may rely on, of the points of a file.
/// \throws Failure (BadInput) where they are too few
LoadedCloud conditionCloud(RawCloud raw, const InputFile& file, unsigned int threads = 1);

/// The same for any number of points.
LoadedCloud conditionPoints(RawCloud raw, unsigned int threads = 1);

/// The points of a file about an offset, as those of a `LoadedCloud` are.
struct DistinctPoints {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud;
  std::size_t dropped_non_finite = 0;
  std::size_t collapsed_duplicates = 0;
};
DistinctPoints distinctPoints(const RawCloud& raw, const Eigen::Vector3d& offset,
                              unsigned int threads = 1);

}  // namespace storey::io
