// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/blurred_step.h>
#include <storey/surface/detail/level_evidence.h>
#include <storey/surface/detail/level_fitting.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kLeastStray = 0.0005;  // density of a wall beyond its end, of that before it
constexpr double kStrayCap = 0.1;       // share of the points that lie elsewhere
constexpr double kClear = 10.0;         // log-likelihood: a level that is really there
constexpr double kBlur = 3.0;           // noise deviations: within, before and beyond mix
constexpr double kCapReach = 12.0;      // noise deviations: beyond, a bell is 0 to rounding
constexpr double kClearRise = 4.0;      // deviations: a density that really changes with height
constexpr double kClearTails = 4.0;     // deviations: tails that are really there
constexpr double kMaxTails = 0.3;
constexpr double kAtEnd = 1e-3;  // noise deviations from where the search ends

// Numbers of heights: of the first that is at z or above, and of the first above it.
std::size_t from(const CountedHeights& sorted, double z) {
  const auto& all = sorted.heights;
  return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), z) - all.begin());
}
std::size_t beyond(const CountedHeights& sorted, double z) {
  const auto& all = sorted.heights;
  return static_cast<std::size_t>(std::upper_bound(all.begin(), all.end(), z) - all.begin());
}

// Points beyond a step, without the strays; their variance; how many there were if all had tails.
struct TailCount {
  double excess = 0.0;
  double variance = 0.0;
  double possible = 0.0;

  TailCount& operator+=(const TailCount& other) {
    excess += other.excess;
    variance += other.variance;
    possible += other.possible;
    return *this;
  }
};

// The logarithm of a product of many factors, with few calls of the logarithm.
class LogProduct {
 public:
  // The factor is within 1e-100 and 1e100, and comes `count` times.
  void multiply(double factor, double count) {
    if (count > 1.0) {
      sum_ += count * std::log(factor);
      return;
    }
    product_ *= factor;
    if (product_ > 1e-200 && product_ < 1e200) return;
    sum_ += std::log(product_);
    product_ = 1.0;
  }
  double log() const { return sum_ + std::log(product_); }

 private:
  double sum_ = 0.0;
  double product_ = 1.0;
};

// Heights of points of walls that end at one level. Those of walls that start there come mirrored.
class StepLikelihood {
 public:
  // The level lies between `lowest` and the top of the window.
  StepLikelihood(CountedHeights points, double low, double high, double lowest,
                 const BlurredStep& step)
      : points_(std::move(points)), low_(low), high_(high), step_(step) {
    rise_ = riseUpTo(lowest - kBlur * step.noise);
  }

  double at(double z) const {
    if (points_.size() == 0) return 0.0;
    const double stray = strayAt(z);
    const double reach = step_.reach() * step_.noise;
    const std::size_t last = beyond(points_, z + reach);
    LogProduct near;
    for (std::size_t i = from(points_, z - reach); i < last; ++i) {
      const double off = (z - points_.heights[i]) / step_.noise;
      near.multiply((1.0 - stray) * step_.at(off) + stray, points_.counts[i]);
    }
    return points_.total() * std::log(lengthOf(low_, high_) / lengthSeen(z, stray)) +
           (points_.total() - points_.before[last]) * std::log(stray) + near.log();
  }

  // Fisher's. The density comes from the same points, which costs the second term.
  double information(double z) const {
    if (points_.size() == 0) return 0.0;
    const double stray = strayAt(z);
    const double seen = lengthSeen(z, stray);
    const double density = points_.total() * std::exp(rise_ * (z - low_)) / seen;
    const double lost = (1.0 - stray) * (1.0 - stray) / seen;
    return std::max(0.0, density * (stepInformation(step_, stray) / step_.noise - lost));
  }

