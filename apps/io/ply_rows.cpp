// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_rows.h"

#include "io/limits.h"
#include "io/scan.h"

namespace storey::io {

PlyRows::PlyRows(InputFile& file, const PlyElement& element, PlyFormat format)
    : file_(file),
      element_(element),
      format_(format),
      scalars_(element.properties.size()),
      lists_(element.properties.size()) {}

void PlyRows::next() {
  if (format_ == PlyFormat::Ascii) {
    nextAscii();
  } else {
    nextBinary();
  }
}

std::uint64_t PlyRows::checkedLength(double length) const {
  // Written so that NaN fails too.
  if (length >= 0.0 && length <= static_cast<double>(kMaxListLength)) {
    const auto whole = static_cast<std::uint64_t>(length);
    if (static_cast<double>(whole) == length) return whole;
  }
  const std::string reason =
      "a list of '" + element_.name + "' has no length from 0 to " + std::to_string(kMaxListLength);
  if (format_ == PlyFormat::Ascii) file_.failAtLine(reason);
  file_.failAtByte(reason);
}

void PlyRows::nextAscii() {
  std::string_view line;
  if (!file_.nextBodyLine(line)) file_.fail("ends within its element '" + element_.name + "'");
  NumberScanner scanner(line);
  const auto read = [&]() {
    double value = 0.0;
    const auto result = scanner.next(value);
    if (result == NumberScanner::Result::End) file_.failAtLine("has too few numbers");
    if (result == NumberScanner::Result::Malformed) {
      file_.failAtLine("holds something that is not a number that can be used");
    }
    return value;
  };
  for (std::size_t i = 0; i < element_.properties.size(); ++i) {
    if (!element_.properties[i].is_list) {
      scalars_[i] = read();
      continue;
    }
    const std::uint64_t length = checkedLength(read());
    lists_[i].clear();
    for (std::uint64_t k = 0; k < length; ++k) lists_[i].push_back(read());
  }
  double rest = 0.0;
  if (scanner.next(rest) != NumberScanner::Result::End) file_.failAtLine("has too many numbers");
}

void PlyRows::nextBinary() {
  const bool big_endian = format_ == PlyFormat::BinaryBigEndian;
  const auto read = [&](Scalar type) {
    return decodeScalar(file_.take(sizeOf(type)), type, big_endian);
  };
  for (std::size_t i = 0; i < element_.properties.size(); ++i) {
    const PlyProperty& property = element_.properties[i];
    if (!property.is_list) {
      scalars_[i] = read(property.type);
      continue;
    }
    const std::uint64_t length = checkedLength(read(property.count_type));
    const std::size_t entry_bytes = sizeOf(property.type);
    const unsigned char* const entries = file_.take(length * entry_bytes);
    lists_[i].resize(length);
    for (std::uint64_t k = 0; k < length; ++k) {
      lists_[i][k] = decodeScalar(entries + k * entry_bytes, property.type, big_endian);
    }
  }
}

void skipElement(InputFile& file, const PlyElement& element, PlyFormat format) {
  if (format != PlyFormat::Ascii && !element.hasLists()) {
    std::uint64_t row_bytes = 0;
    for (const PlyProperty& property : element.properties) row_bytes += sizeOf(property.type);
    file.skip(element.count * row_bytes);  // the header check saw that this does not overflow
    return;
  }
  PlyRows rows(file, element, format);
  for (std::uint64_t i = 0; i < element.count; ++i) rows.next();
}

void expectPlyEnd(InputFile& file, PlyFormat format) {
  std::string_view line;
  if (format == PlyFormat::Ascii && file.nextBodyLine(line)) {
    file.failAtLine("more rows than the header declares");
  }
  file.expectEnd();
}

}  // namespace storey::io
