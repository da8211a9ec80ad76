// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

namespace storey::io {

/// The words of a line, separated by blanks and tabs.
std::vector<std::string_view> splitWords(std::string_view line);

/// A decimal number without sign that fills the whole word; false if it is none or above 2^64 - 1.
bool parseUnsigned(std::string_view word, std::uint64_t& value);

/// A decimal number that fills the whole word; "nan" and "inf" are numbers, "1e999" is not.
bool parseNumber(std::string_view word, double& value);

/// Steps through the numbers of a line without copying; independent of the locale.
class NumberScanner {
 public:
  enum class Result { Number, End, Malformed };

  explicit NumberScanner(std::string_view line)
      : next_(line.data()), end_(line.data() + line.size()) {}

  Result next(double& value) {
    while (next_ != end_ && isSeparator(*next_)) ++next_;
    if (next_ == end_) return Result::End;
    if (*next_ == '+' && next_ + 1 != end_ && next_[1] != '-') ++next_;
    const auto [stop, error] = std::from_chars(next_, end_, value);
    if (error != std::errc{} || (stop != end_ && !isSeparator(*stop))) return Result::Malformed;
    next_ = stop;
    return Result::Number;
  }

 private:
  static bool isSeparator(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  const char* next_;
  const char* end_;
};

}  // namespace storey::io
