// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/point_blocks.h>
#include <storey/segmentation/detail/wall_residue.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kHalf = 5.0;          // of a strip along a wall, noise deviations
constexpr double kWindow = 4.0;        // across a wall, noise deviations: 95 % of its points
constexpr double kBeside = 10.0;       // noise deviations from the middle of the window
constexpr double kFalseAlarms = 0.01;  // expected in all
constexpr double kLeastBeside = 0.5;   // points: of none beside a window little is known

// A point: the number of the half of a strip that it is in, and the place across.
using Placed = std::pair<int, double>;

// ln of Chernoff's bound of the probability that so many points fall where `expected` do, negative.
double clarityOf(double count, double expected) {
  return count > expected ? count * std::log(count / expected) - (count - expected) : 0.0;
}

class Search {
 public:
  Search(const std::vector<WallPoint>& points, const std::vector<char>& left, double noise)
      : points_(points), blocks_(points), noise_(noise) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (left[i] != 0) left_.push_back(i);
    }
  }

  std::vector<DensePlace> run(const std::vector<double>& angles, unsigned int threads) const {
    std::vector<Findings> found(angles.size());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
    for (std::ptrdiff_t a = 0; a < static_cast<std::ptrdiff_t>(angles.size()); ++a) {
      const auto direction = static_cast<std::size_t>(a);
      found[direction] = searchDirection(angles[direction]);
    }
    std::vector<DensePlace> places;
    std::size_t windows = 0;
    for (const Findings& of_direction : found) {
      places.insert(places.end(), of_direction.places.begin(), of_direction.places.end());
      windows += of_direction.windows;
    }
    const double least = std::log(static_cast<double>(windows) / kFalseAlarms);
    keepClear(least, places);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 16)
    for (std::ptrdiff_t p = 0; p < static_cast<std::ptrdiff_t>(places.size()); ++p) {
      DensePlace& place = places[static_cast<std::size_t>(p)];
      place.clarity = clarityAmongAll(place);
    }
    keepClear(least, places);
    std::stable_sort(places.begin(), places.end(), [](const DensePlace& a, const DensePlace& b) {
      return a.clarity > b.clarity;
    });
    return places;
  }

 private:
  struct Findings {
    std::vector<DensePlace> places;
    std::size_t windows = 0;  // tests made
  };

  static void keepClear(double least, std::vector<DensePlace>& places) {
    const auto unclear = [&](const DensePlace& place) { return place.clarity < least; };
    places.erase(std::remove_if(places.begin(), places.end(), unclear), places.end());
  }

  // Strips overlap by half, so that every wall as long as a strip and a half fills one: strip k has
  // the points of halves k and k + 1.
  Findings searchDirection(double angle) const {
    Findings found;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const std::vector<Placed> placed = placedAlong(normal);
    const auto search = [&](int strip, const std::vector<double>& across) {
      DensePlace place = clearestOf(across);
      place.normal = normal;
      place.s_min = kHalf * noise_ * strip;
      place.s_max = place.s_min + 2.0 * kHalf * noise_;
      if (place.clarity > 0.0) found.places.push_back(place);
      found.windows += across.size();
    };
    std::vector<double> own, next, both;
    const auto take = [&](std::size_t from, int half, std::vector<double>& across) {
      across.clear();
      for (; from < placed.size() && placed[from].first == half; ++from) {
        across.push_back(placed[from].second);
      }
    };
    for (std::size_t from = 0; from < placed.size(); from += own.size()) {
      const int half = placed[from].first;
      take(from, half, own);
      if (from == 0 || placed[from - 1].first != half - 1) search(half - 1, own);
      take(from + own.size(), half + 1, next);
      both.resize(own.size() + next.size());
      std::merge(own.begin(), own.end(), next.begin(), next.end(), both.begin());
      search(half, both);
    }
    return found;
  }

  // The points that may be of walls with this normal, half by half and then across.
  std::vector<Placed> placedAlong(const Eigen::Vector2d& normal) const {
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    const double agreement = std::cos(kVoteAngle);
    std::vector<Placed> placed;
    for (const std::size_t i : left_) {
      const WallPoint& p = points_[i];
      if (normal.dot(p.normal) < agreement) continue;
      const double half = std::floor(tangent.dot(p.position) / (kHalf * noise_));
      placed.emplace_back(static_cast<int>(half), normal.dot(p.position));
    }
    std::sort(placed.begin(), placed.end());
    return placed;
  }

  // The clearest window of a strip that begins at a point, given the points' places in order.
  DensePlace clearestOf(const std::vector<double>& across) const {
    DensePlace best;
    const double width = kWindow * noise_;
    std::size_t before = 0, first = 0, end = 0, after = 0;  // points below the four bounds
    const auto advance = [&](std::size_t& point, double bound) {
      while (point < across.size() && across[point] < bound) ++point;
    };
    for (const double low : across) {
      const double middle = low + 0.5 * width;
      advance(before, middle - kBeside * noise_);
      advance(first, low);
      advance(end, low + width);
      advance(after, middle + kBeside * noise_);
      const double expected =
          expectedOf(static_cast<double>(first - before), static_cast<double>(after - end));
      const double clarity = clarityOf(static_cast<double>(end - first), expected);
      if (clarity <= best.clarity) continue;
      best.clarity = clarity;
      best.offset = middle;
    }
    return best;
  }

  // Of the points in the window, by the side with more: clutter may end there.
  static double expectedOf(double one_side, double other_side) {
    constexpr double kSide = kBeside - 0.5 * kWindow;
    return std::max(kLeastBeside, std::max(one_side, other_side) * kWindow / kSide);
  }

  // Counting beside it the points of walls too: what strays from one is no wall of its own.
  double clarityAmongAll(const DensePlace& place) const {
    const Eigen::Vector2d tangent(-place.normal.y(), place.normal.x());
    const double agreement = std::cos(kVoteAngle);
    double on = 0.0;
    double sides[2] = {0.0, 0.0};
    const PlanStrip around{place.normal, place.offset, kBeside * noise_, place.s_min, place.s_max};
    blocks_.forEachIn(around, [&](std::size_t b) {
      for (std::size_t i = blocks_.begin(b); i < blocks_.end(b); ++i) {
        const WallPoint& p = points_[i];
        const double s = tangent.dot(p.position);
        if (s < place.s_min || s > place.s_max || place.normal.dot(p.normal) < agreement) continue;
        const double d = (place.normal.dot(p.position) - place.offset) / noise_;
        if (std::abs(d) <= 0.5 * kWindow) {
          on += 1.0;
        } else if (std::abs(d) < kBeside) {
          sides[d > 0.0 ? 0 : 1] += 1.0;
        }
      }
    });
    return clarityOf(on, expectedOf(sides[0], sides[1]));
  }

  const std::vector<WallPoint>& points_;
  PointBlocks blocks_;
  double noise_;
  std::vector<std::size_t> left_;
};

}  // namespace

std::vector<DensePlace> findDensePlaces(const std::vector<WallPoint>& points,
                                        const std::vector<char>& left,
                                        const std::vector<double>& angles, double noise,
                                        unsigned int threads) {
  return Search(points, left, noise).run(angles, threads);
}

}  // namespace storey::detail
