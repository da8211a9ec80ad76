// SPDX-License-Identifier: BSD-3-Clause
#include "synth/accuracy_limit.h"

#include <storey/surface/extrusion.h>
#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "synth/random.h"
#include "synth/triangle_tree.h"

namespace storey::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStepInformation = 0.9032;  // integral of phi^2 / Phi
constexpr int kDraws = 400;                  // the mean over 30 vertices is known to about 1 %

/// A vertical plane with the moments of the places of its points.
struct WallLine {
  Vector2d normal = Vector2d::UnitX();
  double area = 0.0;
  double first_moment = 0.0;   // area times place
  double second_moment = 0.0;  // area times place squared

  double placeOf(const Vector2d& at) const { return normal.x() * at.y() - normal.y() * at.x(); }
  double mean() const { return first_moment / area; }
  double variance() const { return second_moment / area - mean() * mean(); }
};

using WallLines = std::map<int, WallLine>;
/// By height: information per point density, from the ends of walls and from horizontal faces.
struct Level {
  double wall_length = 0.0;
  double cap_area = 0.0;
};
using Levels = std::map<double, Level>;

void addRing(const FloorplanLayer& layer, const FloorplanRing& ring, WallLines& lines) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& from = ring.vertices[i];
    const Vector2d& to = ring.vertices[(i + 1) % ring.size()];
    WallLine& line = lines[ring.edges[i].wall];
    if (line.area == 0.0) {
      const Vector2d along = (to - from).normalized();
      line.normal = Vector2d(along.y(), -along.x());
    }
    const double length = (to - from).norm();
    const double area = length * (layer.z_max - layer.z_min);
    const double middle = line.placeOf(0.5 * (from + to));
    line.area += area;
    line.first_moment += area * middle;
    line.second_moment += area * (middle * middle + length * length / 12.0);
  }
}

WallLines linesOf(const std::vector<FloorplanLayer>& layers) {
  WallLines lines;
  for (const FloorplanLayer& layer : layers) {
    for (const FloorplanComponent& component : layer.plan.components) {
      addRing(layer, component.outer, lines);
      for (const FloorplanRing& hole : component.holes) {
        addRing(layer, hole, lines);
      }
    }
  }
  return lines;
}

const Vector3d& vertexOf(const PolyhedralModel& model, int index) {
  return model.vertices[static_cast<std::size_t>(index)];
}

bool isSampled(FaceLabel label, SampledFaces faces) {
  return faces == SampledFaces::All ||
         (faces == SampledFaces::WallsAndRoofs && label == FaceLabel::Roof);
}

