// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cstdint>
#include <string>

#include "io/scan.h"

namespace storey::io {

inline bool isUtf8(const std::string& text) {
  namespace utf = boost::locale::utf;
  for (auto at = text.begin(); at != text.end();) {
    if (!utf::is_valid_codepoint(utf::utf_traits<char>::decode(at, text.end()))) return false;
  }
  return true;
}

/// Whether this may name a coordinate reference system: EPSG: and a number above 0, or any one line
/// of text (UTF-8) that is no number. Empty: not known.
inline bool isCrs(const std::string& crs) {
  constexpr std::size_t kMaxLength = 10000;  // of WKT, in the header of a file
  const bool printable =
      std::all_of(crs.begin(), crs.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
  const std::string authority = "EPSG:";
  const bool named = crs.rfind(authority, 0) == 0;
  std::uint64_t code = 0;
  const bool number = parseUnsigned(named ? crs.substr(authority.size()) : crs, code);
  return printable && crs.size() <= kMaxLength && isUtf8(crs) &&
         (named ? number && code > 0 : !number);
}

/// The reference system that a comment of ours names (`noteOf`); empty if it names none.
inline std::string crsOfNote(const std::string& note) {
  const std::string key = "crs ";
  const std::string crs = note.rfind(key, 0) == 0 ? note.substr(key.size()) : "";
  return isCrs(crs) ? crs : "";
}

}  // namespace storey::io
