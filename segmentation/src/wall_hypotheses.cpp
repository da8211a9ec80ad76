// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_ends.h>
#include <storey/segmentation/detail/wall_hypotheses.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kSameDirection = 0.07;  // rad, 4 degrees: as good a guess as any between
constexpr double kMinCrossing = 0.26;    // rad, 15 degrees: flatter lines close nothing
constexpr std::size_t kMaxBetween = 10;  // lines that join ends, of each kind
constexpr std::size_t kMaxThrough = 30;  // lines through ends that are left alone

double sineBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x());
}

bool crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return sineBetween(a, b) > std::sin(kMinCrossing);
}

// Directions (modulo 180 degrees) of the walls, most support first.
std::vector<Eigen::Vector2d> directionsOf(const std::vector<WallLine>& walls) {
  std::vector<Eigen::Vector2d> normals;
  for (const WallLine& wall : walls) {
    const bool known = std::any_of(normals.begin(), normals.end(), [&](const Eigen::Vector2d& n) {
      return sineBetween(n, wall.normal) < kSameDirection;
    });
    if (!known) normals.push_back(wall.normal);
  }
  return normals;
}

struct Hypothesis {
  PlanLine line;
  double height;         // over which walls end there, of both
  std::size_t turn = 0;  // how many likelier ones the same end has
};

bool isLikelier(const Hypothesis& a, const Hypothesis& b) {
  return a.turn != b.turn ? a.turn < b.turn : a.height > b.height;
}

class Hypotheses {
 public:
  Hypotheses(const std::vector<WallLine>& walls, const std::vector<WallEnd>& ends, double noise,
             double corner_gap)
      : walls_(walls),
        noise_(noise),
        reach_(kEndReach * noise + corner_gap),
        directions_(directionsOf(walls)) {
    for (const WallEnd& end : ends) {
      if (!isMet(end)) open_.push_back(end);
    }
    std::stable_sort(open_.begin(), open_.end(),
                     [](const WallEnd& a, const WallEnd& b) { return a.height > b.height; });
  }

  WallHypotheses make() {
    closing_ = likeliest(betweenEnds(true), kMaxBetween);
    // Any two ends have a line of their own: that it passes leaves an end as open as before.
    const std::vector<PlanLine> through = likeliest(throughEnds(), kMaxThrough);
    const std::vector<PlanLine> own = likeliest(betweenEnds(false), kMaxBetween);
    std::vector<PlanLine> lines = closing_;
    lines.insert(lines.end(), through.begin(), through.end());
    lines.insert(lines.end(), own.begin(), own.end());
    return {lines, endsAt(lines)};
  }

 private:
  static bool passes(const Eigen::Vector2d& normal, double offset, const WallEnd& end,
                     double reach) {
    return crosses(normal, end.normal) && std::abs(normal.dot(end.place) - offset) < reach;
  }

  // By a wall that was seen there, itself short of their corner; lines of walls elsewhere pass
  // anywhere.
  bool isMet(const WallEnd& end) const {
    const double margin = 2.0 * reach_;
    return std::any_of(walls_.begin(), walls_.end(), [&](const WallLine& wall) {
      const double s = wall.along(end.place);
      return passes(wall.normal, wall.offset, end, reach_) && s > wall.s_min - margin &&
             s < wall.s_max + margin && wall.z_min < end.z_max && wall.z_max > end.z_min;
    });
  }

  bool isPassed(const WallEnd& end, const std::vector<PlanLine>& lines) const {
    return std::any_of(lines.begin(), lines.end(), [&](const PlanLine& line) {
      return passes(line.normal, line.offset, end, kEndReach * noise_);
    });
  }
  bool isClosed(const WallEnd& end) const { return isPassed(end, closing_); }

  std::vector<WallEnd> endsAt(const std::vector<PlanLine>& lines) const {
    std::vector<WallEnd> ends;
    std::copy_if(open_.begin(), open_.end(), std::back_inserter(ends),
                 [&](const WallEnd& end) { return isPassed(end, lines); });
    return ends;
  }

  // A wall that was not seen joins two that end on it, in one of the known directions or in its
  // own.
  std::vector<Hypothesis> betweenEnds(bool known) const {
    std::vector<Hypothesis> found;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (isClosed(open_[i])) continue;
      for (std::size_t j = i + 1; j < open_.size(); ++j) {
        const WallEnd& a = open_[i];
        const WallEnd& b = open_[j];
        const double common = std::min(a.z_max, b.z_max) - std::max(a.z_min, b.z_min);
        const Eigen::Vector2d between = b.place - a.place;
        if (isClosed(b) || common < kMinEndHeight * noise_) continue;
        if (between.norm() < kMinEndedRun * noise_) continue;
        const Eigen::Vector2d own = Eigen::Vector2d(between.y(), -between.x()).normalized();
        for (const Eigen::Vector2d& normal : known ? directions_ : std::vector{own}) {
          if (!crosses(normal, a.normal) || !crosses(normal, b.normal)) continue;
          if (std::abs(normal.dot(between)) > kEndReach * noise_) continue;
          found.push_back({{normal, 0.5 * normal.dot(a.place + b.place), true},
                           std::min(a.height, b.height),
                           0});
        }
      }
    }
    return found;
  }

  // The commonest direction first, and a line for each end before any has two.
  std::vector<Hypothesis> throughEnds() const {
    std::vector<Hypothesis> found;
    for (const WallEnd& end : open_) {
      if (isClosed(end)) continue;
      std::size_t turn = 0;
      for (const Eigen::Vector2d& normal : directions_) {
        if (!crosses(normal, end.normal)) continue;
        found.push_back({{normal, normal.dot(end.place), true}, end.height, turn++});
      }
    }
    return found;
  }

  std::vector<PlanLine> likeliest(std::vector<Hypothesis> found, std::size_t most) const {
    std::stable_sort(found.begin(), found.end(), isLikelier);
    std::vector<PlanLine> lines;
    for (const Hypothesis& h : found) {
      if (lines.size() >= most) break;
      const bool known = std::any_of(lines.begin(), lines.end(), [&](const PlanLine& line) {
        return line.normal == h.line.normal &&
               std::abs(line.offset - h.line.offset) < kEndReach * noise_;
      });
      if (!known) lines.push_back(h.line);
    }
    return lines;
  }

  const std::vector<WallLine>& walls_;
  double noise_;
  double reach_;  // of the ends at a wall that was seen
  std::vector<Eigen::Vector2d> directions_;
  std::vector<WallEnd> open_;
  std::vector<PlanLine> closing_;  // of a known direction, between two ends
};

}  // namespace

WallHypotheses hypothesiseLines(const std::vector<WallLine>& walls,
                                const std::vector<WallPoint>& points, const WallScale& scale,
                                const HeightDensity& density, double corner_gap,
                                unsigned int threads) {
  if (walls.empty() || points.empty()) return {};
  return Hypotheses(walls, findWallEnds(walls, points, scale, density, threads), scale.noise,
                    corner_gap)
      .make();
}

}  // namespace storey::detail
