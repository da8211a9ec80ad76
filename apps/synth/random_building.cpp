// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "synth/building_rules.h"
#include "synth/buildings.h"
#include "synth/outlines.h"
#include "synth/random.h"

namespace storey::synth {
namespace {

using Eigen::Vector2d;

constexpr double kNearPair = 0.25;   // 2.5 deviations of the paper's noise of 0.1
constexpr int kMaxWalls = 16;        // of one component, courtyards apart
constexpr int kTriesPerChange = 60;  // most changes that fail do so for lack of room

/// Outward normals that a building may have: some axes, each in both senses, in rising order.
std::vector<double> drawDirections(Random& random) {
  if (random.chance(0.3)) {
    return {0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI};
  }
  constexpr double kLeastAngle = 0.25;  // 14 degrees
  const int count = 2 + random.below(4);
  std::vector<double> axes = {0.0};
  for (int tries = 0; static_cast<int>(axes.size()) < count && tries < 200; ++tries) {
    const double axis = random.uniform(kLeastAngle, M_PI - kLeastAngle);
    const bool apart = std::all_of(axes.begin(), axes.end(), [&](double other) {
      return std::abs(axis - other) >= kLeastAngle;
    });
    if (apart) {
      axes.push_back(axis);
    }
  }
  std::sort(axes.begin(), axes.end());
  std::vector<double> directions = axes;
  for (const double axis : axes) {
    directions.push_back(axis + M_PI);
  }
  return directions;
}

/// A convex outline with some of the directions, about `radius` wide in each.
Outline drawConvex(Random& random, const std::vector<double>& directions, double radius) {
  std::vector<double> angles;
  std::vector<double> distances;
  for (const double angle : directions) {
    if (directions.size() <= 4 || random.chance(0.75)) {
      angles.push_back(angle);
      distances.push_back(radius * random.uniform(0.6, 1.0));
    }
  }
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * M_PI;
    if (angles.size() < 3 || next - angles[i] > 0.85 * M_PI) {
      return {};
    }
  }
  return convexOutline(angles, distances);
}

/// One change of an outline: a corner cut off, a bay cut in, or an edge moved.
Outline drawChange(Random& random, const Outline& outline, double size) {
  const auto edge = static_cast<std::size_t>(random.below(static_cast<int>(outline.size())));
  const std::size_t before = (edge + outline.size() - 1) % outline.size();
  const double length = edgeLength(outline, edge);
  switch (random.below(4)) {
    case 0:
      return cutCorner(outline, edge, edgeLength(outline, before) * random.uniform(0.25, 0.7),
                       length * random.uniform(0.25, 0.7));
    case 1:
      return cutBay(outline, edge, length * random.uniform(0.2, 0.4),
                    length * random.uniform(0.25, 0.4), size * random.uniform(0.15, 0.4));
    case 2:
      return moveEdge(outline, edge, size * random.uniform(0.08, 0.35));
    default:
      return moveEdge(outline, edge, -size * random.uniform(0.08, 0.2));  // an overhang
  }
}

bool isGood(const Outline& outline, const BuildingRules& rules) {
  return outline.size() <= kMaxWalls && obeysRules({{1.0, {{outline, {}}}}}, rules);
}

/// Empty if the directions do not allow one.
Outline drawOutline(Random& random, const std::vector<double>& directions, double radius,
                    const BuildingRules& rules) {
  constexpr int kTries = 200;  // some sets of directions have no outline with room for all edges
  Outline outline;
  for (int tries = 0; tries < kTries && !isGood(outline, rules); ++tries) {
    outline = drawConvex(random, directions, radius);
  }
  const int changes = random.chance(0.5) ? 0 : 1 + random.below(4);
  for (int i = 0; i < changes && !outline.empty(); ++i) {
    const Outline changed = drawChange(random, outline, radius);
    if (isGood(changed, rules)) {
      outline = changed;
    }
  }
  return outline;
}

/// Components on a square raster, far enough from each other for overhangs.
std::vector<Part> drawParts(Random& random, const BuildingRules& rules) {
  const std::vector<double> directions = drawDirections(random);
  const int count = random.chance(0.55) ? 1 : 2 + random.below(3);
  const double radius = count == 1 ? 13.0 : 7.5;
  const double pitch = 2.0 * 1.3 * radius;  // corners reach beyond the distance of the sides
  std::vector<Part> parts;
  for (int i = 0; i < count; ++i) {
    const Vector2d center(pitch * (i % 2) + random.uniform(-0.5, 0.5),
                          pitch * (i / 2) + random.uniform(-0.5, 0.5));
    // Now and then a component has directions of its own, perhaps hardly different from the rest.
    const double own_yaw = random.chance(0.3) ? random.uniform(0.0, M_PI) : 0.0;
    Part part{shifted(turned(drawOutline(random, directions, radius, rules), own_yaw), center), {}};
    if (random.chance(0.25) && !part.outer.empty()) {
      const Outline hole =
          random.chance(0.5)
              ? inset(part.outer, radius * random.uniform(0.25, 0.45))
              : shifted(turned(drawConvex(random, directions, 0.4 * radius), own_yaw), center);
      const Part with_hole{part.outer, {hole}};
      if (!hole.empty() && obeysRules({{1.0, {with_hole}}}, rules)) {
        part = with_hole;
      }
    }
    parts.push_back(part);
  }
  return parts;
}

/// The storey above: one or two components changed, dropped, split or moved.
std::vector<Part> drawNext(Random& random, std::vector<Part> parts, bool near_pair) {
  const auto chosen = static_cast<std::size_t>(random.below(static_cast<int>(parts.size())));
  Part& part = parts[chosen];
  const Outline& outer = part.outer;
  if (near_pair) {
    const auto edge = static_cast<std::size_t>(random.below(static_cast<int>(outer.size())));
    part.outer = moveEdge(outer, edge, kNearPair);
    return parts;
  }
  const double size = std::sqrt(signedArea(outer));
  const double choice = random.uniform();
  if (choice < 0.55) {
    part.outer = drawChange(random, outer, 0.5 * size);
  } else if (choice < 0.75) {
    part.outer = inset(outer, size * random.uniform(0.05, 0.15));
  } else if (choice < 0.80) {
    part.holes.clear();
  } else if (choice < 0.85) {
    part.outer = shifted(outer, {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
  } else if (choice < 0.93 && parts.size() > 1) {
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(chosen));
  } else if (part.holes.empty() && parts.size() < 4) {
    // A street parallel to the first edge. Only convex outlines come out right; the rules
    // refuse the others.
    const Vector2d along = (outer[1] - outer[0]).normalized();
    const Vector2d normal(along.y(), -along.x());
    const double middle = normal.dot(outer[0]) - size * random.uniform(0.35, 0.65);
    const double half_width = size * random.uniform(0.06, 0.12);
    const Outline front = clipConvex(outer, -normal, -(middle + half_width));
    parts.push_back({clipConvex(outer, normal, middle - half_width), {}});
    parts[chosen].outer = front;
  }
  return parts;
}

bool isSame(const std::vector<Part>& a, const std::vector<Part>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Part& p, const Part& q) {
    return p.outer == q.outer && p.holes == q.holes;
  });
}

