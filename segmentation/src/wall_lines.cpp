// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/even_draw.h>
#include <storey/filters/detail/task_crew.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/found_line.h>
#include <storey/segmentation/detail/short_walls.h>
#include <storey/segmentation/detail/wall_lines.h>
#include <storey/segmentation/detail/wall_support.h>
#include <storey/segmentation/detail/wall_votes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace storey::detail {
namespace {

constexpr int kFreeAngles = 360;          // one a degree, all around: lines are oriented
constexpr double kFreeBin = 1.5;          // of the offset, noise deviations
constexpr int kFreeWindow = 3;            // bins
constexpr double kLockedBin = 0.75;       // noise deviations
constexpr int kLockedWindow = 5;          // bins
constexpr double kMinVotes = 0.3;         // of the points that the least support would have
constexpr double kThin = 0.5;             // of the density of all: where its cells are too small
constexpr double kThinnest = 1.0 / 16.0;  // thinner heights show clutter alone
constexpr double kThinMiddle = 0.7;       // of an octave of densities
constexpr double kThinFacade = 0.25;      // of the density of all, at most
constexpr int kMaxFailures = 40;          // peaks without support in a row
constexpr double kMostTaken = 0.25;       // of the pool of points, by the lines found
constexpr double kOneWall = 24.0;         // noise deviations between lines of one direction
constexpr double kOneDirection = 0.35;    // rad, 20 degrees: peaks of one wall in other rows
constexpr int kAhead = 4;                 // peaks tried at once, most, for each thread
constexpr int kMaxLines = 400;            // cells grow with their square
constexpr double kBeside = 0.25;          // points of the stronger line, of the weaker's support
constexpr double kExplained = 2.5;        // noise deviations across a line
constexpr double kLeftover = 0.8;         // of the support; a wall 2 deviations beside has 0.69

// The line found where a peak is; without support if there is none.
struct PeakFit {
  WallLine guess;
  FoundLine found;
};

// Fits at peaks that were tried ahead of their turn, and that nothing has changed since.
class FitsAhead {
 public:
  // \return whether there is one; it goes to `fit`
  bool take(const WallLine& guess, PeakFit& fit) {
    const auto known = std::find_if(fits_.begin(), fits_.end(), [&](const PeakFit& other) {
      return other.guess.offset == guess.offset && other.guess.normal == guess.normal;
    });
    if (known == fits_.end()) return false;
    fit = std::move(*known);
    fits_.erase(known);
    return true;
  }

  void keep(PeakFit fit) { fits_.push_back(std::move(fit)); }

  // Forgets those to which some of the points taken away may have belonged.
  void forget(const std::vector<WallPoint>& points, const std::vector<int>& taken, double noise) {
    const auto changed = [&](const PeakFit& fit) {
      return std::any_of(taken.begin(), taken.end(), [&](int i) {
        return isCandidate(fit.guess, points[static_cast<std::size_t>(i)], noise);
      });
    };
    fits_.erase(std::remove_if(fits_.begin(), fits_.end(), changed), fits_.end());
  }

 private:
  std::vector<PeakFit> fits_;
};

// One greedy pass: strongest line, its support, take its points away, again.
class GreedyPass {
 public:
  GreedyPass(const std::vector<WallPoint>& points, const WallScale& scale,
             const WallLineOptions& options, TaskCrew& crew, bool free_direction,
             std::vector<double> angles, std::vector<char>& free)
      : points_(points),
        scale_(scale),
        crew_(crew),
        free_(free),
        table_(points, std::move(angles), scale.noise * (free_direction ? kFreeBin : kLockedBin),
               free_direction ? kFreeWindow : kLockedWindow, crew),
        pool_(points, free),
        least_votes_(std::max(10.0, kMinVotes * options.min_area * scale.density)),
        most_(crew.size() > 1 ? kAhead * crew.size() : 1) {
    options_.fit_direction = free_direction;
    options_.min_area = options.min_area;
    options_.steps = options.steps;
    table_.vote(pool_.numbers, 1);
  }

  void run(std::vector<FoundLine>& lines) {
    int failures = 0;
    while (failures < kMaxFailures && static_cast<int>(lines.size()) < kMaxLines) {
      std::vector<PeakFit> fits = fitStrongest(failures);
      if (fits.empty()) return;
      const auto first = std::find_if(
          fits.begin(), fits.end(), [](const PeakFit& fit) { return !fit.found.support.empty(); });
      failures += static_cast<int>(first - fits.begin());
      if (first == fits.end()) continue;
      failures = 0;
      table_.takeBack(static_cast<std::size_t>(fits.end() - first));
      for (auto fit = first + 1; fit != fits.end(); ++fit) ahead_.keep(std::move(*fit));
      takeAway(first->found.support);
      lines.push_back(std::move(first->found));
    }
  }

