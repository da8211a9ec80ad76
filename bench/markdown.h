// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace storey::bench {

/// A number with a fixed count of digits behind the point.
std::string fixed(double value, int digits);

/// "18 of 20".
std::string ofCount(std::size_t part, std::size_t whole);

/// A Markdown table whose columns are padded, so that it can be read as it is.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  bool empty() const { return rows_.size() == 1; }

  /// To stdout, with an empty line after it.
  void print() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace storey::bench
