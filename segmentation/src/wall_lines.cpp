// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/even_draw.h>
#include <storey/filters/detail/task_crew.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/found_line.h>
#include <storey/segmentation/detail/short_walls.h>
#include <storey/segmentation/detail/wall_density.h>
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
constexpr int kAhead = 4;                 // peaks tried at once, most, for each thread
constexpr int kMaxLines = 400;            // cells grow with their square
constexpr double kBeside = 0.25;          // points of the stronger line, of the weaker's support
constexpr double kExplained = 2.5;        // noise deviations across a line
constexpr double kLeftover = 0.8;         // of the support; a wall 2 deviations beside has 0.69

// The strongest windows, each without those before it, which are struck out.
std::vector<VoteTable::Peak> strikePeaks(VoteTable& table, double least_votes, std::size_t most) {
  std::vector<VoteTable::Peak> peaks;
  while (peaks.size() < most) {
    const VoteTable::Peak peak = table.strongest();
    if (peak.votes < least_votes) break;
    peaks.push_back(peak);
    table.strikeOut(peak);
  }
  return peaks;
}

// The line at each of the peaks; without support where none is found.
std::vector<FoundLine> fitPeaks(const PointPool& pool, const WallScale& scale,
                                const SupportOptions& options, const std::vector<char>& free,
                                const VoteTable& table, const std::vector<VoteTable::Peak>& peaks,
                                TaskCrew& crew) {
  std::vector<FoundLine> lines(peaks.size());
  crew.run(peaks.size(), [&](std::size_t i) {
    auto& [line, support] = lines[i];
    line = table.lineAt(peaks[i]);
    support = fitToSupport(pool.points, candidatesFor(pool, free, line, scale.noise), scale,
                           options, line);
    if (line.support_area < options.min_area) support.clear();
  });
  return lines;
}

// One greedy pass: strongest line, its support, take its points away, again. A peak without a line
// changes nothing for the next one: the longer none was found, the more peaks are tried at once.
void extractGreedily(const std::vector<WallPoint>& points, const WallScale& scale,
                     const WallLineOptions& options, TaskCrew& crew, bool free_direction,
                     std::vector<double> angles, std::vector<char>& free,
                     std::vector<FoundLine>& lines) {
  VoteTable table(points, std::move(angles), scale.noise * (free_direction ? kFreeBin : kLockedBin),
                  free_direction ? kFreeWindow : kLockedWindow, crew);
  const PointPool pool(points, free);
  table.vote(pool.numbers, 1);
  SupportOptions support_options;
  support_options.fit_direction = free_direction;
  support_options.min_area = options.min_area;
  support_options.steps = options.steps;
  const double least_votes = std::max(10.0, kMinVotes * options.min_area * scale.density);
  const int most = crew.size() > 1 ? kAhead * crew.size() : 1;
  for (int failures = 0; failures < kMaxFailures && static_cast<int>(lines.size()) < kMaxLines;) {
    const int ahead = std::min({std::max(1, failures), most, kMaxFailures - failures});
    const std::vector<VoteTable::Peak> peaks =
        strikePeaks(table, least_votes, static_cast<std::size_t>(ahead));
    if (peaks.empty()) return;
    std::vector<FoundLine> found = fitPeaks(pool, scale, support_options, free, table, peaks, crew);
    const auto first = std::find_if(found.begin(), found.end(),
                                    [](const FoundLine& line) { return !line.support.empty(); });
    failures += static_cast<int>(first - found.begin());
    if (first == found.end()) continue;
    failures = 0;
    table.takeBack(static_cast<std::size_t>(found.end() - first));
    for (const int i : first->support) free[static_cast<std::size_t>(i)] = 0;
    table.vote(first->support, -1);
    lines.push_back(std::move(*first));
  }
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
                                    const WallLineOptions& options) {
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
  const HeightDensity density(points, scale, options.threads);
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
