// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "io/formats/import_formats.h"
#include "io/limits.h"
#include "io/scalar.h"

namespace storey::io {
namespace {

// Places in the header, in bytes ["LAS Specification 1.4 - R15", ASPRS 2019].
constexpr std::size_t kVersion = 24;  // major, minor
constexpr std::size_t kHeaderSize = 94;
constexpr std::size_t kPointOffset = 96;
constexpr std::size_t kPointFormat = 104;
constexpr std::size_t kRecordBytes = 105;
constexpr std::size_t kLegacyCount = 107;
constexpr std::size_t kScale = 131;
constexpr std::size_t kOffset = 155;
constexpr std::size_t kCount = 247;  // from 1.4 on

constexpr std::size_t kOldHeaderBytes = 227;
constexpr std::size_t kNewHeaderBytes = 375;  // from 1.4 on
constexpr unsigned kCompressed = 0x80;        // of the point format: LAZ
constexpr unsigned kMaxFormat = 10;
constexpr std::size_t kLeastRecordBytes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

class LasHeader {
 public:
  LasHeader(InputFile& file, const unsigned char* bytes) : file_(file), bytes_(bytes) {}

  std::uint64_t whole(std::size_t at, Scalar type) const {
    return static_cast<std::uint64_t>(decodeScalar(bytes_ + at, type, false));
  }
  double real(std::size_t at) const { return decodeScalar(bytes_ + at, Scalar::Float64, false); }

  unsigned minorVersion() const { return bytes_[kVersion + 1]; }
  unsigned format() const { return bytes_[kPointFormat] & 0x3fu; }

  void check() const {
    if (bytes_[kVersion] != 1 || minorVersion() > 4) {
      file_.fail("is LAS " + std::to_string(bytes_[kVersion]) + "." +
                     std::to_string(minorVersion()) + ", expected 1.0 to 1.4",
                 "convert it to LAS 1.4");
    }
    if ((bytes_[kPointFormat] & kCompressed) != 0) {
      file_.fail("is compressed (LAZ)",
                 "unpack it first: laszip -i cloud.laz -o cloud.las, or pdal translate");
    }
    if (format() > kMaxFormat) {
      file_.fail("has points of format " + std::to_string(format()) + ", expected 0 to 10",
                 "convert it to LAS 1.4");
    }
    if (whole(kRecordBytes, Scalar::UInt16) < kLeastRecordBytes[format()]) {
      file_.fail("its points are too short for their format");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scale = real(kScale + 8 * axis);
      if (!(scale > 0.0) || !std::isfinite(scale) || !std::isfinite(real(kOffset + 8 * axis))) {
        file_.fail("its scale is not positive, or its offset not finite");
      }
    }
  }

  std::uint64_t numPoints() const {
    const std::uint64_t legacy = whole(kLegacyCount, Scalar::UInt32);
    if (minorVersion() < 4) return legacy;
    std::uint64_t count = 0;
    std::memcpy(&count, bytes_ + kCount, sizeof count);  // all its 64 bits, which no double holds
    return count > 0 ? count : legacy;
  }

 private:
  InputFile& file_;
  const unsigned char* bytes_;
};

std::vector<PointField> fieldsOf(std::size_t record_bytes) {
  std::vector<PointField> fields(4);
  const char* const names[] = {"x", "y", "z", "_"};
  for (std::size_t i = 0; i < 4; ++i) {
    fields[i].name = names[i];
    fields[i].type = Scalar::Int32;
    fields[i].offset = sizeOf(Scalar::Int32) * i;
    fields[i].index = i;
  }
  fields[3].type = Scalar::UInt8;
  fields[3].count = record_bytes - fields[3].offset;
  return fields;
}

}  // namespace

RawCloud readLas(InputFile& file, const ReadLimits& limits) {
  const std::string start(file.peek(kOldHeaderBytes));  // a copy: the next look may move it
  if (start.size() < kOldHeaderBytes) file.fail("ends within its header");
  const bool wide = start[kVersion + 1] == 4;
  const std::string head(file.peek(wide ? kNewHeaderBytes : kOldHeaderBytes));
  if (wide && head.size() < kNewHeaderBytes) file.fail("ends within its header");
  const LasHeader header(file, reinterpret_cast<const unsigned char*>(head.data()));
  header.check();
  const std::uint64_t first = header.whole(kPointOffset, Scalar::UInt32);
  const std::uint64_t header_bytes = header.whole(kHeaderSize, Scalar::UInt16);
  if (header_bytes < head.size() || first < header_bytes || first > file.size()) {
    file.fail("its points begin at byte " + std::to_string(first) + ", which cannot be");
  }
  const std::uint64_t record_bytes = header.whole(kRecordBytes, Scalar::UInt16);
  const std::uint64_t num_points = header.numPoints();
  checkPoints(file, num_points, limits);
  if (num_points > (file.size() - first) / record_bytes) {
    file.fail("declares " + std::to_string(num_points) + " points of " +
              std::to_string(record_bytes) + " bytes, more than it holds");
  }
  file.skip(first);
  const std::vector<PointField> fields = fieldsOf(record_bytes);
  const PointColumns columns = findPointColumns(fields, file, {});
  RawCloud raw;
  raw.begin(num_points, columns, limits);
  raw.format = "las 1." + std::to_string(header.minorVersion()) + " format " +
               std::to_string(header.format());
  readBinaryRecords(file, fields, columns, false, raw);
  for (std::size_t i = 0; i < raw.positions.size(); ++i) {
    const std::size_t axis = i % 3;
    raw.positions[i] =
        raw.positions[i] * header.real(kScale + 8 * axis) + header.real(kOffset + 8 * axis);
  }
  return raw;  // what follows the points (waveforms, extended records) means nothing to us
}

}  // namespace storey::io
