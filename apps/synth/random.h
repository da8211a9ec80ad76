// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace storey::synth {

/// Random numbers that are the same with every standard library: the engine is fixed by the C++
/// standard, the distributions of <random> are not, so they are made here from its bits.
/// Each purpose takes a stream of its own, so that switching one defect on leaves all other
/// random choices as they were.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : engine_(mix(seed + kGolden * (stream + 1))) {}

  /// Uniform in [0, 1): the upper 53 bits of a word.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in {0, ..., count - 1}; count >= 1.
  int below(int count) { return static_cast<int>(uniform() * count); }

  /// True with the given probability.
  bool chance(double probability) { return uniform() < probability; }

  /// Standard normal (polar method of Marsaglia).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0.0;
    double v = 0.0;
    double s = 0.0;
    do {
      u = 2.0 * uniform() - 1.0;
      v = 2.0 * uniform() - 1.0;
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(s) / s);
    spare_ = v * factor;
    has_spare_ = true;
    return u * factor;
  }

  /// Fisher-Yates.
  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      const auto j = static_cast<std::size_t>(uniform() * static_cast<double>(i));
      std::swap(items[i - 1], items[j]);
    }
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

  /// The finaliser of SplitMix64: neighbouring seeds give unrelated states.
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace storey::synth
