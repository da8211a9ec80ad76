// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_flatness.h>
#include <storey/segmentation/detail/wall_moments.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kLeanDeviations = 4.0;  // of the slope of a run against the line
constexpr double kLean = 1.0;            // noise deviations, over the length of the run
constexpr double kFlat = 0.6;            // noise deviations that a part of a wall may be off
constexpr double kDeviations = 3.0;      // of a mean: what its noise explains
constexpr double kMaxOffShare = 0.15;    // of the points of a flat stretch
constexpr std::size_t kBins = 24;        // along the wall
constexpr double kSetback = 1.2;         // noise deviations between storeys; panes make half of it
constexpr std::size_t kLevels = 48;      // of height

// A support, not empty, in bins of equal width along the line.
class Profile {
 public:
  explicit Profile(const LinePoints& support) : bin_of_(support.size()) {
    const auto [low, high] = rangeOf(support.s);
    const double step = std::max((high - low) / kBins, std::numeric_limits<double>::min());
    for (std::size_t k = 0; k < support.size(); ++k) {
      const double s = support.s[k] - low;
      const std::size_t bin = std::min(static_cast<std::size_t>(s / step), kBins - 1);
      bin_of_[k] = static_cast<std::uint8_t>(bin);
      bins_[bin].add(WallMoments::ofPlace(s, support.d[k]));
    }
  }

  const WallMoments& operator[](std::size_t bin) const { return bins_[bin]; }

  WallMoments sumOf(std::size_t first, std::size_t last) const {
    WallMoments sum;
    for (std::size_t b = first; b < last; ++b) sum.add(bins_[b]);
    return sum;
  }

  // Whether few points lie where the mean is off the level of the stretch.
  bool isFlat(std::size_t first, std::size_t last, double noise) const {
    const WallMoments all = sumOf(first, last);
    double off = 0.0;
    for (std::size_t b = first; b < last; ++b) {
      const WallMoments& bin = bins_[b];
      if (bin.n < 1.0) continue;
      const double away = std::abs(bin.d / bin.n - all.d / all.n);
      if (away > noise * (kFlat + kDeviations / std::sqrt(bin.n))) off += bin.n;
    }
    return all.n > 0.0 && off <= kMaxOffShare * all.n;
  }

  std::size_t binOf(std::size_t point) const { return bin_of_[point]; }

 private:
  std::vector<std::uint8_t> bin_of_;  // parallel to the support
  std::array<WallMoments, kBins> bins_;
};

// Whether normals tell that a run whose places turn by this slope does not: they are nearer to the
// line, and further from the turn than their scatter explains.
bool isStraightByNormals(const WallMoments& run, double slope) {
  const double mean = run.t / run.n;
  const double away = std::abs(mean + slope);
  const double variance = std::max(0.0, run.tt / run.n - mean * mean) / run.n;
  return away > std::abs(mean) && away > kDeviations * std::sqrt(variance);
}

bool leans(const WallMoments& run, double length, double noise, bool by_normals) {
  const double spread = run.spread();
  if (!(spread > 0.0)) return false;
  const double slope = run.slope();
  return std::abs(slope) > kLeanDeviations * noise / std::sqrt(spread) &&
         std::abs(slope) * length > kLean * noise &&
         !(by_normals && isStraightByNormals(run, slope));
}

// Points at some heights: how many, and the sum of their places across the line.
struct Heights {
  double n = 0.0, d = 0.0;

  void add(const Heights& other) { n += other.n, d += other.d; }
  double mean() const { return d / n; }
};

// Whether two walls, not one: the means differ by more than panes and noise explain.
bool isSetBack(const Heights& below, const Heights& above, double noise) {
  if (below.n < 1.0 || above.n < 1.0) return false;
  const double deviation = std::sqrt(1.0 / below.n + 1.0 / above.n);
  return std::abs(below.mean() - above.mean()) > noise * (kSetback + kDeviations * deviation);
}

// The range of levels, of those from `first` to `last`, left when the part with fewer points is
// taken away at the clearest setback; the same range if there is none.
std::pair<std::size_t, std::size_t> withoutSetback(const std::array<Heights, kLevels>& levels,
                                                   std::size_t first, std::size_t last,
                                                   double noise) {
  Heights all;
  for (std::size_t l = first; l < last; ++l) all.add(levels[l]);
  Heights below;
  double most = 0.0;
  std::pair<std::size_t, std::size_t> kept{first, last};
  for (std::size_t l = first; l + 1 < last; ++l) {
    below.add(levels[l]);
    const Heights above{all.n - below.n, all.d - below.d};
    if (!isSetBack(below, above, noise)) continue;
    const double step = below.mean() - above.mean();
    const double gain = below.n * above.n / all.n * step * step;  // of the sum of squares
    if (gain <= most) continue;
    most = gain;
    kept = below.n >= above.n ? std::make_pair(first, l + 1) : std::make_pair(l + 1, last);
  }
  return kept;
}

}  // namespace

