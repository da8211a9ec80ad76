// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace storey::bench {

/// What a piece of work took.
struct Measured {
  std::string work;
  double wall = 0.0;   ///< seconds
  double cpu = 0.0;    ///< seconds of all threads
  double bytes = 0.0;  ///< by which memory grew at its peak; 0: not measured
};

/// Measures this process from one call of `lap` to the next.
class Meter {
 public:
  Meter() { start(); }

  /// What passed since the meter was made or since the last lap, and starts the next one.
  Measured lap(const std::string& work);

  /// Bytes in memory when this lap began.
  double resident() const { return resident_; }

 private:
  void start();

  double wall_ = 0.0;
  double cpu_ = 0.0;
  double resident_ = 0.0;
};

/// As lines of text, to be handed from process to process.
std::string textOf(const std::vector<Measured>& measured);
std::vector<Measured> measuredFrom(const std::string& text);

}  // namespace storey::bench
