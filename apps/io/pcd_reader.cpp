// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_reader.h"

#include <cmath>
#include <set>
#include <string>

#include "io/failure.h"
#include "io/limits.h"
#include "io/lzf.h"
#include "io/scan.h"

namespace storey::io {
namespace {

using Words = std::vector<std::string_view>;

// In the order that the format demands.
enum Keyword { Version, Fields, Size, Type, Count, Width, Height, Viewpoint, Points, Data };
constexpr const char* kKeywords[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                     "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
constexpr int kNumKeywords = 10;
constexpr int kRequired[] = {Fields, Size, Type, Width, Height, Points};

struct PcdHeader {
  std::vector<PointField> fields;
  std::vector<std::uint64_t> sizes;  // bytes of a number, until TYPE tells which number
  std::uint64_t record_bytes = 0;
  std::uint64_t record_values = 0;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::uint64_t points = 0;
  std::string data;
  std::vector<std::string> notes;
};

int findKeyword(std::string_view word) {
  if (word == "COLUMNS") return Fields;  // its name in version 0.5
  for (int k = 0; k < kNumKeywords; ++k) {
    if (word == kKeywords[k]) return k;
  }
  return -1;
}

std::uint64_t parseCount(const InputFile& file, std::string_view word, const char* what) {
  std::uint64_t value = 0;
  if (!parseUnsigned(word, value)) {
    file.failAtLine(std::string(what) + " is '" + printable(std::string(word), 40) +
                    "', expected a whole number from 0");
  }
  return value;
}

void parseFields(const InputFile& file, const Words& words, PcdHeader& header) {
  std::set<std::string_view> names;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool padding = words[i] == "_";
    if (!padding && !names.insert(words[i]).second) {
      file.failAtLine("two fields are called '" + printable(std::string(words[i]), 40) + "'");
    }
    PointField field;
    field.name = std::string(words[i]);
    header.fields.push_back(field);
  }
}

Scalar scalarOf(const InputFile& file, std::string_view type, std::uint64_t size) {
  const int exponent = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : size == 8 ? 3 : -1;
  constexpr Scalar kSigned[] = {Scalar::Int8, Scalar::Int16, Scalar::Int32, Scalar::Int64};
  constexpr Scalar kUnsigned[] = {Scalar::UInt8, Scalar::UInt16, Scalar::UInt32, Scalar::UInt64};
  if (exponent >= 0 && type == "I") return kSigned[exponent];
  if (exponent >= 0 && type == "U") return kUnsigned[exponent];
  if (type == "F" && size == 4) return Scalar::Float32;
  if (type == "F" && size == 8) return Scalar::Float64;
  file.failAtLine("TYPE '" + printable(std::string(type), 40) + "' of SIZE " +
                  std::to_string(size) + " does not exist");
}

void parseViewpoint(const InputFile& file, const Words& words) {
  double value = 0.0;
  double orientation = 0.0;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (!parseNumber(words[i], value) || !std::isfinite(value)) {
      file.failAtLine("VIEWPOINT is not finite");
    }
    if (i > 3) orientation += std::abs(value);
  }
  if (words.size() != 8 || !(orientation > 0.0)) {
    file.failAtLine("VIEWPOINT is not a position and a quaternion");
  }
}

void parsePerField(const InputFile& file, int keyword, const Words& words, PcdHeader& header) {
  if (words.size() != header.fields.size() + 1) {
    file.failAtLine(std::string(kKeywords[keyword]) + " has " + std::to_string(words.size() - 1) +
                    " entries for " + std::to_string(header.fields.size()) + " fields");
  }
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    if (keyword == Size) {
      header.sizes.push_back(parseCount(file, word, "SIZE"));
    } else if (keyword == Type) {
      if (header.sizes.empty()) file.failAtLine("TYPE comes before SIZE");
      header.fields[i].type = scalarOf(file, word, header.sizes[i]);
    } else {
      const std::uint64_t count = parseCount(file, word, "COUNT");
      if (count < 1 || count > kMaxFieldCount) {
        file.failAtLine("COUNT is " + std::to_string(count) + ", expected 1 to " +
                        std::to_string(kMaxFieldCount));
      }
      header.fields[i].count = count;
    }
  }
}

void parseLine(const InputFile& file, int keyword, const Words& words, PcdHeader& header) {
  const auto single = [&]() {
    if (words.size() != 2) {
      file.failAtLine(std::string(kKeywords[keyword]) + " must be followed by one word");
    }
    return words[1];
  };
  switch (keyword) {
    case Version:
      break;  // the layout has been the same since 0.5
    case Fields:
      parseFields(file, words, header);
      break;
    case Width:
      header.width = parseCount(file, single(), "WIDTH");
      break;
    case Height:
      header.height = parseCount(file, single(), "HEIGHT");
      break;
    case Viewpoint:
      parseViewpoint(file, words);
      break;
    case Points:
      header.points = parseCount(file, single(), "POINTS");
      break;
    case Data:
      header.data = std::string(single());
      break;
    default:
      parsePerField(file, keyword, words, header);
  }
}