  TailCount tails(double z) const {
    const double near = z + kBlur * step_.noise;
    const double far = z + kTailReach * step_.noise;
    const double before = z - kBlur * step_.noise;
    if (before <= low_ || high_ - far < far - near) return {};
    const double strays = countBeyond(far) / (high_ - far) * (far - near);
    const double own = points_.below(before) / lengthOf(low_, before, z);
    const double between = countBeyond(near) - countBeyond(far);
    const BlurredStep all{step_.noise, 1.0};
    return {between - strays, between + strays, own * all.tailsBetween(near - z, far - z)};
  }

 private:
  double countBeyond(double z) const { return points_.total() - points_.below(z); }

  // The relative change of density with height, from the bins up to there; 0 if it is not clear.
  double riseUpTo(double most) const {
    const double to = low_ + std::floor((most - low_) / points_.width) * points_.width;
    const std::size_t end = from(points_, to);
    const double n = points_.before[end];
    if (n == 0.0 || to <= low_) return 0.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < end; ++i) mean += points_.heights[i] * points_.counts[i] / n;
    // A density 1 + g x over a length L has its mean at g L^2 / 12 from the middle, give or take
    // L / sqrt(12 n).
    const double length = to - low_;
    const double off = mean - 0.5 * (low_ + to);
    return std::abs(off) > kClearRise * length / std::sqrt(12.0 * n)
               ? 12.0 * off / (length * length)
               : 0.0;
  }

  // The integral of the density exp(rise (z - at)) over a range: its length if nothing rises.
  double lengthOf(double from, double to, double at) const {
    if (rise_ == 0.0) return to - from;
    return (std::exp(rise_ * (to - at)) - std::exp(rise_ * (from - at))) / rise_;
  }

  double lengthOf(double from, double to) const { return lengthOf(from, to, low_); }

  // The window, what lies beyond the level by its density.
  double lengthSeen(double z, double stray) const {
    return (1.0 - stray) * lengthOf(low_, z) + stray * lengthOf(low_, high_);
  }

  // Points of neighbours that are taken for the wall's own go on beyond its end.
  double strayAt(double z) const {
    const double before = z - kBlur * step_.noise;
    const double behind = z + kBlur * step_.noise;
    if (before <= low_ || behind >= high_) return kLeastStray;
    const double own = points_.below(before) / lengthOf(low_, before, z);
    const double foreign = (countBeyond(behind) - own * step_.tailsBetween(behind - z, high_ - z)) /
                           lengthOf(behind, high_, z);
    return foreign < own ? std::max(kLeastStray, foreign / own) : 1.0;
  }

  CountedHeights points_;
  double low_;
  double high_;
  BlurredStep step_;
  double rise_ = 0.0;
};

// Heights of the points of level faces: most lie at the level, the others anywhere in the window.
class CapLikelihood {
 public:
  CapLikelihood(CountedHeights points, double window, double noise)
      : points_(std::move(points)), window_(window), noise_(noise) {}

  double at(double z) const {
    const auto [first, last] = near(z);
    LogProduct product;
    for (std::size_t i = first; i < last; ++i) {
      product.multiply(ratio(points_.heights[i] - z) + kStrayCap, points_.counts[i]);
    }
    const double others = points_.total() - points_.before[last] + points_.before[first];
    return product.log() + others * std::log(kStrayCap);
  }

  double information(double z) const {
    const auto [first, last] = near(z);
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double r = ratio(points_.heights[i] - z);
      sum += points_.counts[i] * r / (r + kStrayCap) / (noise_ * noise_);
    }
    return sum;
  }

 private:
  // Those that a face at this height can have: the density of the others is 0 to rounding.
  std::pair<std::size_t, std::size_t> near(double z) const {
    const double reach = kCapReach * noise_;
    return {from(points_, z - reach), beyond(points_, z + reach)};
  }

  // Density of a point of the face over that of one from anywhere.
  double ratio(double off) const {
    return (1.0 - kStrayCap) * bellAt(off / noise_) * window_ / noise_;
  }

  CountedHeights points_;
  double window_;
  double noise_;
};

