// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "io/input_file.h"
#include "io/scan.h"

namespace storey::io {

/// The numbers of a text, wherever its lines end.
class TextNumbers {
 public:
  explicit TextNumbers(InputFile& file) : file_(file), scanner_({}) {}

  /// The next number; fails at the end of the file and where there is a word.
  double next() {
    double value = 0.0;
    while (true) {
      const NumberScanner::Result result = scanner_.next(value);
      if (result == NumberScanner::Result::Number) return value;
      if (result == NumberScanner::Result::Malformed) {
        file_.failAtLine("holds something that is not a number that can be used");
      }
      std::string_view line;
      if (!file_.nextBodyLine(line)) file_.fail("ends within its numbers");
      scanner_ = NumberScanner(line);
    }
  }

  /// The next number, which must be whole and from 0 to `most`.
  std::uint64_t nextCount(std::uint64_t most) {
    const double value = next();
    if (!(value >= 0.0 && value <= static_cast<double>(most) && value == std::floor(value))) {
      file_.failAtLine("has no whole number from 0 to " + std::to_string(most) +
                       " where one belongs");
    }
    return static_cast<std::uint64_t>(value);
  }

  /// Fails unless the line ends here.
  void expectLineEnd() {
    double rest = 0.0;
    if (scanner_.next(rest) != NumberScanner::Result::End) file_.failAtLine("has too many numbers");
  }

 private:
  InputFile& file_;
  NumberScanner scanner_;
};

}  // namespace storey::io