LinePoints atMainHeights(LinePoints support, double noise) {
  if (support.empty()) return support;
  const auto [low, high] = rangeOf(support.z);
  const double step = std::max((high - low) / kLevels, std::numeric_limits<double>::min());
  std::vector<std::uint8_t> level_of(support.size());
  std::array<Heights, kLevels> levels;
  for (std::size_t k = 0; k < support.size(); ++k) {
    const std::size_t level =
        std::min(static_cast<std::size_t>((support.z[k] - low) / step), kLevels - 1);
    level_of[k] = static_cast<std::uint8_t>(level);
    levels[level].add({1.0, support.d[k]});
  }
  std::pair<std::size_t, std::size_t> range{0, kLevels};
  for (auto less = range;
       (less = withoutSetback(levels, range.first, range.second, noise)) != range;) {
    range = less;
  }
  if (range.first == 0 && range.second == kLevels) return support;
  support.keepWhere(
      [&](std::size_t k) { return level_of[k] >= range.first && level_of[k] < range.second; });
  return support;
}

std::vector<std::pair<double, double>> runsAlong(const LinePoints& support,
                                                 const WallScale& scale) {
  if (support.empty()) return {};
  const auto [low, high] = rangeOf(support.s);
  const double side = supportCellSize(scale);
  std::vector<char> seen(static_cast<std::size_t>((high - low) / side) + 1, 0);
  for (const double s : support.s) seen[static_cast<std::size_t>((s - low) / side)] = 1;
  std::vector<std::pair<double, double>> runs;
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (seen[c] == 0) continue;
    const double left = low + side * static_cast<double>(c);
    if (c == 0 || seen[c - 1] == 0) runs.emplace_back(left, left);
    runs.back().second = c + 1 < seen.size() ? left + side : high;
  }
  return runs;
}

LinePoints withoutLeaningRuns(const std::vector<WallPoint>& points, LinePoints support,
                              const WallScale& scale, const WallLine& line, bool by_normals) {
  const auto runs = runsAlong(support, scale);
  const auto runOf = [&](double s) {
    std::size_t r = 0;
    while (r + 1 < runs.size() && s > runs[r].second) ++r;
    return r;
  };
  std::vector<WallMoments> moments(runs.size());
  for (std::size_t k = 0; k < support.size(); ++k) {
    const std::size_t r = runOf(support.s[k]);
    const double s = support.s[k] - runs[r].first;
    moments[r].add(
        by_normals ? WallMoments::of(points[static_cast<std::size_t>(support.number[k])], s, line)
                   : WallMoments::ofPlace(s, support.d[k]));
  }
  std::vector<char> leaning(runs.size(), 0);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    leaning[r] = leans(moments[r], runs[r].second - runs[r].first, scale.noise, by_normals) ? 1 : 0;
  }
  if (std::count(leaning.begin(), leaning.end(), 1) == 0) return support;
  support.keepWhere([&](std::size_t k) { return leaning[runOf(support.s[k])] == 0; });
  return support;
}

LinePoints alongMainHalf(LinePoints support, double noise) {
  if (support.empty()) return support;
  const Profile profile(support);
  WallMoments main;
  for (std::size_t first = 0; 2 * first <= kBins; ++first) {
    const WallMoments half = profile.sumOf(first, first + kBins / 2);
    if (half.n > main.n) main = half;
  }
  const double spread = main.spread();
  if (!(spread > 0.0)) return support;
  std::array<char, kBins> agrees{};
  for (std::size_t b = 0; b < kBins; ++b) {
    const WallMoments& bin = profile[b];
    const double lever = bin.s / bin.n - main.s / main.n;
    const double off = std::abs(bin.d / bin.n - main.d / main.n - main.slope() * lever);
    const double variance = 1.0 / bin.n + 1.0 / main.n + lever * lever / spread;
    agrees[b] = off <= noise * (kFlat + kDeviations * std::sqrt(variance)) ? 1 : 0;
  }
  support.keepWhere([&](std::size_t k) { return agrees[profile.binOf(k)] != 0; });
  return support;
}

LinePoints flatStretch(LinePoints support, double noise) {
  if (support.empty()) return support;
  const Profile profile(support);
  for (const std::size_t parts : {1, 2, 3, 4, 6, 8, 12}) {
    const std::size_t width = kBins / parts;
    double most = 0.0;
    std::size_t best = 0;
    for (std::size_t first = 0; first + width <= kBins; ++first) {
      const double held = profile.sumOf(first, first + width).n;
      if (held <= most || !profile.isFlat(first, first + width, noise)) continue;
      most = held;
      best = first;
    }
    if (most == 0.0) continue;
    support.keepWhere(
        [&](std::size_t k) { return profile.binOf(k) >= best && profile.binOf(k) < best + width; });
    return support;
  }
  return {};
}

}  // namespace storey::detail
