// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/scalar.h"

namespace storey::io {

enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };

struct PlyProperty {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::string name;
  Scalar type = Scalar::Float32;  ///< of the number, or of the entries of the list
  bool is_list = false;
  Scalar count_type = Scalar::UInt8;  ///< of the length of the list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool hasLists() const;
  /// Index of the property of this name and kind, or `PlyProperty::kNone`.
  std::size_t find(const std::string& property, bool is_list) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;  ///< in the order of the body
  std::vector<std::string> notes;    ///< comments that are ours, see `noteOf`
};

const char* nameOf(PlyFormat format);

/// Reads the header from the first byte to `end_header` and checks that the rest of the file can
/// hold what it declares. All `comment` lines but ours and `obj_info` lines are passed over.
PlyHeader readPlyHeader(InputFile& file);

}  // namespace storey::io
