// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan.h"

namespace storey::io {

std::vector<std::string_view> splitWords(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t stop = line.find_first_of(kBlanks, at);
    words.push_back(line.substr(at, stop - at));
    at = line.find_first_not_of(kBlanks, stop);
  }
  return words;
}

bool parseUnsigned(std::string_view word, std::uint64_t& value) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end;
}

bool parseNumber(std::string_view word, double& value) {
  NumberScanner scanner(word);
  double rest = 0.0;
  return scanner.next(value) == NumberScanner::Result::Number &&
         scanner.next(rest) == NumberScanner::Result::End;
}

}  // namespace storey::io