 private:
  // At the strongest peak, and if nothing is known of that at the next ones too, each without those
  // before it. A peak without a line changes nothing for the next one: the longer none was found,
  // the more are tried at once. A line elsewhere rarely does, so that there is one for each thread;
  // where the next peak may be of the same wall, it would be for nothing.
  std::vector<PeakFit> fitStrongest(int failures) {
    std::vector<PeakFit> fits;
    const int count = std::min({std::max(crew_.size(), failures), most_, kMaxFailures - failures});
    std::vector<std::size_t> missing;
    while (static_cast<int>(fits.size()) < count) {
      const VoteTable::Peak peak = table_.strongest();
      if (peak.votes < least_votes_) break;
      table_.strikeOut(peak);
      const WallLine guess = table_.lineAt(peak);
      if (failures == 0 && !fits.empty() && mayBeOneWall(guess, fits.front().guess)) {
        table_.takeBack(1);
        break;
      }
      PeakFit fit{guess, {}};
      if (!ahead_.take(guess, fit)) missing.push_back(fits.size());
      fits.push_back(std::move(fit));
      if (missing.empty()) break;
    }
    crew_.run(missing.size(), [&](std::size_t i) { fitAt(fits[missing[i]]); });
    return fits;
  }

  bool mayBeOneWall(const WallLine& a, const WallLine& b) const {
    if (a.normal == b.normal) return std::abs(a.offset - b.offset) < kOneWall * scale_.noise;
    return a.normal.dot(b.normal) > std::cos(kOneDirection);
  }

  void fitAt(PeakFit& fit) const {
    auto& [line, support] = fit.found;
    line = fit.guess;
    support = fitToSupport(points_, candidatesFor(pool_, free_, line, scale_.noise), scale_,
                           options_, line);
    if (line.support_area < options_.min_area) support.clear();
  }

  void takeAway(const std::vector<int>& support) {
    for (const int i : support) free_[static_cast<std::size_t>(i)] = 0;
    table_.vote(support, -1);
    ahead_.forget(points_, support, scale_.noise);
    taken_ += support.size();
    if (static_cast<double>(taken_) > kMostTaken * static_cast<double>(pool_.numbers.size())) {
      pool_.shrink(free_);
      taken_ = 0;
    }
  }

  const std::vector<WallPoint>& points_;
  const WallScale& scale_;
  SupportOptions options_;
  TaskCrew& crew_;
  std::vector<char>& free_;
  VoteTable table_;
  PointPool pool_;
  FitsAhead ahead_;
  double least_votes_;
  int most_;               // peaks at once
  std::size_t taken_ = 0;  // points of the pool
};

void extractGreedily(const std::vector<WallPoint>& points, const WallScale& scale,
                     const WallLineOptions& options, TaskCrew& crew, bool free_direction,
                     std::vector<double> angles, std::vector<char>& free,
                     std::vector<FoundLine>& lines) {
  GreedyPass(points, scale, options, crew, free_direction, std::move(angles), free).run(lines);
}

// Walls at heights with much fewer points than the rest, octave by octave of their density.
void extractThinParts(const std::vector<WallPoint>& points, const WallScale& scale,
                      const HeightDensity& density, const WallLineOptions& options, TaskCrew& crew,
                      const std::vector<double>& locked, const std::vector<double>& all_around,
                      std::vector<char>& free, std::vector<FoundLine>& lines) {
  const double least = kThinnest * scale.density;
  for (double most = kThin * scale.density; most > std::max(least, density.least()); most *= 0.5) {
    WallScale thin = scale;
    thin.density = kThinMiddle * most;
    std::vector<char> free_there = free;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double there = density.at(points[i].z);
      if (there > most || there < least) free_there[i] = 0;
    }
    const std::vector<char> before = free_there;
    if (!locked.empty())
      extractGreedily(points, thin, options, crew, false, locked, free_there, lines);
    extractGreedily(points, thin, options, crew, true, all_around, free_there, lines);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (before[i] != free_there[i]) free[i] = 0;
    }
  }
}

// Facades with much fewer points than the others at the same heights, for they were seen from afar
// or at a flat angle, octave by octave of their density. Clutter is as thin: a line needs a known
// direction, and as many points as the least wall that was seen well.
void extractThinFacades(const std::vector<WallPoint>& points, const WallScale& scale,
                        const WallLineOptions& options, TaskCrew& crew,
                        const std::vector<double>& locked, std::vector<char>& free,
                        std::vector<FoundLine>& lines) {
  const double least = options.min_area * scale.density;
  for (double most = kThinFacade; most > kThinnest; most *= 0.5) {
    WallScale thin = scale;
    thin.density = kThinMiddle * most * scale.density;
    std::vector<char> free_there = free;
    std::vector<FoundLine> found;
    extractGreedily(points, thin, options, crew, false, locked, free_there, found);
    for (FoundLine& facade : found) {
      if (static_cast<double>(facade.support.size()) < least) continue;
      for (const int i : facade.support) free[static_cast<std::size_t>(i)] = 0;
      lines.push_back(std::move(facade));
    }
  }
}

