// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_records.h"

#include <storey/filters/detail/first_touch.h>

#include <algorithm>

#include "io/failure.h"
#include "io/scan.h"

namespace storey::io {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;  // of records: they stay in the cache
constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

std::size_t findField(const std::vector<PointField>& fields,
                      const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].name == name && fields[i].count == 1 && !fields[i].is_list) return i;
    }
  }
  return kMissing;
}

void addPosition(const std::vector<PointField>& fields, const InputFile& file,
                 PointColumns& columns) {
  for (const char* const name : {"x", "y", "z"}) {
    const std::size_t field = findField(fields, {name});
    if (field == kMissing) {
      file.fail(std::string("its points have no single number called ") + name,
                "write the cloud with the fields x, y and z");
    }
    columns.field.push_back(field);
    if (fields[field].type != fields[columns.field[0]].type) {
      file.fail("x, y and z are of different types", "write them all as float or all as double");
    }
  }
}

void addNormal(const std::vector<PointField>& fields, PointColumns& columns) {
  const std::size_t normal[3] = {findField(fields, {"normal_x", "nx"}),
                                 findField(fields, {"normal_y", "ny"}),
                                 findField(fields, {"normal_z", "nz"})};
  columns.has_normals = std::count(normal, normal + 3, kMissing) == 0;
  if (columns.has_normals) columns.field.insert(columns.field.end(), normal, normal + 3);
}

std::size_t recordBytes(const std::vector<PointField>& fields) {
  const PointField& last = fields.back();
  return last.offset + last.count * sizeOf(last.type);
}

}  // namespace

PointColumns findPointColumns(const std::vector<PointField>& fields, const InputFile& file,
                              const std::vector<std::string>& extras) {
  PointColumns columns;
  addPosition(fields, file, columns);
  addNormal(fields, columns);
  for (const std::string& name : extras) {
    const std::size_t field = findField(fields, {name});
    if (field == kMissing) continue;
    columns.field.push_back(field);
    columns.extra_names.push_back(name);
  }
  return columns;
}

void RawCloud::begin(std::uint64_t num_points, const PointColumns& columns,
                     const ReadLimits& limits) {
  declared = num_points;
  limitPoints(limits.max_points);
  take_part_ = limits.take_part;
  threads_ = limits.threads;
  has_normal_fields = columns.has_normals;
  const std::uint64_t at_once = std::min(num_points, room() + 1);
  positions.reserve(3 * at_once);
  if (has_normal_fields) normals.reserve(3 * at_once);
  for (const std::string& name : columns.extra_names) {
    extras.push_back({name, {}});
    extras.back().values.reserve(at_once);
  }
}

void RawCloud::fetchMemory() {
  storey::detail::touchReserve(threads_, positions);
  storey::detail::touchReserve(threads_, normals);
}

void RawCloud::add(const std::vector<double>& values) {
  positions.insert(positions.end(), values.begin(), values.begin() + 3);
  std::size_t next = 3;
  if (has_normal_fields) {
    for (; next < 6; ++next) normals.push_back(static_cast<float>(values[next]));
  }
  for (ExtraColumn& extra : extras) extra.values.push_back(values[next++]);
  settle(size() - 1);
}

void RawCloud::addRecords(const unsigned char* records, std::size_t record_bytes, std::size_t count,
                          const std::vector<PointField>& fields, bool big_endian) {
  const std::size_t first = size();
  const auto decode = [&](std::size_t field, auto* column, std::size_t each) {
    decodeColumn({records + fields[field].offset, record_bytes, count}, fields[field].type,
                 big_endian, column, each);
  };
  positions.resize(3 * (first + count));
  for (std::size_t axis = 0; axis < 3; ++axis) decode(axis, &positions[3 * first + axis], 3);
  std::size_t next = 3;
  if (has_normal_fields) {
    normals.resize(3 * (first + count));
    for (; next < 6; ++next) decode(next, &normals[3 * first + next - 3], 3);
  }
  for (ExtraColumn& extra : extras) {
    extra.values.resize(first + count);
    decode(next++, &extra.values[first], 1);
  }
  settle(first);
}

void checkPointCount(const InputFile& file, std::uint64_t num_points) {
  if (num_points == 0) file.fail("declares no points");
  if (num_points > kMaxPoints) {
    file.fail("declares " + std::to_string(num_points) + " points, the limit is " +
                  std::to_string(kMaxPoints),
              "cut the building out of the cloud");
  }
}

void checkPoints(const InputFile& file, std::uint64_t num_points, const ReadLimits& limits,
                 std::size_t num_extras) {
  checkPointCount(file, num_points);
  const std::uint64_t each = limits.bytes_per_point + sizeof(double) * num_extras;
  file.checkMemory(std::min(num_points, limits.max_points) * each, limits.max_memory,
                   std::to_string(num_points) + " points");
}

std::optional<std::string> noteOf(std::string_view comment) {
  constexpr std::string_view kOurs = "storey ";
  const std::size_t start = comment.find_first_not_of(" \t");
  if (start == std::string_view::npos || comment.substr(start, kOurs.size()) != kOurs) {
    return std::nullopt;
  }
  return std::string(comment.substr(start + kOurs.size()));
}

void readBinaryRecords(InputFile& file, const std::vector<PointField>& fields,
                       const PointColumns& columns, bool big_endian, RawCloud& raw) {
  const std::size_t record_bytes = recordBytes(fields);
  std::vector<PointField> wanted;
  for (const std::size_t field : columns.field) wanted.push_back(fields[field]);
  const std::uint64_t at_once = std::max<std::uint64_t>(kBlockBytes / record_bytes, 1);
  if (raw.declared <= file.remaining() / record_bytes) raw.fetchMemory();
  for (std::uint64_t i = 0, count = 0; i < raw.declared; i += count) {
    count = std::min({at_once, raw.declared - i, raw.room()});
    raw.addRecords(file.take(count * record_bytes), record_bytes, count, wanted, big_endian);
  }
}

void readAsciiRecords(InputFile& file, const std::vector<PointField>& fields,
                      const PointColumns& columns, RawCloud& raw) {
  const std::size_t num_values = fields.back().index + fields.back().count;
  std::vector<double> record(num_values);
  std::vector<double> values(columns.field.size());
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
    for (std::size_t c = 0; c < values.size(); ++c) {
      values[c] = record[fields[columns.field[c]].index];
    }
    raw.add(values);
  }
}

}  // namespace storey::io
