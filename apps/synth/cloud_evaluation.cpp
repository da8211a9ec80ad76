// SPDX-License-Identifier: BSD-3-Clause
#include "synth/cloud_evaluation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "synth/polygon_mesh.h"
#include "synth/triangle_tree.h"

namespace storey::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Cell = std::pair<long, long>;

constexpr double kWallFace = 0.1;
constexpr double kReach = 3.0;          // deviations of the noise
constexpr double kPointsPerCell = 6.0;  // exp(-6) = 1 / 403 of them empty by chance

/// A wall polygon in its own plane: first coordinate along the wall, second upwards.
class WallRaster {
 public:
  WallRaster(const io::PolygonSoup& soup, const io::PolygonSoup::Polygon& polygon,
             const Vector3d& up, double cell_size)
      : cell_size_(cell_size) {
    const Vector3d twice_area = areaNormal(soup, polygon);
    area_ = 0.5 * twice_area.norm();
    normal_ = twice_area.normalized();
    along_ = up.cross(normal_).normalized();
    up_ = normal_.cross(along_);
    offset_ = normal_.dot(soup.vertices[static_cast<std::size_t>(polygon.corners[0])]);
    for (const int corner : polygon.corners) {
      ring_.push_back(inPlane(soup.vertices[static_cast<std::size_t>(corner)]));
      box_.extend(ring_.back());
    }
    findCells();
  }

  /// Area of the cells that have a point within `reach` of the plane.
  double supportedArea(const std::vector<Vector3d>& points, double reach) const {
    std::set<Cell> seen;
    bool any_inside = false;
    for (const Vector3d& point : points) {
      if (std::abs(normal_.dot(point) - offset_) > reach) {
        continue;
      }
      const Vector2d at = inPlane(point);
      if (box_.contains(at)) {
        any_inside = true;
        seen.insert(cellOf(at));
      }
    }
    if (cells_.empty()) {
      return any_inside ? area_ : 0.0;
    }
    const auto supported = std::count_if(cells_.begin(), cells_.end(),
                                         [&](const Cell& cell) { return seen.count(cell) > 0; });
    return area_ * static_cast<double>(supported) / static_cast<double>(cells_.size());
  }

  double area() const { return area_; }

 private:
  Vector2d inPlane(const Vector3d& point) const { return {along_.dot(point), up_.dot(point)}; }

  Cell cellOf(const Vector2d& at) const {
    return {std::lround(std::floor(at.x() / cell_size_)),
            std::lround(std::floor(at.y() / cell_size_))};
  }

  bool isInside(const Vector2d& at) const {
    bool odd = false;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Vector2d& a = ring_[i];
      const Vector2d& b = ring_[(i + 1) % ring_.size()];
      if ((a.y() > at.y()) != (b.y() > at.y())) {
        odd ^= at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      }
    }
    return odd;
  }

  void findCells() {
    const Cell low = cellOf(box_.min());
    const Cell high = cellOf(box_.max());
    for (long i = low.first; i <= high.first; ++i) {
      for (long j = low.second; j <= high.second; ++j) {
        const Vector2d center(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
        if (isInside(cell_size_ * center)) {
          cells_.emplace_back(i, j);
        }
      }
    }
  }

  double cell_size_;
  double area_ = 0.0;
  Vector3d normal_, along_, up_;
  double offset_ = 0.0;
  std::vector<Vector2d> ring_;
  Eigen::AlignedBox2d box_;
  std::vector<Cell> cells_;
};

std::vector<Vector3d> wallPoints(const std::vector<OrientedPosition>& points, const Vector3d& up) {
  std::vector<Vector3d> positions;
  for (const OrientedPosition& point : points) {
    // A zero normal is one that is not known.
    if (point.normal.squaredNorm() > 0.5 && std::abs(point.normal.dot(up)) < kWallPoint) {
      positions.push_back(point.position);
    }
  }
  return positions;
}

}  // namespace

double CloudEvaluation::explainedShare() const {
  return wall_points == 0
             ? 0.0
             : static_cast<double>(explained_points) / static_cast<double>(wall_points);
}

double CloudEvaluation::supportedShare() const {
  return wall_area > 0.0 ? supported_area / wall_area : 0.0;
}

double CloudEvaluation::supportedShownShare() const {
  return shown_area > 0.0 ? supported_shown_area / shown_area : 0.0;
}

CloudEvaluation evaluateAgainstCloud(const io::PolygonSoup& model,
                                     const std::vector<OrientedPosition>& points,
                                     const Vector3d& up, double sigma, double density) {
  CloudEvaluation evaluation;
  evaluation.sigma = sigma;
  evaluation.cell_size = std::max(kReach * sigma, std::sqrt(kPointsPerCell / density));
  const std::vector<Vector3d> positions = wallPoints(points, up);
  evaluation.wall_points = positions.size();
  const std::vector<double> distances =
      TriangleTree(measurable(model).triangles).distances(positions);
  evaluation.explained_points = static_cast<std::size_t>(
      std::count_if(distances.begin(), distances.end(),
                    [&](double distance) { return distance <= kReach * sigma; }));

  const auto num_polygons = static_cast<std::ptrdiff_t>(model.polygons.size());
  std::vector<double> areas(model.polygons.size(), 0.0);
  std::vector<double> supported(model.polygons.size(), 0.0);
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t i = 0; i < num_polygons; ++i) {
    const auto id = static_cast<std::size_t>(i);
    const Vector3d normal = areaNormal(model, model.polygons[id]).normalized();
    if (std::abs(normal.dot(up)) < kWallFace) {
      const WallRaster raster(model, model.polygons[id], up, evaluation.cell_size);
      areas[id] = raster.area();
      supported[id] = raster.supportedArea(positions, kReach * sigma);
    }
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    evaluation.wall_area += areas[i];
    evaluation.supported_area += supported[i];
    if (model.polygons[i].hypothetical) continue;
    evaluation.shown_area += areas[i];
    evaluation.supported_shown_area += supported[i];
  }
  return evaluation;
}

}  // namespace storey::synth