/// Calls `use(from, to)` for every edge of a face.
template <typename Use>
void forEachEdge(const PolyhedralFace& face, const Use& use) {
  const auto walk = [&](const std::vector<int>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      use(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  walk(face.outer);
  std::for_each(face.inner.begin(), face.inner.end(), walk);
}

/// Every edge of a horizontal face is one where a wall ends or begins.
Levels levelsOf(const PolyhedralModel& model, SampledFaces faces) {
  Levels levels;
  for (const PolyhedralFace& face : model.faces) {
    if (face.label == FaceLabel::Wall) {
      continue;
    }
    Level& level = levels[vertexOf(model, face.outer[0]).z()];
    double twice_area = 0.0;
    forEachEdge(face, [&](int from, int to) {
      const Vector3d& a = vertexOf(model, from);
      const Vector3d& b = vertexOf(model, to);
      level.wall_length += (b - a).norm();
      twice_area += a.x() * b.y() - a.y() * b.x();
    });
    level.cap_area += isSampled(face.label, faces) ? 0.5 * std::abs(twice_area) : 0.0;
  }
  return levels;
}

/// A vertex of the true model and the two of its walls that cross at the largest angle.
struct WallCorner {
  Vector3d position = Vector3d::Zero();
  int first = -1, second = -1;
};

std::vector<WallCorner> cornersOf(const PolyhedralModel& model, const WallLines& lines) {
  std::vector<std::vector<int>> walls_at(model.vertices.size());
  for (const PolyhedralFace& face : model.faces) {
    forEachEdge(face, [&](int from, int) {
      if (lines.count(face.wall) > 0) {
        walls_at[static_cast<std::size_t>(from)].push_back(face.wall);
      }
    });
  }
  std::vector<WallCorner> corners;
  for (std::size_t v = 0; v < walls_at.size(); ++v) {
    WallCorner corner{model.vertices[v], -1, -1};
    double best_sine = 0.0;
    for (const int a : walls_at[v]) {
      for (const int b : walls_at[v]) {
        const Vector2d& m = lines.at(a).normal;
        const Vector2d& n = lines.at(b).normal;
        const double sine = std::abs(m.x() * n.y() - m.y() * n.x());
        if (sine > best_sine) {
          best_sine = sine;
          corner.first = a;
          corner.second = b;
        }
      }
    }
    if (corner.first >= 0) {
      corners.push_back(corner);
    }
  }
  return corners;
}

TriangleMesh trianglesOf(const PolyhedralModel& model) {
  TriangleMesh mesh;
  mesh.vertices = model.vertices;
  for (const PolyhedralFace& face : model.faces) {
    const auto triangles = triangulateFace(model, face);
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  }
  return mesh;
}

/// One set of errors of all planes and heights.
class DrawnErrors {
 public:
  DrawnErrors(const WallLines& lines, const Levels& levels, double density, double sigma,
              Random& random)
      : lines_(lines) {
    for (const auto& [wall, line] : lines) {
      const double deviation = sigma / std::sqrt(density * line.area);
      const double offset = deviation * random.normal();
      const double slope = deviation / std::sqrt(line.variance()) * random.normal();
      offsets_[wall] = {offset, slope};
    }
    for (const auto& [z, level] : levels) {
      const double information = density * (kStepInformation * level.wall_length / sigma +
                                            level.cap_area / (sigma * sigma));
      heights_[z] = random.normal() / std::sqrt(information);
    }
  }

  /// How far the crossing of the two displaced walls is from the true one.
  Vector3d shiftOf(const WallCorner& corner) const {
    Eigen::Matrix2d normals;
    normals << lines_.at(corner.first).normal.transpose(),
        lines_.at(corner.second).normal.transpose();
    const Vector2d errors(errorAt(corner.first, corner.position),
                          errorAt(corner.second, corner.position));
    const Vector2d shift = normals.inverse() * errors;
    return {shift.x(), shift.y(), heights_.at(corner.position.z())};
  }

 private:
  double errorAt(int wall, const Vector3d& vertex) const {
    const WallLine& line = lines_.at(wall);
    const auto& [offset, slope] = offsets_.at(wall);
    return offset + slope * (line.placeOf(vertex.head<2>()) - line.mean());
  }

  const WallLines& lines_;
  std::map<int, std::pair<double, double>> offsets_;
  std::map<double, double> heights_;
};

}  // namespace

AccuracyLimit cramerRaoLimit(const std::vector<FloorplanLayer>& layers, std::size_t points,
                             double sigma, SampledFaces faces) {
  AccuracyLimit limit;
  const PolyhedralModel model = layers.empty() || points == 0 || !(sigma > 0.0)
                                    ? PolyhedralModel()
                                    : extrudeFloorplans(layers);
  if (model.empty()) {
    return limit;
  }
  const WallLines lines = linesOf(layers);
  const Levels levels = levelsOf(model, faces);
  double area = 0.0;
  for (const auto& [wall, line] : lines) {
    area += line.area;
  }
  for (const auto& [z, level] : levels) {
    area += level.cap_area;
  }
  const std::vector<WallCorner> corners = cornersOf(model, lines);
  const TriangleTree truth(trianglesOf(model));
  Random random(kDraws);
  double sum = 0.0;
  double sum_sq = 0.0;
  double sum_shift = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const DrawnErrors errors(lines, levels, static_cast<double>(points) / area, sigma, random);
    for (const WallCorner& corner : corners) {
      const Vector3d shift = errors.shiftOf(corner);
      const double distance = truth.distance(corner.position + shift);
      sum += distance;
      sum_sq += distance * distance;
      sum_shift += shift.norm();
    }
  }
  const double count = static_cast<double>(kDraws) * static_cast<double>(corners.size());
  limit.vertex_to_facet = sum / count;
  limit.vertex_deviation = std::sqrt(sum_sq / count - std::pow(limit.vertex_to_facet, 2));
  limit.corner_displacement = sum_shift / count;
  return limit;
}

}  // namespace storey::synth