// The heights of the middle half of the points.
std::pair<double, double> middleHeights(const std::vector<WallPoint>& points,
                                        const std::vector<int>& support) {
  std::vector<double> heights;
  for (const int i : support) heights.push_back(points[static_cast<std::size_t>(i)].z);
  std::sort(heights.begin(), heights.end());
  return {heights[heights.size() / 4], heights[3 * heights.size() / 4]};
}

// Two lines over the same support are one wall: window panes, the tails of the noise, a lean.
bool duplicates(const FoundLine& found, const FoundLine& other,
                const std::vector<WallPoint>& points, const WallScale& scale) {
  const WallLine& weak = found.line;
  const WallLine& strong = other.line;
  if (strong.normal.dot(weak.normal) < std::cos(kNearDirection)) return false;
  const auto off = [&](double s) {
    return std::abs(strong.across(weak.offset * weak.normal + s * weak.tangent()));
  };
  const double far = std::max(off(weak.s_min), off(weak.s_max));
  if (far < 1.0 * scale.noise) return true;
  if (far > 4.0 * scale.noise) return false;
  // A wall in front of another lies at other places or heights than it, but for a few strays.
  const auto [low, high] = middleHeights(points, found.support);
  const auto beside = std::count_if(other.support.begin(), other.support.end(), [&](const int i) {
    const WallPoint& p = points[static_cast<std::size_t>(i)];
    const double s = weak.along(p.position);
    return s > weak.s_min && s < weak.s_max && p.z > low && p.z < high;
  });
  return static_cast<double>(beside) > kBeside * static_cast<double>(weak.support);
}

// Whether stronger lines explain nearly all of the support: at corners, where points of two walls
// mix, the greedy search leaves some that a line of their own fits.
bool isLeftover(const std::vector<int>& support, const std::vector<WallLine>& strong,
                const std::vector<WallPoint>& points, double noise) {
  const auto explained = std::count_if(support.begin(), support.end(), [&](const int i) {
    return std::any_of(strong.begin(), strong.end(), [&](const WallLine& other) {
      return explains(other, points[static_cast<std::size_t>(i)], kExplained * noise, noise);
    });
  });
  return static_cast<double>(explained) > kLeftover * static_cast<double>(support.size());
}

// The directions that lines have which are found without knowing any.
std::vector<double> findDirections(const std::vector<WallPoint>& points, const WallScale& scale,
                                   const WallLineOptions& options, TaskCrew& crew,
                                   const std::vector<double>& all_around) {
  std::vector<char> free(points.size(), 1);
  std::vector<FoundLine> lines;
  extractGreedily(points, scale, options, crew, true, all_around, free, lines);
  std::vector<double> oriented;
  for (const double angle : directionsOf(lines)) {
    oriented.push_back(angle);
    oriented.push_back(angle + M_PI);
  }
  return oriented;
}

}  // namespace

std::vector<WallLine> findWallLines(const std::vector<WallPoint>& points, const WallScale& scale,
                                    const HeightDensity& density, const WallLineOptions& options) {
  std::vector<double> all_around(kFreeAngles);
  for (int a = 0; a < kFreeAngles; ++a)
    all_around[static_cast<std::size_t>(a)] = 2.0 * M_PI * a / kFreeAngles;

  TaskCrew crew(threadsFor(options.threads));
  std::vector<double> oriented;
  if (options.steps.locked_directions) {
    oriented = findDirections(points, scale, options, crew, all_around);
  }
  std::vector<char> free(points.size(), 1);
  std::vector<FoundLine> lines;
  if (!oriented.empty()) {
    extractGreedily(points, scale, options, crew, false, oriented, free, lines);
  }

  extractGreedily(points, scale, options, crew, true, all_around, free, lines);
  if (options.steps.thin_heights)
    extractThinParts(points, scale, density, options, crew, oriented, all_around, free, lines);
  if (options.steps.thin_facades && !oriented.empty())
    extractThinFacades(points, scale, options, crew, oriented, free, lines);
  if (options.steps.short_walls && !oriented.empty())
    extractShortWalls(points, scale, density, options, oriented, free, lines);

  std::stable_sort(lines.begin(), lines.end(), [](const FoundLine& a, const FoundLine& b) {
    return a.line.support > b.line.support;
  });
  std::vector<FoundLine> distinct;
  for (FoundLine& found : lines) {
    const auto known = std::find_if(distinct.begin(), distinct.end(), [&](const FoundLine& strong) {
      return duplicates(found, strong, points, scale);
    });
    if (known == distinct.end()) {
      distinct.push_back(std::move(found));
    } else {
      known->line.z_min = std::min(known->line.z_min, found.line.z_min);
      known->line.z_max = std::max(known->line.z_max, found.line.z_max);
    }
  }
  std::vector<WallLine> walls;
  for (const FoundLine& found : distinct) {
    if (!options.steps.leftovers || !isLeftover(found.support, walls, points, scale.noise))
      walls.push_back(found.line);
  }
  return walls;
}

}  // namespace storey::detail