bool hasFewWalls(const std::vector<Part>& parts) {
  return std::all_of(parts.begin(), parts.end(),
                     [](const Part& part) { return part.outer.size() <= kMaxWalls; });
}

}  // namespace

std::vector<FloorplanLayer> randomBuilding(std::uint64_t seed) {
  Random random(seed);
  BuildingRules rules;
  std::vector<Stage> stages;
  while (!obeysRules(stages, rules)) {
    stages = {{random.uniform(7.0, 20.0), drawParts(random, rules)}};
  }
  // The pair comes last: its own closeness must not excuse that of others before it.
  const int num_types = 1 + random.below(6);
  const bool wants_pair = num_types > 1 && random.chance(0.2);
  for (int type = 1; type < num_types; ++type) {
    const bool near_pair = wants_pair && type == num_types - 1;
    if (near_pair) {
      rules.between_planes = rules.between_storeys = 0.9 * kNearPair;
    }
    for (int tries = 0; tries < kTriesPerChange; ++tries) {
      std::vector<Stage> more = stages;
      more.push_back({stages.back().top + random.uniform(5.0, 16.0),
                      drawNext(random, stages.back().parts, near_pair)});
      const bool changed = !isSame(more.back().parts, stages.back().parts);
      if (changed && hasFewWalls(more.back().parts) && obeysRules(more, rules)) {
        stages = more;
        break;
      }
    }
  }
  return stackStages(turned(stages, random.uniform(0.0, 2.0 * M_PI)));
}

}  // namespace storey::synth
