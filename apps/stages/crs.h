// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/scan.h"

namespace storey::stages {

/// Whether this may name a coordinate reference system: EPSG: and a number above 0, or any one line
/// of text that is no number. Empty: not known.
inline bool isCrs(const std::string& crs) {
  constexpr std::size_t kMaxLength = 10000;  // of WKT, in the header of a file
  const bool printable =
      std::all_of(crs.begin(), crs.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
  const std::string authority = "EPSG:";
  const bool named = crs.rfind(authority, 0) == 0;
  std::uint64_t code = 0;
  const bool number = io::parseUnsigned(named ? crs.substr(authority.size()) : crs, code);
  return printable && crs.size() <= kMaxLength && (named ? number && code > 0 : !number);
}

}  // namespace storey::stages
