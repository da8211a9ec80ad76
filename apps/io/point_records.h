// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.h"
#include "io/limits.h"
#include "io/scalar.h"

namespace storey::io {

/// One field of a point as a header declares it.
struct PointField {
  std::string name;
  Scalar type = Scalar::Float32;
  std::size_t count = 1;   ///< numbers of this type
  std::size_t offset = 0;  ///< bytes from the start of the record
  std::size_t index = 0;   ///< of its first number among the numbers of the record
  bool is_list = false;    ///< PLY list: of no use for a point
};

/// Positions of the fields that are read of a point.
struct PointColumns {
  /// Into the fields: x, y, z, then normal_x, normal_y, normal_z if there are normals, then the
  /// fields that were asked for and are there.
  std::vector<std::size_t> field;
  bool has_normals = false;
  std::vector<std::string> extra_names;  ///< of the last of them
};

/// Finds x, y, z and, under the names `normal_x` or `nx` etc., the normal, and the fields called
/// `extras`. Fails if a coordinate is missing, a list or an array, or if the three differ in type.
/// An incomplete normal is none.
PointColumns findPointColumns(const std::vector<PointField>& fields, const InputFile& file,
                              const std::vector<std::string>& extras);

/// A further field of the points.
struct ExtraColumn {
  std::string name;
  std::vector<double> values;  ///< one a point
};

/// Which photos saw each point, where a file says so.
struct Viewers {
  std::vector<std::uint32_t> photos;  ///< of all points, one after the other
  std::vector<std::size_t> ends;      ///< for each point, where its photos end
};

struct ReadLimits;

/// Points as they are in the file, in double precision: all of them, or where that would be too
/// many a sample at random. A position belongs to it if a hash of its bits is below a limit, which
/// falls by an eighth each time that there are too many; where many are at one place, one counts.
/// So the sample depends on the set of points and the greatest number alone, not on their order,
/// and it is the same whether the points are thinned while they are read or afterwards.
struct RawCloud {
  std::vector<double> positions;    ///< 3 a point
  std::vector<float> normals;       ///< 3 a point, or none at all
  std::vector<ExtraColumn> extras;  ///< the fields that were asked for and are there
  std::vector<std::string> notes;   ///< comments of the header that are ours, see `noteOf`
  Viewers viewers;
  bool has_normal_fields = false;
  std::uint64_t declared = 0;
  std::string format;

  /// Makes ready for points of these columns.
  void begin(std::uint64_t num_points, const PointColumns& columns, const ReadLimits& limits);
  /// Fetches the memory of the points to come. Only where it is sure that they come.
  void fetchMemory();
  /// \param values parallel to the columns
  void add(const std::vector<double>& values);
  /// Some records of fixed size. \param fields parallel to the columns
  void addRecords(const unsigned char* records, std::size_t record_bytes, std::size_t count,
                  const std::vector<PointField>& fields, bool big_endian);
  std::uint64_t size() const { return positions.size() / 3; }

  /// How many points to add, at most, before `settle`.
  std::uint64_t room() const;
  /// To be called after some points, where they are thinned or handed on while they are read.
  /// Leaves no more than an eighth beyond the limit. \param first of the new ones
  void settle(std::size_t first);
  /// Leaves a sample of at most so many points, without their viewers.
  void thin(std::uint64_t max_points);
  /// What `settle` thins to, about.
  void limitPoints(std::uint64_t max_points) { max_points_ = max_points; }

 private:
  static constexpr std::uint64_t kAllKeys = ~std::uint64_t{0};

  void keepSample(std::size_t first);
  /// Whether two of some thousand points share a place: those of a cloud of a million do where one
  /// place has more than a thousandth of them, or where each point is there twice.
  bool hasCopies() const;
  /// Leaves one of the points at each place: that with the greatest normal.
  void dropCopies();
  void copyPoint(std::size_t from, std::size_t to);
  void cut(std::size_t num_points);

  std::uint64_t max_points_ = kMaxPoints;
  unsigned int threads_ = 1;
  std::function<void(const RawCloud&)> take_part_;
  std::uint64_t key_limit_ = kAllKeys;
};

/// Bytes of memory that reading takes for each point at its peak: raw position (24) and normal
/// (12), the finished point (48) and its part of the curve (2); and what the points of one part
/// take to be sorted (32 and the room that their lists grew out of), which are all points where an
/// outlier is so far away that the others share a part.
constexpr std::uint64_t kLoaderBytesPerPoint = 144;

/// What reading may take.
struct ReadLimits {
  std::uint64_t max_memory = defaultMaxMemory();         ///< bytes
  std::uint64_t max_points = kMaxPoints;                 ///< kept: more are thinned to so many
  std::uint64_t bytes_per_point = kLoaderBytesPerPoint;  ///< of those that are kept
  unsigned int threads = 1;                              ///< 0: all cores

  /// Instead of thinning: takes each `max_points` points on, in the order of the file, and only the
  /// last of them are left to be returned. For PLY and PCD.
  std::function<void(const RawCloud&)> take_part = {};

  /// For formats that are thinned only when they are read.
  ReadLimits wholeFile() const {
    ReadLimits whole;
    whole.max_memory = max_memory;
    whole.threads = threads;
    return whole;
  }
};

/// Fails if so many points cannot be.
void checkPointCount(const InputFile& file, std::uint64_t num_points);

/// Fails if so many points cannot be, or not with this memory. \param num_extras columns that were
/// asked for
void checkPoints(const InputFile& file, std::uint64_t num_points, const ReadLimits& limits,
                 std::size_t num_extras = 0);

/// What follows "storey " in a comment of a header; nothing if the comment is not ours.
/// \param comment without the sign that makes it one
std::optional<std::string> noteOf(std::string_view comment);

/// Reads `raw.declared` records of fixed size: the fields without gaps.
void readBinaryRecords(InputFile& file, const std::vector<PointField>& fields,
                       const PointColumns& columns, bool big_endian, RawCloud& raw);

/// Reads `raw.declared` lines with exactly the declared number of numbers each.
void readAsciiRecords(InputFile& file, const std::vector<PointField>& fields,
                      const PointColumns& columns, RawCloud& raw);

}  // namespace storey::io
