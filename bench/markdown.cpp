// SPDX-License-Identifier: BSD-3-Clause
#include "bench/markdown.h"

#include <algorithm>
#include <cstdio>

namespace storey::bench {

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string ofCount(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

void Table::print() const {
  std::vector<std::size_t> widths(rows_[0].size(), 3);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      std::printf("| %-*s ", static_cast<int>(widths[i]), rows_[r][i].c_str());
    }
    std::printf("|\n");
    if (r > 0) continue;
    for (const std::size_t width : widths) std::printf("|%s", std::string(width + 2, '-').c_str());
    std::printf("|\n");
  }
  std::printf("\n");
}

}  // namespace storey::bench