PcdHeader readHeader(InputFile& file) {
  PcdHeader header;
  bool seen[kNumKeywords] = {};
  for (int last = -1; last != Data;) {
    const std::string_view line = file.nextHeaderLine();
    const Words words = splitWords(line);
    if (words.empty()) continue;
    if (words[0][0] == '#') {
      if (auto note = noteOf(line.substr(line.find('#') + 1))) header.notes.push_back(*note);
      continue;
    }
    const int keyword = findKeyword(words[0]);
    if (keyword < 0) {
      file.failAtLine("'" + printable(std::string(words[0]), 40) + "' is not a keyword of PCD");
    }
    if (keyword <= last) {
      file.failAtLine(std::string(kKeywords[keyword]) + " comes twice or too late");
    }
    if (words.size() > kMaxFields + 1) {
      file.failAtLine("more than " + std::to_string(kMaxFields) + " fields");
    }
    parseLine(file, keyword, words, header);
    seen[keyword] = true;
    last = keyword;
  }
  for (const int keyword : kRequired) {
    if (!seen[keyword]) file.fail(std::string("its header has no ") + kKeywords[keyword]);
  }
  return header;
}

/// Lays the fields out one after the other; the limits keep every product far below 2^64.
void layOut(const InputFile& file, PcdHeader& header) {
  for (PointField& field : header.fields) {
    field.offset = header.record_bytes;
    field.index = header.record_values;
    header.record_bytes += field.count * sizeOf(field.type);
    header.record_values += field.count;
  }
  if (header.record_values > kMaxRecordValues) {
    file.fail("a point has " + std::to_string(header.record_values) + " numbers, the limit is " +
              std::to_string(kMaxRecordValues));
  }
}

void checkCounts(const InputFile& file, const PcdHeader& header) {
  std::uint64_t product = 0;
  if (__builtin_mul_overflow(header.width, header.height, &product) || product != header.points) {
    file.fail("WIDTH " + std::to_string(header.width) + " times HEIGHT " +
              std::to_string(header.height) + " is not POINTS " + std::to_string(header.points));
  }
  checkPointCount(file, header.points);
}

/// Whether the rest of the file can hold what the header declares.
void checkBody(const InputFile& file, const PcdHeader& header) {
  const std::uint64_t rest = file.remaining();
  const auto demand = [&](std::uint64_t needed) {
    if (needed <= rest) return;
    file.failAtByte("the header declares " + std::to_string(header.points) +
                    " points, which need " + std::to_string(needed) + " bytes; " +
                    std::to_string(rest) + " are left");
  };
  if (header.data == "ascii") {
    demand(header.points * header.record_values * 2 - 1);  // a digit and a blank each
  } else if (header.data == "binary") {
    demand(header.points * header.record_bytes);
  } else if (header.data != "binary_compressed") {
    file.fail("its DATA is '" + printable(header.data, 40) +
              "', expected ascii, binary or binary_compressed");
  }
}

/// The uncompressed body: all numbers of the first field, then all of the second, ...
std::vector<unsigned char> decompress(InputFile& file, const PcdHeader& header,
                                      const PointColumns& columns, const ReadLimits& limits) {
  const unsigned char* const sizes = file.take(8);
  const auto compressed = static_cast<std::uint64_t>(decodeScalar(sizes, Scalar::UInt32, false));
  const auto full = static_cast<std::uint64_t>(decodeScalar(sizes + 4, Scalar::UInt32, false));
  const std::uint64_t expected = header.points * header.record_bytes;
  if (compressed == 0 || compressed > file.remaining()) {
    file.failAtByte("the compressed body has " + std::to_string(compressed) + " bytes, " +
                    std::to_string(file.remaining()) + " are left");
  }
  if (full != expected || full / kMaxLzfRatio > compressed) {
    file.failAtByte("the compressed body is to become " + std::to_string(full) +
                    " bytes, the points need " + std::to_string(expected));
  }
  const std::uint64_t kept = std::min(header.points, limits.max_points);
  const std::uint64_t each = kLoaderBytesPerPoint + sizeof(double) * columns.extra_names.size();
  file.checkMemory(compressed + full + kept * each, limits.max_memory,
                   std::to_string(header.points) + " points");
  std::vector<unsigned char> body(full);
  const unsigned char* const packed = file.take(compressed);
  if (!unpackLzf(packed, compressed, body.data(), full)) {
    file.failAtByte("the compressed body is damaged");
  }
  return body;
}

void readCompressed(InputFile& file, const PcdHeader& header, const PointColumns& columns,
                    const ReadLimits& limits, RawCloud& raw) {
  const std::vector<unsigned char> body = decompress(file, header, columns, limits);
  raw.begin(header.points, columns, limits);
  std::vector<double> values(columns.field.size());
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (std::size_t c = 0; c < values.size(); ++c) {
      const PointField& field = header.fields[columns.field[c]];
      const unsigned char* const block = body.data() + field.offset * header.points;
      values[c] = decodeScalar(block + i * sizeOf(field.type), field.type, false);
    }
    raw.add(values);
  }
}

}  // namespace

RawCloud readPcd(InputFile& file, const ReadLimits& limits,
                 const std::vector<std::string>& extras) {
  PcdHeader header = readHeader(file);
  layOut(file, header);
  const PointColumns columns = findPointColumns(header.fields, file, extras);
  checkCounts(file, header);
  checkBody(file, header);
  checkPoints(file, header.points, limits, columns.extra_names.size());
  RawCloud raw;
  raw.notes = header.notes;
  raw.format = "pcd " + header.data + " " + nameOf(header.fields[columns.field[0]].type);
  if (header.data == "binary_compressed") {
    readCompressed(file, header, columns, limits, raw);
  } else {
    raw.begin(header.points, columns, limits);
    if (header.data == "binary") {
      readBinaryRecords(file, header.fields, columns, false, raw);
    } else {
      readAsciiRecords(file, header.fields, columns, raw);
    }
  }
  std::string_view line;
  if (header.data == "ascii" && file.nextBodyLine(line)) {
    file.failAtLine("more points than the header declares");
  }
  file.expectEnd();
  return raw;
}

}  // namespace storey::io