// The walls of all four lists of one level.
class Steps {
 public:
  Steps(const LevelEvidence& level, double lowest, double highest, const BlurredStep& step) {
    for (std::size_t i = 0; i < 2; ++i) {
      ends_.emplace_back(level.ends[i].ascending(), level.low, level.high, lowest, step);
      starts_.emplace_back(level.starts[i].mirrored(), -level.high, -level.low, -highest, step);
      size_ += level.ends[i].total() + level.starts[i].total();
    }
  }

  std::size_t size() const { return size_; }
  double at(double z) const {
    return ends_[0].at(z) + ends_[1].at(z) + starts_[0].at(-z) + starts_[1].at(-z);
  }
  double information(double z) const {
    double sum = 0.0;
    for (const StepLikelihood& end : ends_) sum += end.information(z);
    for (const StepLikelihood& start : starts_) sum += start.information(-z);
    return sum;
  }
  // Of the walls without close neighbours.
  TailCount tails(double z) const {
    TailCount sum = ends_[0].tails(z);
    sum += starts_[0].tails(-z);
    return sum;
  }

 private:
  std::vector<StepLikelihood> ends_;
  std::vector<StepLikelihood> starts_;
  std::size_t size_ = 0;
};

}  // namespace

LevelFitting::LevelFitting(const LevelEvidence& level, double noise, double max_shift,
                           unsigned int threads)
    : level_(level),
      noise_(noise),
      scan_(std::max(level.low + noise, level.guess - max_shift),
            std::min(level.high - noise, level.guess + max_shift), noise) {
  if (scan_.empty() || level.caps.total() == 0) return;
  const CapLikelihood caps(level.caps.ascending(), level.high - level.low, noise);
  const auto ofCaps = [&](double z) { return caps.at(z); };
  cap_values_ = scan_.valuesOf(ofCaps, threads);
  // Points of a slanted roof lie at no level.
  if (!(scan_.refined(cap_values_, ofCaps).value > kClear)) cap_values_.clear();
}

HeightFit LevelFitting::fit(double tails) const {
  HeightFit fit;
  fit.z = level_.guess;
  fit.cap_support = level_.caps.total();
  if (scan_.empty()) return fit;
  const Steps steps(level_, scan_.from(), scan_.to(), {noise_, tails});
  fit.wall_support = steps.size();
  const bool flat = !cap_values_.empty();
  const CapLikelihood caps(flat ? level_.caps.ascending() : CountedHeights(),
                           level_.high - level_.low, noise_);
  std::vector<double> values = scan_.valuesOf([&](double z) { return steps.at(z); }, 1);
  for (std::size_t i = 0; flat && i < values.size(); ++i) values[i] += cap_values_[i];
  const ScanMaximum best =
      scan_.refined(values, [&](double z) { return steps.at(z) + (flat ? caps.at(z) : 0.0); });
  if (best.value < kClear) return fit;
  fit.z = best.z;
  fit.deviation =
      1.0 / std::sqrt(steps.information(fit.z) + (flat ? caps.information(fit.z) : 0.0));
  const bool at_end = std::min(fit.z - scan_.from(), scan_.to() - fit.z) < kAtEnd * noise_;
  if (at_end) fit.deviation = std::hypot(fit.deviation, scan_.to() - scan_.from());
  return fit;
}

double tailsOf(const std::vector<LevelEvidence>& levels, const std::vector<HeightFit>& fits,
               double noise) {
  TailCount all;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (std::isinf(fits[k].deviation)) continue;
    const double z = fits[k].z;
    all += Steps(levels[k], z, z, {noise, 0.0}).tails(z);
  }
  const bool clear = all.excess > kClearTails * std::sqrt(all.variance);
  return clear ? std::min(all.excess / all.possible, kMaxTails) : 0.0;
}

}  // namespace storey::detail
