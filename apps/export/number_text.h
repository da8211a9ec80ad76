// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace storey::exports {

/// The shortest decimal number that reads back as exactly this value.
inline std::string numberText(double value) {
  std::array<char, 32> text{};  // 24 characters are the most
  const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

}  // namespace storey::exports
