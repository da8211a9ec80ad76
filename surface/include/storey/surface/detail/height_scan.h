// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace storey::detail {

struct ScanMaximum {
  double z = 0.0;
  double value = -std::numeric_limits<double>::infinity();
};

/// Looks for the maximum of a function of height: places half a noise deviation apart, and golden
/// section about the best of them.
class HeightScan {
 public:
  HeightScan(double from, double to, double noise)
      : from_(from),
        to_(to),
        noise_(noise),
        steps_(std::clamp(static_cast<int>((to - from) / (0.5 * noise)), 4, 400)) {}

  double from() const { return from_; }
  double to() const { return to_; }
  bool empty() const { return !(from_ < to_); }

  /// The function at each place. \param threads 0: all cores
  template <typename Function>
  std::vector<double> valuesOf(const Function& function, unsigned int threads) const {
    std::vector<double> values(static_cast<std::size_t>(steps_) + 1);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 4)
    for (int i = 0; i <= steps_; ++i) values[static_cast<std::size_t>(i)] = function(placeOf(i));
    return values;
  }

  /// \param values of the function at each place
  template <typename Function>
  ScanMaximum refined(const std::vector<double>& values, const Function& function) const {
    ScanMaximum best;
    for (int i = 0; i <= steps_; ++i) {
      const double value = values[static_cast<std::size_t>(i)];
      if (value > best.value) best = {placeOf(i), value};
    }
    constexpr double kGolden = 0.6180339887498949;
    double a = std::max(from_, best.z - (to_ - from_) / steps_);
    double b = std::min(to_, best.z + (to_ - from_) / steps_);
    double c = b - kGolden * (b - a);
    double d = a + kGolden * (b - a);
    double at_c = function(c);
    double at_d = function(d);
    while (b - a > 1e-4 * noise_) {
      if (at_c > at_d) {
        b = d;
        d = c;
        at_d = at_c;
        c = b - kGolden * (b - a);
        at_c = function(c);
      } else {
        a = c;
        c = d;
        at_c = at_d;
        d = a + kGolden * (b - a);
        at_d = function(d);
      }
    }
    return {0.5 * (a + b), std::max(at_c, at_d)};
  }

 private:
  double placeOf(int i) const { return from_ + (to_ - from_) * i / steps_; }

  double from_;
  double to_;
  double noise_;
  int steps_;
};

}  // namespace storey::detail
