// SPDX-License-Identifier: BSD-3-Clause
#include "synth/building_rules.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace storey::synth {
namespace {

using Eigen::Vector2d;

struct Segment {
  Vector2d from, to;
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distanceToSegment(const Vector2d& point, const Segment& segment) {
  const Vector2d along = segment.to - segment.from;
  const double t = along.dot(point - segment.from) / along.squaredNorm();
  return (point - segment.from - std::clamp(t, 0.0, 1.0) * along).norm();
}

bool properlyCross(const Segment& a, const Segment& b) {
  const Vector2d u = a.to - a.from;
  const Vector2d v = b.to - b.from;
  return cross(u, b.from - a.from) * cross(u, b.to - a.from) < 0.0 &&
         cross(v, a.from - b.from) * cross(v, a.to - b.from) < 0.0;
}

double distanceBetween(const Segment& a, const Segment& b) {
  if (properlyCross(a, b)) {
    return 0.0;
  }
  return std::min({distanceToSegment(a.from, b), distanceToSegment(a.to, b),
                   distanceToSegment(b.from, a), distanceToSegment(b.to, a)});
}

Segment segmentOf(const Outline& outline, std::size_t edge) {
  return {outline[edge], outline[(edge + 1) % outline.size()]};
}

std::vector<Segment> segmentsOf(const Stage& stage) {
  std::vector<Segment> segments;
  const auto add = [&](const Outline& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      segments.push_back(segmentOf(outline, i));
    }
  };
  for (const Part& part : stage.parts) {
    add(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add);
  }
  return segments;
}

bool inside(const Outline& outline, const Vector2d& point) {
  bool odd = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Segment edge = segmentOf(outline, i);
    if ((edge.from.y() > point.y()) != (edge.to.y() > point.y())) {
      const double t = (point.y() - edge.from.y()) / (edge.to.y() - edge.from.y());
      odd ^= point.x() < edge.from.x() + t * (edge.to.x() - edge.from.x());
    }
  }
  return odd;
}

bool inside(const Part& part, const Vector2d& point) {
  return inside(part.outer, point) &&
         std::none_of(part.holes.begin(), part.holes.end(),
                      [&](const Outline& hole) { return inside(hole, point); });
}

bool inside(const Stage& stage, const Vector2d& point) {
  return std::any_of(stage.parts.begin(), stage.parts.end(),
                     [&](const Part& part) { return inside(part, point); });
}

/// Corners neither too sharp nor too flat, edges long enough, no edge near another.
bool isClearOutline(const Outline& outline, const BuildingRules& rules) {
  const std::size_t n = outline.size();
  if (n < 3 || signedArea(outline) <= 0.0) {
    return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d in = outline[i] - outline[(i + n - 1) % n];
    const Vector2d out = outline[(i + 1) % n] - outline[i];
    const double turn = std::abs(std::atan2(cross(in, out), in.dot(out)));
    // Not written as a < so that a corner that is not a number fails too.
    if (!(out.norm() >= rules.shortest_edge && turn >= rules.sharpest_corner &&
          turn <= M_PI - rules.sharpest_corner)) {
      return false;
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j == n - 1;
      if (!neighbours &&
          distanceBetween(segmentOf(outline, i), segmentOf(outline, j)) < rules.between_edges) {
        return false;
      }
    }
  }
  return true;
}

double distanceBetween(const Outline& a, const Outline& b) {
  double least = INFINITY;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      least = std::min(least, distanceBetween(segmentOf(a, i), segmentOf(b, j)));
    }
  }
  return least;
}

bool isClearPart(const Part& part, const BuildingRules& rules) {
  return isClearOutline(part.outer, rules) &&
         std::all_of(part.holes.begin(), part.holes.end(), [&](const Outline& hole) {
           return isClearOutline(hole, rules) && inside(part.outer, hole[0]) &&
                  distanceBetween(part.outer, hole) >= rules.between_edges;
         });
}

bool isClearStage(const Stage& stage, const BuildingRules& rules) {
  for (std::size_t i = 0; i < stage.parts.size(); ++i) {
    if (!isClearPart(stage.parts[i], rules)) {
      return false;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Outline& a = stage.parts[i].outer;
      const Outline& b = stage.parts[j].outer;
      if (distanceBetween(a, b) < rules.between_edges || inside(a, b[0]) || inside(b, a[0])) {
        return false;
      }
    }
  }
  return !stage.parts.empty();
}

constexpr double kOnLine = 1e-6;  // rounding of outlines about 30 wide stays below

bool arePlanesApart(const std::vector<Segment>& segments, const BuildingRules& rules) {
  for (const Segment& a : segments) {
    const Vector2d along = (a.to - a.from).normalized();
    for (const Segment& b : segments) {
      const bool parallel = std::abs(cross(along, (b.to - b.from).normalized())) < kOnLine;
      const double distance = std::abs(cross(along, b.from - a.from));
      if (parallel && distance > kOnLine && distance < rules.between_planes) {
        return false;
      }
    }
  }
  return true;
}

bool areCornersApart(const std::vector<Segment>& corners, const std::vector<Segment>& edges,
                     const BuildingRules& rules) {
  for (const Segment& corner : corners) {
    for (const Segment& edge : edges) {
      const double distance = distanceToSegment(corner.from, edge);
      if (distance > kOnLine && distance < rules.between_storeys) {
        return false;
      }
      const bool on_edge = distance <= kOnLine;
      const double to_end =
          std::min((corner.from - edge.from).norm(), (corner.from - edge.to).norm());
      if (on_edge && to_end > kOnLine && to_end < rules.between_storeys) {
        return false;
      }
    }
  }
  return true;
}

/// Whether some point of a 24 x 24 raster of the part's box lies in it and in the stage below.
bool standsOn(const Part& part, const Stage& below) {
  constexpr int kRaster = 24;
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : part.outer) {
    box.extend(corner);
  }
  for (int i = 0; i < kRaster * kRaster; ++i) {
    const Eigen::Array2d at((i % kRaster + 0.5) / kRaster, (i / kRaster + 0.5) / kRaster);
    const Vector2d point = box.min() + (at * box.sizes().array()).matrix();
    if (inside(part, point) && inside(below, point)) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool obeysRules(const std::vector<Stage>& stages, const BuildingRules& rules) {
  std::vector<Segment> all;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!isClearStage(stages[i], rules)) {
      return false;
    }
    const std::vector<Segment> here = segmentsOf(stages[i]);
    all.insert(all.end(), here.begin(), here.end());
    if (i == 0) {
      continue;
    }
    const std::vector<Segment> below = segmentsOf(stages[i - 1]);
    const bool stands =
        std::all_of(stages[i].parts.begin(), stages[i].parts.end(),
                    [&](const Part& part) { return standsOn(part, stages[i - 1]); });
    if (!stands || !areCornersApart(here, below, rules) || !areCornersApart(below, here, rules)) {
      return false;
    }
  }
  return !stages.empty() && arePlanesApart(all, rules);
}

}  // namespace storey::synth
