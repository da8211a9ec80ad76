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

double count(std::vector<double>::const_iterator from, std::vector<double>::const_iterator to) {
  return static_cast<double>(to - from);
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
  void multiply(double factor) {  // within 1e-100 and 1e100
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
  // The level lies between `from` and the top of the window.
  StepLikelihood(std::vector<double> heights, double low, double high, double from,
                 const BlurredStep& step)
      : heights_(std::move(heights)), low_(low), high_(high), step_(step) {
    rise_ = riseUpTo(from - kBlur * step.noise);
  }

  double at(double z) const {
    if (heights_.empty()) return 0.0;
    const double stray = strayAt(z);
    const double reach = step_.reach() * step_.noise;
    const auto first = std::lower_bound(heights_.begin(), heights_.end(), z - reach);
    const auto last = std::upper_bound(first, heights_.end(), z + reach);
    LogProduct near;
    for (auto zi = first; zi != last; ++zi) {
      near.multiply((1.0 - stray) * step_.at((z - *zi) / step_.noise) + stray);
    }
    return count(heights_.begin(), heights_.end()) *
               std::log(lengthOf(low_, high_) / lengthSeen(z, stray)) +
           count(last, heights_.end()) * std::log(stray) + near.log();
  }

  // Fisher's. The density comes from the same points, which costs the second term.
  double information(double z) const {
    if (heights_.empty()) return 0.0;
    const double stray = strayAt(z);
    const double seen = lengthSeen(z, stray);
    const double density =
        count(heights_.begin(), heights_.end()) * std::exp(rise_ * (z - low_)) / seen;
    const double lost = (1.0 - stray) * (1.0 - stray) / seen;
    return std::max(0.0, density * (stepInformation(step_, stray) / step_.noise - lost));
  }

  TailCount tails(double z) const {
    const double near = z + kBlur * step_.noise;
    const double far = z + kTailReach * step_.noise;
    const double before = z - kBlur * step_.noise;
    if (before <= low_ || high_ - far < far - near) return {};
    const auto begin = std::upper_bound(heights_.begin(), heights_.end(), near);
    const auto end = std::upper_bound(begin, heights_.end(), far);
    const double strays = count(end, heights_.end()) / (high_ - far) * (far - near);
    const double own =
        count(heights_.begin(), std::lower_bound(heights_.begin(), heights_.end(), before)) /
        lengthOf(low_, before, z);
    const BlurredStep all{step_.noise, 1.0};
    return {count(begin, end) - strays, count(begin, end) + strays,
            own * all.tailsBetween(near - z, far - z)};
  }

 private:
  // The relative change of density with height, from the points up to there; 0 if it is not clear.
  double riseUpTo(double to) const {
    const auto end = std::upper_bound(heights_.begin(), heights_.end(), to);
    const double n = count(heights_.begin(), end);
    if (n == 0.0 || to <= low_) return 0.0;
    double mean = 0.0;
    for (auto z = heights_.begin(); z != end; ++z) mean += *z / n;
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
    const double beyond = z + kBlur * step_.noise;
    if (before <= low_ || beyond >= high_) return kLeastStray;
    const double own =
        count(heights_.begin(), std::lower_bound(heights_.begin(), heights_.end(), before)) /
        lengthOf(low_, before, z);
    const double foreign =
        (count(std::upper_bound(heights_.begin(), heights_.end(), beyond), heights_.end()) -
         own * step_.tailsBetween(beyond - z, high_ - z)) /
        lengthOf(beyond, high_, z);
    return foreign < own ? std::max(kLeastStray, foreign / own) : 1.0;
  }

  std::vector<double> heights_;  // ascending
  double low_;
  double high_;
  BlurredStep step_;
  double rise_ = 0.0;
};

// Heights of the points of level faces: most lie at the level, the others anywhere in the window.
class CapLikelihood {
 public:
  CapLikelihood(std::vector<double> heights, double window, double noise)
      : heights_(std::move(heights)), window_(window), noise_(noise) {
    std::sort(heights_.begin(), heights_.end());
  }

  double at(double z) const {
    const auto [first, last] = near(z);
    LogProduct product;
    for (auto zi = first; zi != last; ++zi) product.multiply(ratio(*zi - z) + kStrayCap);
    return product.log() +
           (count(heights_.begin(), heights_.end()) - count(first, last)) * std::log(kStrayCap);
  }

  double information(double z) const {
    const auto [first, last] = near(z);
    double sum = 0.0;
    for (auto zi = first; zi != last; ++zi) {
      sum += ratio(*zi - z) / (ratio(*zi - z) + kStrayCap) / (noise_ * noise_);
    }
    return sum;
  }

 private:
  using Heights = std::vector<double>;

  // Those that a face at this height can have: the density of the others is 0 to rounding.
  std::pair<Heights::const_iterator, Heights::const_iterator> near(double z) const {
    const double reach = kCapReach * noise_;
    const auto first = std::lower_bound(heights_.begin(), heights_.end(), z - reach);
    return {first, std::upper_bound(first, heights_.end(), z + reach)};
  }

  // Density of a point of the face over that of one from anywhere.
  double ratio(double off) const {
    return (1.0 - kStrayCap) * bellAt(off / noise_) * window_ / noise_;
  }

  Heights heights_;  // ascending
  double window_;
  double noise_;
};

std::vector<double> mirrored(const std::vector<double>& heights) {
  std::vector<double> result;
  for (auto z = heights.rbegin(); z != heights.rend(); ++z) result.push_back(-*z);
  return result;
}

// The walls of all four lists of one level.
class Steps {
 public:
  Steps(const LevelEvidence& level, double from, double to, const BlurredStep& step) {
    for (std::size_t i = 0; i < 2; ++i) {
      ends_.emplace_back(level.ends[i], level.low, level.high, from, step);
      starts_.emplace_back(mirrored(level.starts[i]), -level.high, -level.low, -to, step);
      size_ += level.ends[i].size() + level.starts[i].size();
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
  if (scan_.empty() || level.caps.empty()) return;
  const CapLikelihood caps(level.caps, level.high - level.low, noise);
  const auto ofCaps = [&](double z) { return caps.at(z); };
  cap_values_ = scan_.valuesOf(ofCaps, threads);
  // Points of a slanted roof lie at no level.
  if (!(scan_.refined(cap_values_, ofCaps).value > kClear)) cap_values_.clear();
}

HeightFit LevelFitting::fit(double tails) const {
  HeightFit fit;
  fit.z = level_.guess;
  fit.cap_support = level_.caps.size();
  if (scan_.empty()) return fit;
  const Steps steps(level_, scan_.from(), scan_.to(), {noise_, tails});
  fit.wall_support = steps.size();
  const bool flat = !cap_values_.empty();
  const CapLikelihood caps(flat ? level_.caps : std::vector<double>(), level_.high - level_.low,
                           noise_);
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
