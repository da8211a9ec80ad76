// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/circular_clustering.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

// The angle from a counter-clockwise to b, in [0, 2 pi).
double gapBetween(double a, double b) {
  const double gap = wrapAngle(b - a);
  return gap < 0.0 ? gap + 2.0 * kPi : gap;
}

// Neighbouring clusters around the circle, and the gaps between them in a queue. A gap is out of
// date when one of its ends has merged since; the stamps tell.
class MergingRing {
 public:
  explicit MergingRing(const std::vector<AngleCluster>& clusters)
      : clusters_(clusters), stamp_(clusters.size(), 0), num_alive_(clusters.size()) {
    const std::size_t n = clusters.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      pushGap(i);
    }
  }

  void mergeUntil(double merge_angle) {
    while (!gaps_.empty() && num_alive_ > 1) {
      const Gap closest = gaps_.top();
      gaps_.pop();
      if (closest.angle > merge_angle) {
        return;
      }
      if (closest.stamp_left == stamp_[closest.left] &&
          closest.stamp_right == stamp_[next_[closest.left]]) {
        mergeWithNext(closest.left);
      }
    }
  }

  std::vector<AngleCluster> alive() const {
    std::vector<AngleCluster> result;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      if (stamp_[i] != kDead) {
        result.push_back(clusters_[i]);
      }
    }
    std::sort(result.begin(), result.end(),
              [](const AngleCluster& a, const AngleCluster& b) { return a.center < b.center; });
    return result;
  }

 private:
  struct Gap {
    double angle;
    std::size_t left;
    std::size_t stamp_left;
    std::size_t stamp_right;
    bool operator>(const Gap& other) const {
      return std::make_pair(angle, left) > std::make_pair(other.angle, other.left);
    }
  };
  static constexpr std::size_t kDead = static_cast<std::size_t>(-1);

  void pushGap(std::size_t left) {
    const std::size_t right = next_[left];
    if (left != right) {
      gaps_.push({gapBetween(clusters_[left].center, clusters_[right].center), left, stamp_[left],
                  stamp_[right]});
    }
  }

  void mergeWithNext(std::size_t left) {
    const std::size_t right = next_[left];
    AngleCluster& merged = clusters_[left];
    const double gap = gapBetween(merged.center, clusters_[right].center);
    const double weight = merged.weight + clusters_[right].weight;
    merged.center = wrapAngle(merged.center + gap * clusters_[right].weight / weight);
    merged.weight = weight;
    next_[left] = next_[right];
    previous_[next_[left]] = left;
    stamp_[right] = kDead;
    ++stamp_[left];
    --num_alive_;
    pushGap(left);
    pushGap(previous_[left]);
  }

  std::vector<AngleCluster> clusters_;
  std::vector<std::size_t> stamp_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
  std::size_t num_alive_;
  std::priority_queue<Gap, std::vector<Gap>, std::greater<>> gaps_;
};

// Count around every bin under a triangle that falls to 0 at `half_width` bins.
std::vector<double> smoothCounts(const std::vector<std::size_t>& counts, std::size_t half_width) {
  const std::size_t n = counts.size();
  std::vector<double> smooth(n, 0.0);
  for (std::size_t b = 0; b < n; ++b) {
    smooth[b] = static_cast<double>(counts[b]);
    for (std::size_t d = 1; d < half_width; ++d) {
      const double weight = 1.0 - static_cast<double>(d) / static_cast<double>(half_width);
      smooth[b] += weight * static_cast<double>(counts[(b + d) % n] + counts[(b + n - d) % n]);
    }
  }
  return smooth;
}

struct Deviation {
  double angle;  // from the present centre
  double weight;
};

double medianSize(std::vector<Deviation> deviations) {
  std::sort(deviations.begin(), deviations.end(), [](const Deviation& a, const Deviation& b) {
    return std::abs(a.angle) < std::abs(b.angle);
  });
  double total = 0.0;
  for (const Deviation& d : deviations) {
    total += d.weight;
  }
  double below = 0.0;
  for (const Deviation& d : deviations) {
    below += d.weight;
    if (2.0 * below >= total) {
      return std::abs(d.angle);
    }
  }
  return 0.0;
}

