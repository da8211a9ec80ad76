// SPDX-License-Identifier: BSD-3-Clause
#include "export/iso_solid.h"

#include <storey/surface/detail/triangle_contact.h>
#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <numeric>

#include "export/delaunay_flips.h"

namespace storey::test {
namespace {

using detail::LatticePoint;
using detail::TriangleContact;
using Polygon = IntegerSolid::Polygon;
using Shell = IntegerSolid::Shell;
using Triangle = std::array<int, 3>;

class SolidChecker {
 public:
  SolidChecker(const IntegerSolid& solid, double planarity)
      : solid_(solid), planarity_(planarity) {}

  std::set<IsoError> check() {
    for (const Shell& shell : solid_.shells) {
      triangles_.emplace_back();
      for (const Polygon& polygon : shell) {
        for (const std::vector<int>& ring : polygon) checkRing(ring);
        if (!errors_.empty()) return errors_;
        triangles_.back().push_back(checkPolygon(polygon));
      }
    }
    if (!errors_.empty()) return errors_;
    for (std::size_t s = 0; s < solid_.shells.size(); ++s) checkShell(s);
    if (errors_.empty()) checkShellsTogether();
    return errors_;
  }

  double volume() {
    double sum = 0.0;
    for (const Shell& shell : solid_.shells) {
      std::vector<std::vector<Triangle>> triangles;
      for (const Polygon& polygon : shell) triangles.push_back(checkPolygon(polygon));
      sum += volumeOf(triangles);
    }
    return sum;
  }

 private:
  Eigen::Vector3d at(int index) const {
    const LatticePoint& p = point(index);
    const LatticePoint& o = solid_.vertices[0];  // differences are exact in a double
    return Eigen::Vector3d(static_cast<double>(p[0] - o[0]), static_cast<double>(p[1] - o[1]),
                           static_cast<double>(p[2] - o[2]));
  }
  const LatticePoint& point(int index) const {
    return solid_.vertices.at(static_cast<std::size_t>(index));
  }

  void checkRing(const std::vector<int>& ring) {
    if (ring.size() < 3) errors_.insert(IsoError::TooFewPoints);
    std::set<LatticePoint> points;
    for (const int i : ring) points.insert(point(i));
    if (points.size() != ring.size()) errors_.insert(IsoError::RepeatedPoint);
  }

  Eigen::Vector3d normalOf(const std::vector<int>& ring) const {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      area += (at(ring[i]) - at(ring[0])).cross(at(ring[i + 1]) - at(ring[0]));
    }
    return area;
  }

  // Greatest distance of a point to the plane that fits them best: that of the area tells nothing
  // of slivers.
  double distanceToPlane(const Polygon& polygon) const {
    std::vector<Eigen::Vector3d> points;
    for (const std::vector<int>& ring : polygon) {
      for (const int i : ring) points.push_back(at(i));
    }
    Eigen::MatrixX3d rows(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = points[i];
    }
    rows.rowwise() -= rows.colwise().mean().eval();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeThinV);
    return (rows * svd.matrixV().col(2)).cwiseAbs().maxCoeff();
  }

