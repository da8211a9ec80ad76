// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/assignment.h>
#include <storey/segmentation/detail/segment_linking.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

namespace storey::detail {
namespace {

// Lines that differ by less are parallel: their intersection says nothing.
constexpr double kParallelAngle = 0.05;  // rad, 3 degrees
// A fitted direction further off its label than this is not trusted.
constexpr double kMaxTurnFromPrior = 0.35;  // rad, 20 degrees
// A detour over a corner may be so much longer than the straight gap; right angles need sqrt(2).
constexpr double kMaxCornerDetour = 1.6;
// A closing edge is a guess, extending two walls to their corner is not: prefer the corner.
constexpr double kHypothesisPenalty = 1.5;
// Leaving a segment out costs this many times its length of missing wall.
constexpr double kDropPenalty = 2.0;
// Cutting a wall back contradicts its points: dearer than extending it.
constexpr double kCutPenalty = 2.0;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d intersect(const Eigen::Vector2d& n1, double d1, const Eigen::Vector2d& n2,
                          double d2) {
  const double det = cross(n1, n2);
  return {(d1 * n2.y() - d2 * n1.y()) / det, (n1.x() * d2 - n2.x() * d1) / det};
}

// How one segment goes on in another one.
struct Link {
  double cost = 0.0;   // length of missing wall, with penalties
  bool corner = true;  // the two lines meet; otherwise a hypothetical edge joins them
};

Link linkBetween(const LineSegment& from, const LineSegment& to, double tolerance) {
  const Eigen::Vector2d gap = to.start - from.end;
  Link link;
  link.cost = kHypothesisPenalty * gap.norm();
  link.corner = false;
  const Eigen::Vector2d t1 = from.tangent();
  const Eigen::Vector2d t2 = to.tangent();
  const double turn = std::atan2(cross(t1, t2), t1.dot(t2));
  if (std::abs(turn) < kParallelAngle) {
    // The same wall after a hole: nothing to add if it goes straight on.
    const double along = gap.dot(t1);
    const double aside = std::abs(gap.dot(from.normal));
    const double cost = (along < 0.0 ? -kCutPenalty * along : along) + kHypothesisPenalty * aside;
    link.cost = std::min(link.cost, cost);
    return link;
  }
  const double sine = cross(t1, t2);
  if (std::abs(sine) < std::sin(kParallelAngle)) return link;  // antiparallel
  // gap = ahead t1 + behind t2: what the two walls lack up to their corner, < 0 what they
  // overshoot.
  const double ahead = cross(gap, t2) / sine;
  const double behind = cross(t1, gap) / sine;
  const auto signed_cost = [](double x) { return x < 0.0 ? -kCutPenalty * x : x; };
  const double cost = signed_cost(ahead) + signed_cost(behind);
  const bool cuts_too_much = ahead < -0.5 * from.length() || behind < -0.5 * to.length();
  // Ends are scattered before and behind their corner; within the tolerance they are its vertex.
  const bool meet = std::abs(ahead) <= tolerance && std::abs(behind) <= tolerance;
  const bool detour = std::abs(ahead) + std::abs(behind) > kMaxCornerDetour * gap.norm();
  if (!cuts_too_much && (meet || cost <= link.cost || !detour)) {
    link.corner = true;
    link.cost = std::min(cost, link.cost);
  }
  return link;
}

std::vector<int> linkOptimally(const std::vector<LineSegment>& segments,
                               const LinkingOptions& options) {
  const std::size_t n = segments.size();
  std::vector<double> cost(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double c = linkBetween(segments[i], segments[j], options.tolerance).cost;
      // A gap beyond t is as bad as leaving both segments out.
      if (c > options.max_gap) c += kDropPenalty * (segments[i].length() + segments[j].length());
      cost[i * n + j] = i == j ? kDropPenalty * segments[i].length() : c;
    }
  }
  std::vector<int> next = solveAssignment(cost, static_cast<int>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (next[i] == static_cast<int>(i)) next[i] = -1;
  }
  return next;
}

// Algorithm 1, lines 1 to 11, growing both ends of the path. It stops as well when the two ends of
// the path are nearer to each other than to any free segment: the component is closed.
std::vector<int> linkGreedily(const std::vector<LineSegment>& segments,
                              const LinkingOptions& options) {
  const int n = static_cast<int>(segments.size());
  const auto at = [&](int i) -> const LineSegment& {
    return segments[static_cast<std::size_t>(i)];
  };
  const auto costBetween = [&](int i, int j) {
    return linkBetween(at(i), at(j), options.tolerance).cost;
  };
  std::vector<int> next(segments.size(), -1);
  std::vector<char> free(segments.size(), 1);
  while (true) {
    int longest = -1;
    for (int i = 0; i < n; ++i) {
      if (free[static_cast<std::size_t>(i)] &&
          (longest < 0 || at(i).length() > at(longest).length()))
        longest = i;
    }
    if (longest < 0) return next;
    free[static_cast<std::size_t>(longest)] = 0;
    int first = longest;
    int last = longest;
    while (true) {
      int best = -1;
      bool at_end = true;
      double best_cost =
          first == last ? options.max_gap : std::min(options.max_gap, costBetween(last, first));
      for (int i = 0; i < n; ++i) {
        if (!free[static_cast<std::size_t>(i)]) continue;
        const double after = costBetween(last, i);
        const double before = costBetween(i, first);
        if (std::min(after, before) < best_cost) {
          best = i;
          at_end = after <= before;
          best_cost = std::min(after, before);
        }
      }
      if (best < 0) break;
      free[static_cast<std::size_t>(best)] = 0;
      next[static_cast<std::size_t>(at_end ? last : best)] = at_end ? best : first;
      (at_end ? last : first) = best;
    }
    if (first != last) next[static_cast<std::size_t>(last)] = first;
  }
}

// An edge of a ring under construction: an oriented line and what it stands for.
struct RingLine {
  Eigen::Vector2d normal;
  double offset = 0.0;    // normal . x = offset on the line
  double weight = 0.0;    // length seen
  Eigen::Vector2d start;  // where it was seen, or guessed
  Eigen::Vector2d end;
  bool hypothetical = false;

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
};

bool parallel(const RingLine& a, const RingLine& b) {
  return std::abs(cross(a.normal, b.normal)) < std::sin(kParallelAngle);
}

// Completion (Fig. 5a): a hypothetical edge from the end of one segment to the start of the next,
// turned about its centre to the nearest dominant direction that crosses both neighbours.
RingLine completionLine(const LineSegment& from, const LineSegment& to,
                        const std::vector<Eigen::Vector2d>& directions) {
  const Eigen::Vector2d gap = to.start - from.end;
  const Eigen::Vector2d centre = 0.5 * (to.start + from.end);
  Eigen::Vector2d tangent = gap.normalized();
  const auto crosses = [&](const Eigen::Vector2d& t) {
    return std::abs(cross(t, from.tangent())) > std::sin(kParallelAngle) &&
           std::abs(cross(t, to.tangent())) > std::sin(kParallelAngle);
  };
  double best = -1.0;
  for (const Eigen::Vector2d& normal : directions) {
    const Eigen::Vector2d candidate(-normal.y(), normal.x());
    if (crosses(candidate) && candidate.dot(gap) > best) {
      best = candidate.dot(gap);
      tangent = candidate;
    }
  }
  if (best <= 0.0 && !crosses(tangent)) {
    // Along the wall itself: a jog, square to it, to the side where the next wall lies.
    tangent = from.normal * (gap.dot(from.normal) >= 0.0 ? 1.0 : -1.0);
  }
  RingLine line;
  line.normal = {tangent.y(), -tangent.x()};
  line.offset = line.normal.dot(centre);
  line.weight = gap.norm();
  line.start = centre - 0.5 * gap.dot(tangent) * tangent;
  line.end = centre + 0.5 * gap.dot(tangent) * tangent;
  line.hypothetical = true;
  return line;
}

RingLine lineOf(const LineSegment& segment) {
  RingLine line;
  line.normal = segment.normal;
  line.offset = segment.normal.dot(0.5 * (segment.start + segment.end));
  line.weight = segment.length();
  line.start = segment.start;
  line.end = segment.end;
  return line;
}

// Whether both ends of the shorter line lie on the longer one.
bool sameLine(const RingLine& a, const RingLine& b, double tolerance) {
  const RingLine& longer = a.weight >= b.weight ? a : b;
  const RingLine& shorter = a.weight >= b.weight ? b : a;
  return a.normal.dot(b.normal) > 0.0 &&
         std::abs(longer.normal.dot(shorter.start) - longer.offset) < tolerance &&
         std::abs(longer.normal.dot(shorter.end) - longer.offset) < tolerance;
}

// The line through the supports of both, `a` coming before `b` along the ring.
RingLine mergeLines(const RingLine& a, const RingLine& b) {
  RingLine merged = a;
  merged.weight = a.weight + b.weight;
  merged.normal = (a.weight * a.normal + b.weight * b.normal).normalized();
  const Eigen::Vector2d middle_a = 0.5 * (a.start + a.end);
  const Eigen::Vector2d middle_b = 0.5 * (b.start + b.end);
  merged.offset = merged.normal.dot(a.weight * middle_a + b.weight * middle_b) / merged.weight;
  merged.end = b.end;
  merged.hypothetical = a.hypothetical && b.hypothetical;
  return merged;
}

Eigen::Vector2d vertexBetween(const RingLine& a, const RingLine& b) {
  return intersect(a.normal, a.offset, b.normal, b.offset);
}

// Merging and redundancy elimination (Fig. 5b-d): collinear neighbours become one line; an edge
// shorter than the tolerance goes if its neighbours then meet. The shortest goes first.
bool eliminateOne(std::vector<RingLine>& lines, double tolerance) {
  const std::size_t n = lines.size();
  const auto vertex = [&](std::size_t i) {
    return vertexBetween(lines[(i + n - 1) % n], lines[i]);
  };
  std::optional<std::size_t> shortest;
  double least = tolerance;
  for (std::size_t i = 0; i < n; ++i) {
    const RingLine& before = lines[(i + n - 1) % n];
    const RingLine& after = lines[(i + 1) % n];
    if (parallel(before, lines[i]) || parallel(lines[i], after)) continue;
    const double length = (vertex((i + 1) % n) - vertex(i)).dot(lines[i].tangent());
    if (length < least && (!parallel(before, after) || sameLine(before, after, tolerance))) {
      least = length;
      shortest = i;
    }
  }
  if (!shortest) return false;
  const std::size_t i = *shortest;
  const std::size_t after = (i + 1) % n;
  const std::size_t before = (i + n - 1) % n;
  if (parallel(lines[before], lines[after])) {
    lines[before] = mergeLines(lines[before], lines[after]);
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(std::max(i, after)));
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(std::min(i, after)));
  } else {
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return true;
}

}  // namespace

