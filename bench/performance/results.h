// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bench/performance/meter.h"

namespace storey::bench {

/// The table of all works: a row a work, a column a size of cloud.
class Results {
 public:
  explicit Results(std::vector<std::size_t> sizes) : sizes_(std::move(sizes)) {}

  const std::vector<std::size_t>& sizes() const { return sizes_; }

  void add(std::size_t size, const std::string& prefix, const std::vector<Measured>& measured);

  /// The same without a row of its own.
  void note(std::size_t size, const Measured& measured) { rows_[measured.work][size] = measured; }

  /// What was measured of the work at that size, or nothing.
  const Measured* find(const std::string& work, std::size_t size) const;

  /// To stdout, in Markdown.
  void print() const;

  /// A row a work and size: "work",size,cpu,wall,bytes.
  void writeCsv(const std::string& path) const;

  /// The shares of the stages of "building: " for a plot: a row a size, a column a stage.
  void writeShares(const std::string& path) const;

 private:
  std::vector<std::string> cellsOf(const std::string& work) const;

  std::vector<std::size_t> sizes_;
  std::vector<std::string> order_;
  std::map<std::string, std::map<std::size_t, Measured>> rows_;
};

}  // namespace storey::bench
