// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/input_file.h"
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

/// Positions of the fields that make an oriented point.
struct PointColumns {
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);
  /// Into the fields, in the order x, y, z, normal_x, normal_y, normal_z.
  std::array<std::size_t, 6> field;

  bool hasNormals() const { return field[3] != kMissing; }
};

/// Finds x, y, z and, under the names `normal_x` or `nx` etc., the normal. Fails if a coordinate is
/// missing, a list or an array, or if the three differ in type. An incomplete normal is none.
PointColumns findPointColumns(const std::vector<PointField>& fields, const InputFile& file);

/// Points as they are in the file: double precision, nothing dropped.
struct RawCloud {
  std::vector<double> positions;  ///< 3 a point
  std::vector<float> normals;     ///< 3 a point, or none at all
  bool has_normal_fields = false;
  std::uint64_t declared = 0;
  std::string format;

  void reserve(std::uint64_t num_points);
  void add(const std::array<double, 6>& values);
  std::uint64_t size() const { return positions.size() / 3; }
};

/// Bytes of memory that reading takes for each point at its peak: raw position (24) and normal
/// (12), the finished point (48), and the table that finds duplicates (12 + 16).
constexpr std::uint64_t kLoaderBytesPerPoint = 112;

/// Reads `raw.declared` records of fixed size: the fields without gaps.
void readBinaryRecords(InputFile& file, const std::vector<PointField>& fields,
                       const PointColumns& columns, bool big_endian, RawCloud& raw);

/// Reads `raw.declared` lines with exactly the declared number of numbers each.
void readAsciiRecords(InputFile& file, const std::vector<PointField>& fields,
                      const PointColumns& columns, RawCloud& raw);

}  // namespace storey::io
