// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/level_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kLeastStray = 0.0005;  // density of a wall beyond its end, of that before it
constexpr double kStrayCap = 0.1;       // share of the points that lie elsewhere
constexpr double kClear = 10.0;         // log-likelihood: a level that is really there
constexpr double kBlur = 3.0;           // noise deviations: within, before and beyond mix
constexpr double kReach = 8.0;          // noise deviations: beyond, a step is 0 or 1
constexpr double kInvSqrt2Pi = 0.3989422804014327;

double stepAt(double u) { return 0.5 * std::erfc(-u * M_SQRT1_2); }
double bellAt(double u) { return kInvSqrt2Pi * std::exp(-0.5 * u * u); }

// The integral of ((1 - stray) phi)^2 / ((1 - stray) Phi + stray): 0.9032 without strays.
double stepInformation(double stray) {
  constexpr double kWidth = 0.05;
  double sum = 0.0;
  for (double u = -kReach; u <= kReach; u += kWidth) {
    const double slope = (1.0 - stray) * bellAt(u);
    sum += slope * slope / ((1.0 - stray) * stepAt(u) + stray) * kWidth;
  }
  return sum;
}

// Heights of points of walls that end at one level. Those of walls that start there come mirrored.
class StepLikelihood {
 public:
  StepLikelihood(std::vector<double> heights, double low, double high, double noise)
      : heights_(std::move(heights)), low_(low), high_(high), noise_(noise) {}

  double at(double z) const {
    if (heights_.empty()) return 0.0;
    const double stray = strayAt(z);
    const auto first = std::lower_bound(heights_.begin(), heights_.end(), z - kReach * noise_);
    const auto last = std::upper_bound(first, heights_.end(), z + kReach * noise_);
    double sum =
        count(heights_.begin(), heights_.end()) * std::log((high_ - low_) / length(z, stray)) +
        count(last, heights_.end()) * std::log(stray);
    for (auto zi = first; zi != last; ++zi) {
      sum += std::log((1.0 - stray) * stepAt((z - *zi) / noise_) + stray);
    }
    return sum;
  }

  // Fisher's. The density comes from the same points, which costs the second term.
  double information(double z) const {
    if (heights_.empty()) return 0.0;
    const double stray = strayAt(z);
    const double seen = length(z, stray);
    const double density = count(heights_.begin(), heights_.end()) / seen;
    const double lost = (1.0 - stray) * (1.0 - stray) / seen;
    return std::max(0.0, density * (stepInformation(stray) / noise_ - lost));
  }

 private:
  using Iterator = std::vector<double>::const_iterator;
  static double count(Iterator from, Iterator to) { return static_cast<double>(to - from); }

  // The window, what lies beyond the level by its density.
  double length(double z, double stray) const {
    return (1.0 - stray) * (z - low_) + stray * (high_ - low_);
  }

  // Points of neighbours that are taken for the wall's own go on beyond its end.
  double strayAt(double z) const {
    const double before = z - kBlur * noise_;
    const double beyond = z + kBlur * noise_;
    if (before <= low_ || beyond >= high_) return kLeastStray;
    const double own =
        count(heights_.begin(), std::lower_bound(heights_.begin(), heights_.end(), before)) /
        (before - low_);
    const double foreign =
        count(std::upper_bound(heights_.begin(), heights_.end(), beyond), heights_.end()) /
        (high_ - beyond);
    return foreign < own ? std::max(kLeastStray, foreign / own) : 1.0;
  }

  std::vector<double> heights_;  // ascending
  double low_;
  double high_;
  double noise_;
};

// Heights of the points of level faces: most lie at the level, the others anywhere in the window.
class CapLikelihood {
 public:
  CapLikelihood(const std::vector<double>& heights, double window, double noise)
      : heights_(heights), window_(window), noise_(noise) {}

  double at(double z) const {
    double sum = 0.0;
    for (const double zi : heights_) {
      sum += std::log(ratio(zi - z) + kStrayCap);
    }
    return sum;
  }

  double information(double z) const {
    double sum = 0.0;
    for (const double zi : heights_) {
      sum += ratio(zi - z) / (ratio(zi - z) + kStrayCap) / (noise_ * noise_);
    }
    return sum;
  }

 private:
  // Density of a point of the face over that of one from anywhere.
  double ratio(double off) const {
    return (1.0 - kStrayCap) * bellAt(off / noise_) * window_ / noise_;
  }

  const std::vector<double>& heights_;
  double window_;
  double noise_;
};

struct Maximum {
  double z = 0.0;
  double value = -std::numeric_limits<double>::infinity();
};

// A scan in steps of half a deviation, then golden section.
template <typename Function>
Maximum maximize(const Function& function, double from, double to, double noise) {
  const int steps = std::clamp(static_cast<int>((to - from) / (0.5 * noise)), 4, 400);
  Maximum best;
  for (int i = 0; i <= steps; ++i) {
    const double z = from + (to - from) * i / steps;
    const double value = function(z);
    if (value > best.value) best = {z, value};
  }
  constexpr double kGolden = 0.6180339887498949;
  double a = std::max(from, best.z - (to - from) / steps);
  double b = std::min(to, best.z + (to - from) / steps);
  double c = b - kGolden * (b - a);
  double d = a + kGolden * (b - a);
  double at_c = function(c);
  double at_d = function(d);
  while (b - a > 1e-4 * noise) {
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

std::vector<double> mirrored(const std::vector<double>& heights) {
  std::vector<double> result;
  for (auto z = heights.rbegin(); z != heights.rend(); ++z) result.push_back(-*z);
  return result;
}

}  // namespace

HeightFit fitLevel(const LevelEvidence& level, double noise, double max_shift) {
  HeightFit fit;
  fit.z = level.guess;
  fit.cap_support = level.caps.size();
  const double from = std::max(level.low + noise, level.guess - max_shift);
  const double to = std::min(level.high - noise, level.guess + max_shift);
  if (!(from < to)) return fit;
  std::vector<StepLikelihood> ends;
  std::vector<StepLikelihood> starts;
  for (std::size_t i = 0; i < 2; ++i) {
    ends.emplace_back(level.ends[i], level.low, level.high, noise);
    starts.emplace_back(mirrored(level.starts[i]), -level.high, -level.low, noise);
    fit.wall_support += level.ends[i].size() + level.starts[i].size();
  }
  const CapLikelihood caps(level.caps, level.high - level.low, noise);
  const auto ofCaps = [&](double z) { return caps.at(z); };
  // Points of a slanted roof lie at no level.
  const bool flat = !level.caps.empty() && maximize(ofCaps, from, to, noise).value > kClear;
  const auto ofAll = [&](double z) {
    return ends[0].at(z) + ends[1].at(z) + starts[0].at(-z) + starts[1].at(-z) +
           (flat ? caps.at(z) : 0.0);
  };
  const Maximum best = maximize(ofAll, from, to, noise);
  if (best.value < kClear) return fit;
  fit.z = best.z;
  double information = flat ? caps.information(fit.z) : 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    information += ends[i].information(fit.z) + starts[i].information(-fit.z);
  }
  fit.deviation = 1.0 / std::sqrt(information);
  return fit;
}

}  // namespace storey::detail