LineSegment fitSegment(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& outward,
                       double prior_angle) {
  LineSegment segment;
  segment.support = points.size();
  if (points.empty()) return segment;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) covariance += (p - mean) * (p - mean).transpose();
  covariance /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  segment.normal = eigen.eigenvectors().col(0);
  if (segment.normal.dot(outward) < 0.0) segment.normal = -segment.normal;
  // Standard deviation of a fitted angle: residual / (sqrt(n) x spread along the line).
  const double along = std::sqrt(std::max(eigen.eigenvalues()(1), 1e-300));
  const double across = std::sqrt(std::max(eigen.eigenvalues()(0), 0.0));
  const double angle = across / (std::sqrt(static_cast<double>(points.size())) * along);
  const double turned = std::acos(std::clamp(segment.normal.dot(outward), -1.0, 1.0));
  if (angle > prior_angle || turned > kMaxTurnFromPrior) segment.normal = outward.normalized();
  const Eigen::Vector2d tangent = segment.tangent();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double squared = 0.0;
  for (const Eigen::Vector2d& p : points) {
    const double s = tangent.dot(p - mean);
    low = std::min(low, s);
    high = std::max(high, s);
    squared += std::pow(segment.normal.dot(p - mean), 2);
  }
  segment.residual = std::sqrt(squared / static_cast<double>(points.size()));
  segment.start = mean + low * tangent;
  segment.end = mean + high * tangent;
  return segment;
}

