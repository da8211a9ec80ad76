// SPDX-License-Identifier: BSD-3-Clause
#include "synth/outlines.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace storey::synth {
namespace {

using Eigen::Vector2d;

struct Line {
  Vector2d normal;
  double distance;
};

Vector2d intersection(const Line& a, const Line& b) {
  const double determinant = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
  return {(a.distance * b.normal.y() - b.distance * a.normal.y()) / determinant,
          (b.distance * a.normal.x() - a.distance * b.normal.x()) / determinant};
}

/// The line of an edge; its normal points to the right, which is outwards.
Line lineOf(const Vector2d& from, const Vector2d& to) {
  const Vector2d along = (to - from).normalized();
  const Vector2d normal(along.y(), -along.x());
  return {normal, normal.dot(0.5 * (from + to))};
}

std::vector<Line> linesOf(const Outline& outline) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    lines.push_back(lineOf(outline[i], outline[(i + 1) % outline.size()]));
  }
  return lines;
}

Outline cornersOf(const std::vector<Line>& lines) {
  Outline outline;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    outline.push_back(intersection(lines[(i + lines.size() - 1) % lines.size()], lines[i]));
  }
  return outline;
}

/// Gives the same id to edges in one line.
class WallNumbers {
 public:
  explicit WallNumbers(double tolerance) : tolerance_(tolerance) {}

  int of(const Vector2d& from, const Vector2d& to) {
    for (std::size_t id = 0; id < lines_.size(); ++id) {
      const Line& line = lines_[id];
      if (std::abs(line.normal.dot(from) - line.distance) < tolerance_ &&
          std::abs(line.normal.dot(to) - line.distance) < tolerance_) {
        return static_cast<int>(id);
      }
    }
    lines_.push_back(lineOf(from, to));
    return static_cast<int>(lines_.size()) - 1;
  }

 private:
  double tolerance_;
  std::vector<Line> lines_;
};

FloorplanRing makeRing(const Outline& outline, WallNumbers& walls) {
  FloorplanRing ring;
  ring.vertices = outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    FloorplanEdge edge;
    edge.wall = walls.of(outline[i], outline[(i + 1) % outline.size()]);
    ring.edges.push_back(edge);
  }
  return ring;
}

double widthOf(const std::vector<Stage>& stages) {
  Eigen::AlignedBox2d box;
  for (const Stage& stage : stages) {
    for (const Part& part : stage.parts) {
      for (const Vector2d& corner : part.outer) {
        box.extend(corner);
      }
    }
  }
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

}  // namespace

Outline convexOutline(const std::vector<double>& normal_angles,
                      const std::vector<double>& distances, const Vector2d& center) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < normal_angles.size(); ++i) {
    const Vector2d normal(std::cos(normal_angles[i]), std::sin(normal_angles[i]));
    lines.push_back({normal, distances[i] + normal.dot(center)});
  }
  return cornersOf(lines);
}

Outline regularOutline(int sides, double apothem, double first_normal_angle) {
  std::vector<double> angles;
  for (int i = 0; i < sides; ++i) {
    angles.push_back(first_normal_angle + 2.0 * M_PI * i / sides);
  }
  return convexOutline(angles, std::vector<double>(angles.size(), apothem));
}

Outline rectangle(double x_min, double y_min, double x_max, double y_max) {
  return {{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}};
}

Outline moveEdge(const Outline& outline, std::size_t edge, double distance) {
  std::vector<Line> lines = linesOf(outline);
  lines[edge].distance -= distance;
  return cornersOf(lines);
}

Outline inset(const Outline& outline, double distance) {
  std::vector<Line> lines = linesOf(outline);
  for (Line& line : lines) {
    line.distance -= distance;
  }
  return cornersOf(lines);
}

Outline cutCorner(const Outline& outline, std::size_t corner, double before, double after) {
  const std::size_t n = outline.size();
  const Vector2d at = outline[corner];
  const Vector2d first = at + before * (outline[(corner + n - 1) % n] - at).normalized();
  const Vector2d last = at + after * (outline[(corner + 1) % n] - at).normalized();
  Outline result = outline;
  result[corner] = first;
  const auto next = result.begin() + static_cast<std::ptrdiff_t>(corner) + 1;
  result.insert(next, {first + last - at, last});
  return result;
}

Outline cutBay(const Outline& outline, std::size_t edge, double start, double width, double depth) {
  const Vector2d from = outline[edge];
  const Vector2d along = (outline[(edge + 1) % outline.size()] - from).normalized();
  const Vector2d inwards = depth * Vector2d(-along.y(), along.x());
  const Vector2d first = from + start * along;
  const Vector2d last = first + width * along;
  Outline result = outline;
  result.insert(result.begin() + static_cast<std::ptrdiff_t>(edge) + 1,
                {first, first + inwards, last + inwards, last});
  return result;
}

Outline clipConvex(const Outline& outline, const Vector2d& normal, double distance) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    const double height_a = normal.dot(a) - distance;
    const double height_b = normal.dot(b) - distance;
    if (height_a <= 0.0) {
      kept.push_back(a);
    }
    if ((height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0)) {
      kept.push_back(a + height_a / (height_a - height_b) * (b - a));
    }
  }
  return kept.size() < 3 ? Outline() : kept;
}

Outline turned(const Outline& outline, double yaw) {
  Outline result;
  for (const Vector2d& corner : outline) {
    result.push_back(Eigen::Rotation2Dd(yaw) * corner);
  }
  return result;
}

Outline shifted(const Outline& outline, const Vector2d& by) {
  Outline result;
  for (const Vector2d& corner : outline) {
    result.push_back(corner + by);
  }
  return result;
}

std::vector<Stage> turned(std::vector<Stage> stages, double yaw) {
  for (Stage& stage : stages) {
    for (Part& part : stage.parts) {
      part.outer = turned(part.outer, yaw);
      for (Outline& hole : part.holes) {
        hole = turned(hole, yaw);
      }
    }
  }
  return stages;
}

double edgeLength(const Outline& outline, std::size_t edge) {
  return (outline[(edge + 1) % outline.size()] - outline[edge]).norm();
}

double signedArea(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::vector<FloorplanLayer> stackStages(const std::vector<Stage>& stages) {
  constexpr double kSameLine = 1e-6;  // of the width: far above rounding, far below the noise
  WallNumbers walls(kSameLine * widthOf(stages));
  std::vector<FloorplanLayer> layers;
  double bottom = 0.0;
  for (const Stage& stage : stages) {
    FloorplanLayer layer;
    layer.z_min = bottom;
    layer.z_max = bottom = stage.top;
    for (const Part& part : stage.parts) {
      FloorplanComponent component;
      component.outer = makeRing(part.outer, walls);
      for (const Outline& hole : part.holes) {
        component.holes.push_back(makeRing(Outline(hole.rbegin(), hole.rend()), walls));
      }
      layer.plan.components.push_back(component);
    }
    layers.push_back(layer);
  }
  return layers;
}

}  // namespace storey::synth