// How far the biweight mean of the deviations lies from 0.
double biweightShift(const std::vector<Deviation>& deviations, double half_window) {
  constexpr double kTukey = 4.685 * 1.4826;       // 95 % efficient for a normal distribution
  constexpr double kLeastWindow = 0.5 * kDegree;  // when all directions are the same
  const double window =
      std::min(half_window, std::max(kLeastWindow, kTukey * medianSize(deviations)));
  double sum = 0.0;
  double total = 0.0;
  for (const Deviation& d : deviations) {
    const double u = d.angle / window;
    if (std::abs(u) < 1.0) {
      const double weight = d.weight * (1.0 - u * u) * (1.0 - u * u);
      sum += weight * d.angle;
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : 0.0;
}

double refineCenter(const std::vector<AngleCluster>& bins, double center, double half_window) {
  constexpr int kMaxSteps = 50;
  constexpr double kConverged = 1e-10;  // rad
  for (int step = 0; step < kMaxSteps; ++step) {
    std::vector<Deviation> deviations;
    for (const AngleCluster& bin : bins) {
      const double angle = wrapAngle(bin.center - center);
      if (std::abs(angle) <= half_window) {
        deviations.push_back({angle, bin.weight});
      }
    }
    const double shift = biweightShift(deviations, half_window);
    center = wrapAngle(center + shift);
    if (std::abs(shift) < kConverged) {
      break;
    }
  }
  return center;
}

}  // namespace

double wrapAngle(double angle) {
  const double wrapped = angle - 2.0 * kPi * std::floor((angle + kPi) / (2.0 * kPi));
  return wrapped >= kPi ? -kPi : wrapped;  // rounding may lift the lower end to the upper
}

void AngleHistogram::add(double angle) {
  // multiples of the bin width are middles of bins: axis-aligned walls do not straddle two
  const double place = std::round(wrapAngle(angle) / kBinWidth);
  const auto bin = static_cast<std::size_t>(place + static_cast<double>(kNumBins)) % kNumBins;
  ++counts_[bin];
  offsets_[bin] += wrapAngle(angle - place * kBinWidth);
  ++total_;
}

std::vector<AngleCluster> AngleHistogram::clusters() const {
  std::vector<AngleCluster> result;
  for (std::size_t bin = 0; bin < kNumBins; ++bin) {
    if (counts_[bin] > 0) {
      const auto count = static_cast<double>(counts_[bin]);
      const double middle = static_cast<double>(bin) * kBinWidth;
      result.push_back({wrapAngle(middle + offsets_[bin] / count), count});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const AngleCluster& a, const AngleCluster& b) { return a.center < b.center; });
  return result;
}

std::vector<AngleCluster> mergeOnCircle(const std::vector<AngleCluster>& clusters,
                                        double merge_angle) {
  MergingRing ring(clusters);
  ring.mergeUntil(merge_angle);
  return ring.alive();
}

double modeSpread(const AngleHistogram& histogram) {
  constexpr double kReliableMass = 100.0;      // directions under the triangle: 10 % of noise
  constexpr std::size_t kLeastHalfWidth = 10;  // bins = 1 degree
  constexpr std::size_t kMostHalfWidth = 100;  // bins = 10 degrees
  constexpr double kHeight = 0.1;              // where the width is taken, against the mode
  constexpr double kWidthOfSigma = 4.29193;    // 2 sqrt(2 ln 10): of a normal distribution
  if (histogram.total() == 0) {
    return 0.0;
  }
  std::vector<double> smooth;
  std::size_t half_width = kLeastHalfWidth;
  std::size_t mode = 0;
  for (;; half_width = std::min(kMostHalfWidth, half_width * 3 / 2)) {
    smooth = smoothCounts(histogram.counts(), half_width);
    mode =
        static_cast<std::size_t>(std::max_element(smooth.begin(), smooth.end()) - smooth.begin());
    if (smooth[mode] >= kReliableMass || half_width == kMostHalfWidth) {
      break;
    }
  }
  const std::size_t n = smooth.size();
  const double floor = kHeight * smooth[mode];
  std::size_t width = 1;  // bins around the mode that are higher
  for (std::size_t d = 1; d < n / 2 && smooth[(mode + d) % n] >= floor; ++d) {
    ++width;
  }
  for (std::size_t d = 1; d < n / 2 && smooth[(mode + n - d) % n] >= floor; ++d) {
    ++width;
  }
  const double sigma = static_cast<double>(width) / kWidthOfSigma;
  const auto blur = static_cast<double>(half_width);  // a triangle has the variance h^2 / 6
  return AngleHistogram::kBinWidth * std::sqrt(std::max(0.0, sigma * sigma - blur * blur / 6.0));
}

double mergeAngleFor(double spread) {
  return std::clamp(4.0 * spread, 5.0 * kDegree, 25.0 * kDegree);
}

std::vector<double> refineCenters(const std::vector<AngleCluster>& bins,
                                  const std::vector<AngleCluster>& centers) {
  std::vector<double> refined;
  for (std::size_t c = 0; c < centers.size(); ++c) {
    double half_window = 30.0 * kDegree;
    for (std::size_t d = 0; d < centers.size(); ++d) {
      if (c != d) {
        const double apart = std::abs(wrapAngle(centers[d].center - centers[c].center));
        half_window = std::min(half_window, 0.5 * apart);
      }
    }
    refined.push_back(refineCenter(bins, centers[c].center, half_window));
  }
  return refined;
}

}  // namespace storey::detail
