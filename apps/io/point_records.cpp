// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_records.h"

#include <algorithm>
#include <initializer_list>

#include "io/failure.h"
#include "io/scan.h"

namespace storey::io {
namespace {

std::size_t findField(const std::vector<PointField>& fields,
                      std::initializer_list<const char*> names) {
  for (const char* name : names) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].name == name && fields[i].count == 1 && !fields[i].is_list) return i;
    }
  }
  return PointColumns::kMissing;
}

void checkPosition(const std::vector<PointField>& fields, const PointColumns& columns,
                   const InputFile& file) {
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (columns.field[axis] == PointColumns::kMissing) {
      file.fail(std::string("its points have no single number called ") + kNames[axis],
                "write the cloud with the fields x, y and z");
    }
    if (fields[columns.field[axis]].type != fields[columns.field[0]].type) {
      file.fail("x, y and z are of different types", "write them all as float or all as double");
    }
  }
}

std::size_t recordBytes(const std::vector<PointField>& fields) {
  const PointField& last = fields.back();
  return last.offset + last.count * sizeOf(last.type);
}

}  // namespace

PointColumns findPointColumns(const std::vector<PointField>& fields, const InputFile& file) {
  PointColumns columns;
  columns.field = {findField(fields, {"x"}),
                   findField(fields, {"y"}),
                   findField(fields, {"z"}),
                   findField(fields, {"normal_x", "nx"}),
                   findField(fields, {"normal_y", "ny"}),
                   findField(fields, {"normal_z", "nz"})};
  checkPosition(fields, columns, file);
  if (std::count(columns.field.begin() + 3, columns.field.end(), PointColumns::kMissing) > 0) {
    std::fill(columns.field.begin() + 3, columns.field.end(), PointColumns::kMissing);
  }
  return columns;
}

void RawCloud::reserve(std::uint64_t num_points) {
  positions.reserve(3 * num_points);
  if (has_normal_fields) normals.reserve(3 * num_points);
}

void RawCloud::add(const std::array<double, 6>& values) {
  positions.insert(positions.end(), values.begin(), values.begin() + 3);
  if (!has_normal_fields) return;
  for (std::size_t i = 3; i < 6; ++i) normals.push_back(static_cast<float>(values[i]));
}

void readBinaryRecords(InputFile& file, const std::vector<PointField>& fields,
                       const PointColumns& columns, bool big_endian, RawCloud& raw) {
  const std::size_t record_bytes = recordBytes(fields);
  const std::size_t num_columns = columns.hasNormals() ? 6 : 3;
  std::array<PointField, 6> wanted;
  for (std::size_t c = 0; c < num_columns; ++c) wanted[c] = fields[columns.field[c]];
  std::array<double, 6> values{};
  for (std::uint64_t i = 0; i < raw.declared; ++i) {
    const unsigned char* const record = file.take(record_bytes);
    for (std::size_t c = 0; c < num_columns; ++c) {
      values[c] = decodeScalar(record + wanted[c].offset, wanted[c].type, big_endian);
    }
    raw.add(values);
  }
}

void readAsciiRecords(InputFile& file, const std::vector<PointField>& fields,
                      const PointColumns& columns, RawCloud& raw) {
  const std::size_t num_values = fields.back().index + fields.back().count;
  std::vector<double> record(num_values);
  const std::size_t num_columns = columns.hasNormals() ? 6 : 3;
  std::array<double, 6> values{};
  std::string_view line;
  for (std::uint64_t i = 0; i < raw.declared; ++i) {
    if (!file.nextBodyLine(line)) {
      file.fail("ends after " + std::to_string(i) + " of " + std::to_string(raw.declared) +
                " points");
    }
    NumberScanner scanner(line);
    std::size_t got = 0;
    double value = 0.0;
    auto result = scanner.next(value);
    for (; result == NumberScanner::Result::Number; result = scanner.next(value)) {
      if (got == num_values) file.failAtLine("has more than " + std::to_string(got) + " numbers");
      record[got++] = value;
    }
    if (result == NumberScanner::Result::Malformed) {
      file.failAtLine("word " + std::to_string(got + 1) + " is not a number that can be used");
    }
    if (got < num_values) {
      file.failAtLine("has " + std::to_string(got) + " numbers, expected " +
                      std::to_string(num_values));
    }
    for (std::size_t c = 0; c < num_columns; ++c) {
      values[c] = record[fields[columns.field[c]].index];
    }
    raw.add(values);
  }
}

}  // namespace storey::io