  // The triangles of a polygon, by way of its shadow along the axis that it faces most.
  std::vector<Triangle> checkPolygon(const Polygon& polygon) {
    if (distanceToPlane(polygon) > planarity_) errors_.insert(IsoError::NotPlanar);
    const Eigen::Vector3d normal = normalOf(polygon[0]);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const std::vector<detail::GridPoint> points = shadowOf(axis, normal[axis] < 0.0);
    PolyhedralModel shadow;  // a roof in the plane of the two other axes
    shadow.grid = 1.0;
    for (const detail::GridPoint& p : points) {
      shadow.vertices.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), 0.0);
    }
    PolyhedralFace face;
    face.label = FaceLabel::Roof;
    face.outer = polygon[0];
    face.inner.assign(polygon.begin() + 1, polygon.end());
    std::vector<Triangle> triangles = triangulateFace(shadow, face);
    if (triangles.empty()) errors_.insert(IsoError::NotAPolygon);
    flipToDelaunay(triangles, points);
    return triangles;
  }

  // All vertices along an axis, seen from its other side if `mirrored`.
  std::vector<detail::GridPoint> shadowOf(Eigen::Index axis, bool mirrored) const {
    const auto u = static_cast<std::size_t>((axis + (mirrored ? 2 : 1)) % 3);
    const auto v = static_cast<std::size_t>((axis + (mirrored ? 1 : 2)) % 3);
    const LatticePoint& o = solid_.vertices[0];
    std::vector<detail::GridPoint> points;
    for (const LatticePoint& p : solid_.vertices) points.push_back({p[u] - o[u], p[v] - o[v]});
    return points;
  }

  void checkShell(std::size_t s) {
    const Shell& shell = solid_.shells[s];
    if (shell.size() < 4) errors_.insert(IsoError::TooFewPolygons);
    std::map<std::pair<int, int>, std::vector<std::size_t>> darts;  // directed edge -> polygons
    for (std::size_t p = 0; p < shell.size(); ++p) {
      for (const std::vector<int>& ring : shell[p]) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          darts[{ring[i], ring[(i + 1) % ring.size()]}].push_back(p);
        }
      }
    }
    std::vector<std::size_t> part(shell.size());
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (const auto& [edge, polygons] : darts) {
      const auto twin = darts.find({edge.second, edge.first});
      const std::size_t others = twin == darts.end() ? 0 : twin->second.size();
      if (polygons.size() + others > 2) errors_.insert(IsoError::NonManifold);
      if (polygons.size() == 2 && others == 0) errors_.insert(IsoError::Orientation);
      if (polygons.size() + others == 1) errors_.insert(IsoError::NotClosed);
      if (others == 0) continue;
      const std::size_t from = part[polygons[0]];
      std::replace(part.begin(), part.end(), from, part[twin->second[0]]);
    }
    if (std::set<std::size_t>(part.begin(), part.end()).size() > 1) {
      errors_.insert(IsoError::SeveralComponents);
    }
    checkFans(shell);
    if (!errors_.empty()) return;
    checkContacts(s, s);
    const double volume = volumeOf(triangles_[s]);
    if (s == 0 ? volume <= 0.0 : volume >= 0.0) errors_.insert(IsoError::WrongSense);
  }

  // The corners about a vertex, each from one neighbour to another, must be one cycle.
  void checkFans(const Shell& shell) {
    std::map<int, std::map<int, int>> corners;
    for (const Polygon& polygon : shell) {
      for (const std::vector<int>& ring : polygon) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::size_t n = ring.size();
          corners[ring[i]][ring[(i + n - 1) % n]] = ring[(i + 1) % n];
        }
      }
    }
    for (const auto& [vertex, next] : corners) {
      std::size_t steps = 0;
      int at = next.begin()->first;
      do {
        const auto step = next.find(at);
        if (step == next.end()) break;  // open: reported with its edge
        at = step->second;
        ++steps;
      } while (at != next.begin()->first && steps <= next.size());
      if (at == next.begin()->first && steps != next.size()) {
        errors_.insert(IsoError::NonManifold);
      }
    }
  }

  detail::LatticeTriangle corners(const Triangle& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }

  static bool apart(const detail::LatticeTriangle& a, const detail::LatticeTriangle& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [a_low, a_high] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
      const auto [b_low, b_high] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
      if (a_low > b_high || b_low > a_high) return true;
    }
    return false;
  }

  // Triangles of two polygons may share what they share vertices of, and no more.
  bool mayMeet(const Triangle& a, const Triangle& b, const TriangleContact& contact) const {
    std::vector<int> common;
    for (const int i : a) {
      if (std::find(b.begin(), b.end(), i) != b.end()) common.push_back(i);
    }
    if (contact.kind == TriangleContact::Nothing) return true;
    if (contact.kind == TriangleContact::Point) return common.size() == 1;
    if (contact.kind == TriangleContact::Area || common.size() != 2) return false;
    if (contact.edge_of_first < 0) return false;
    const auto edge = static_cast<std::size_t>(contact.edge_of_first);
    return std::find(common.begin(), common.end(), a[edge]) != common.end() &&
           std::find(common.begin(), common.end(), a[(edge + 1) % 3]) != common.end();
  }

  void checkContacts(std::size_t s, std::size_t t) {
    for (std::size_t p = 0; p < triangles_[s].size(); ++p) {
      for (std::size_t q = s == t ? p + 1 : 0; q < triangles_[t].size(); ++q) {
        for (const Triangle& a : triangles_[s][p]) {
          for (const Triangle& b : triangles_[t][q]) {
            if (apart(corners(a), corners(b))) continue;
            const TriangleContact contact = detail::findContact(corners(a), corners(b));
            if (s == t && !mayMeet(a, b, contact)) errors_.insert(IsoError::SelfIntersection);
            if (s != t && contact.kind != TriangleContact::Nothing) {
              errors_.insert(IsoError::ShellsMeet);
            }
          }
        }
      }
    }
  }

  void checkShellsTogether() {
    for (std::size_t s = 1; s < solid_.shells.size(); ++s) {
      for (std::size_t t = 0; t < s; ++t) checkContacts(s, t);
      if (std::abs(windingNumber(at(solid_.shells[s][0][0][0])) - 1.0) > 0.5) {
        errors_.insert(IsoError::InnerOutside);
      }
    }
  }

  // Of the outer shell about a point that is not on it: the sum of the solid angles [van Oosterom
  // and Strackee 1983] over the whole sphere.
  double windingNumber(const Eigen::Vector3d& about) const {
    double angle = 0.0;
    for (const std::vector<Triangle>& polygon : triangles_[0]) {
      for (const Triangle& t : polygon) {
        const Eigen::Vector3d a = (at(t[0]) - about).normalized();
        const Eigen::Vector3d b = (at(t[1]) - about).normalized();
        const Eigen::Vector3d c = (at(t[2]) - about).normalized();
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
      }
    }
    return angle / (4.0 * M_PI);
  }

  double volumeOf(const std::vector<std::vector<Triangle>>& polygons) const {
    double volume = 0.0;
    for (const std::vector<Triangle>& triangles : polygons) {
      for (const Triangle& t : triangles) volume += at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0;
    }
    return volume;
  }

  const IntegerSolid& solid_;
  double planarity_;
  std::set<IsoError> errors_;
  std::vector<std::vector<std::vector<Triangle>>> triangles_;  // shell, polygon, triangle
};

}  // namespace

std::set<IsoError> checkSolid(const IntegerSolid& solid, double planarity) {
  return SolidChecker(solid, planarity).check();
}

double volumeOf(const IntegerSolid& solid) { return SolidChecker(solid, 0.0).volume(); }

}  // namespace storey::test
