// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_bends.h>
#include <storey/segmentation/detail/wall_moments.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kDeviations = 5.0;  // of places and of normals: there are many places for a bend
constexpr double kLeast = 1.0;       // noise deviations that the shorter side turns away

// What a second line from s = b on adds to the slope of the first, and how many deviations that is.
struct Bend {
  double slope = 0.0;
  double deviations = 0.0;
};

// Least squares of d over 1, s and max(0, s - b). \param after of the points beyond b
Bend bendAt(double b, const WallMoments& all, const WallMoments& after, double noise) {
  const double spread = all.spread();
  if (!(spread > 0.0)) return {};
  const double sum = after.s - b * after.n;
  const double slant = (after.ss - b * after.s - sum * all.s / all.n) / spread;
  const double square = after.ss - 2.0 * b * after.s + b * b * after.n;
  const double left = square - sum * sum / all.n - slant * slant * spread;
  constexpr double kRounding = 1e-9;
  if (!(left > kRounding * square)) return {};
  const double product =
      after.sd - b * after.d - sum * all.d / all.n - slant * (all.sd - all.s * all.d / all.n);
  return {product / left, product / (std::sqrt(left) * noise)};
}

// How many deviations the mean normals of two parts of a wall differ; positive where the second
// part has the larger slope d(s).
double turnBetween(const WallMoments& a, const WallMoments& b) {
  const double scatter = a.tt - a.t * a.t / a.n + b.tt - b.t * b.t / b.n;  // about either mean
  const double variance = scatter / (a.n + b.n) * (1.0 / a.n + 1.0 / b.n);
  return variance > 0.0 ? (a.t / a.n - b.t / b.n) / std::sqrt(variance) : 0.0;
}

// The points in columns along the line, from their first place on.
std::vector<WallMoments> columnsOf(const std::vector<WallPoint>& points, const LinePoints& support,
                                   const WallLine& line, double width) {
  const auto [low, high] = rangeOf(support.s);
  std::vector<WallMoments> columns(static_cast<std::size_t>((high - low) / width) + 1);
  for (std::size_t k = 0; k < support.size(); ++k) {
    const WallPoint& p = points[static_cast<std::size_t>(support.number[k])];
    const double s = support.s[k] - low;
    columns[static_cast<std::size_t>(s / width)].add(WallMoments::of(p, s, line));
  }
  return columns;
}

// How far from the first column the clearest bend is; 0 if there is none.
double clearestBend(const std::vector<WallMoments>& columns, double width, double noise) {
  WallMoments all;
  for (const WallMoments& column : columns) all.add(column);
  double most = 0.0;
  double place = 0.0;
  WallMoments before;
  for (std::size_t c = 0; c + 1 < columns.size(); ++c) {
    before.add(columns[c]);
    const WallMoments after = all - before;
    if (before.n < 2.0 || after.n < 2.0) continue;
    const double b = width * static_cast<double>(c + 1);
    const double shorter = std::min(b, width * static_cast<double>(columns.size()) - b);
    const Bend bend = bendAt(b, all, after, noise);
    const double turn = turnBetween(before, after);
    if (std::min(std::abs(bend.deviations), std::abs(turn)) < kDeviations) continue;
    if (bend.deviations * turn < 0.0 || std::abs(bend.slope) * shorter < kLeast * noise) continue;
    const double clarity = bend.deviations * bend.deviations + turn * turn;
    if (clarity <= most) continue;
    most = clarity;
    place = b;
  }
  return place;
}

}  // namespace

LinePoints onOneSideOfBend(const std::vector<WallPoint>& points, LinePoints support,
                           const WallScale& scale, const WallLine& line) {
  const double width = supportCellSize(scale);
  while (!support.empty()) {
    const double place = clearestBend(columnsOf(points, support, line, width), width, scale.noise);
    if (!(place > 0.0)) break;
    const double bend = rangeOf(support.s).first + place;
    const auto before =
        std::count_if(support.s.begin(), support.s.end(), [&](double s) { return s < bend; });
    const bool first_side = 2 * static_cast<std::size_t>(before) >= support.size();
    support.keepWhere([&](std::size_t k) { return (support.s[k] < bend) == first_side; });
  }
  return support;
}

}  // namespace storey::detail