std::vector<int> linkSegments(const std::vector<LineSegment>& segments,
                              const LinkingOptions& options) {
  if (segments.empty()) return {};
  return options.method == LinkingMethod::Optimal ? linkOptimally(segments, options)
                                                  : linkGreedily(segments, options);
}

FloorplanRing closeRing(const std::vector<LineSegment>& cycle, const LinkingOptions& options) {
  std::vector<RingLine> lines;
  const auto append = [&](const RingLine& line) {
    if (!lines.empty() && sameLine(lines.back(), line, options.tolerance)) {
      lines.back() = mergeLines(lines.back(), line);
    } else {
      lines.push_back(line);
    }
  };
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const LineSegment& next = cycle[(i + 1) % cycle.size()];
    append(lineOf(cycle[i]));
    if (linkBetween(cycle[i], next, options.tolerance).corner ||
        sameLine(lineOf(cycle[i]), lineOf(next), options.tolerance)) {
      continue;
    }
    lines.push_back(completionLine(cycle[i], next, options.directions));
  }
  if (lines.size() > 3 && sameLine(lines.back(), lines.front(), options.tolerance)) {
    lines.front() = mergeLines(lines.back(), lines.front());
    lines.pop_back();
  }
  while (lines.size() > 3 && eliminateOne(lines, options.tolerance)) {
  }
  FloorplanRing ring;
  const std::size_t n = lines.size();
  if (n < 3) return ring;
  for (std::size_t i = 0; i < n; ++i) {
    const RingLine& before = lines[(i + n - 1) % n];
    if (parallel(before, lines[i])) return {};  // lines that never meet: no ring
    ring.vertices.push_back(vertexBetween(before, lines[i]));
    ring.edges.push_back({-1, lines[i].hypothetical});
  }
  return ring;
}

}  // namespace storey::detail
