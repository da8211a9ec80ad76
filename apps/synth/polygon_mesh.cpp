// SPDX-License-Identifier: BSD-3-Clause
#include "synth/polygon_mesh.h"

#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "io/label_names.h"

namespace storey::synth {
namespace {

using Eigen::Vector3d;
using Polygon = io::PolygonSoup::Polygon;

const Vector3d& vertexOf(const io::PolygonSoup& soup, int index) {
  return soup.vertices[static_cast<std::size_t>(index)];
}

Eigen::AlignedBox3d boxOf(const io::PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Polygon& polygon : soup.polygons) {
    for (const int corner : polygon.corners) {
      box.extend(vertexOf(soup, corner));
    }
  }
  return box;
}

/// The soup's vertices on a lattice fine enough for the exact triangulation of the library.
PolyhedralModel onLattice(const io::PolygonSoup& soup) {
  constexpr double kStepsPerExtent = 0x1p24;
  const Eigen::AlignedBox3d box = boxOf(soup);
  PolyhedralModel model;
  model.grid = box.isEmpty() ? 1.0 : box.sizes().maxCoeff() / kStepsPerExtent;
  for (const Vector3d& vertex : soup.vertices) {
    const Vector3d steps = ((vertex - box.min()) / model.grid).array().round();
    model.vertices.push_back(steps * model.grid);
  }
  return model;
}

/// Which way a polygon faces: what its label says, or, of the parts of windows, its normal.
FaceLabel facing(const io::PolygonSoup& soup, const io::PolygonSoup::Polygon& polygon) {
  constexpr double kLevel = 0.5;  // of the normal: walls and level faces are far from it
  if (polygon.label < io::kWindowLabel) return static_cast<FaceLabel>(polygon.label);
  const double up = areaNormal(soup, polygon).normalized().z();
  if (std::abs(up) < kLevel) return FaceLabel::Wall;
  return up > 0.0 ? FaceLabel::Roof : FaceLabel::Ceiling;
}

void triangulate(const io::PolygonSoup& soup, PolygonMesh& mesh) {
  mesh.triangles.vertices = soup.vertices;
  const PolyhedralModel lattice = onLattice(soup);
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<int>& corners = soup.polygons[i].corners;
    std::vector<std::array<int, 3>> triangles = {{corners[0], corners[1], corners[2]}};
    if (corners.size() > 3) {
      PolyhedralFace face;
      face.outer = corners;
      face.label = facing(soup, soup.polygons[i]);
      triangles = triangulateFace(lattice, face);
    }
    mesh.num_broken += triangles.empty() ? 1 : 0;
    for (const auto& triangle : triangles) {
      mesh.triangles.triangles.push_back(triangle);
      mesh.piece_of.push_back(static_cast<int>(i));
    }
  }
}

struct HalfEdge {
  int low, high;
  std::size_t polygon;
};

/// All edges, those over the same two vertices beside each other.
std::vector<HalfEdge> sortedEdges(const io::PolygonSoup& soup) {
  std::vector<HalfEdge> edges;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<int>& corners = soup.polygons[i].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      edges.push_back({low, high, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::array<std::size_t, 3>{static_cast<std::size_t>(a.low),
                                      static_cast<std::size_t>(a.high), a.polygon} <
           std::array<std::size_t, 3>{static_cast<std::size_t>(b.low),
                                      static_cast<std::size_t>(b.high), b.polygon};
  });
  return edges;
}

class CoplanarTest {
 public:
  explicit CoplanarTest(const io::PolygonSoup& soup) : soup_(soup) {
    constexpr double kSamePlane = 2e-5;
    tolerance_ = kSamePlane * boxOf(soup).sizes().maxCoeff();
    for (const Polygon& polygon : soup.polygons) {
      normals_.push_back(areaNormal(soup, polygon));
    }
  }

  bool areOnePolygon(std::size_t first, std::size_t second) const {
    const Polygon& a = soup_.polygons[first];
    const Polygon& b = soup_.polygons[second];
    if (a.shell != b.shell || a.label != b.label) {
      return false;
    }
    const double cosine = normals_[first].normalized().dot(normals_[second].normalized());
    if (a.wall >= 0 && a.wall == b.wall) {
      return cosine > 0.0;
    }
    return cosine > 0.0 && inOnePlane(first, second);
  }

 private:
  bool inOnePlane(std::size_t first, std::size_t second) const {
    const bool first_larger = normals_[first].squaredNorm() >= normals_[second].squaredNorm();
    const Vector3d normal = normals_[first_larger ? first : second].normalized();
    const std::vector<int>& ring = soup_.polygons[first_larger ? first : second].corners;
    const std::vector<int>& other = soup_.polygons[first_larger ? second : first].corners;
    return std::all_of(other.begin(), other.end(), [&](int corner) {
      return std::abs(normal.dot(vertexOf(soup_, corner) - vertexOf(soup_, ring[0]))) <= tolerance_;
    });
  }

  const io::PolygonSoup& soup_;
  std::vector<Vector3d> normals_;
  double tolerance_ = 0.0;
};

std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) {
    i = parents[i] = parents[parents[i]];
  }
  return i;
}

void mergeCoplanar(const io::PolygonSoup& soup, PolygonMesh& mesh) {
  std::vector<std::size_t> parents(soup.polygons.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const CoplanarTest test(soup);
  const std::vector<HalfEdge> edges = sortedEdges(soup);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1;
         j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high; ++j) {
      if (test.areOnePolygon(edges[i].polygon, edges[j].polygon)) {
        const std::size_t first = rootOf(parents, edges[i].polygon);
        const std::size_t second = rootOf(parents, edges[j].polygon);
        parents[std::max(first, second)] = std::min(first, second);
      }
    }
  }
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::size_t root = rootOf(parents, i);  // the lowest index of its set
    const bool is_new = root == i;
    mesh.polygon_of.push_back(is_new ? static_cast<int>(mesh.num_polygons++)
                                     : mesh.polygon_of[root]);
  }
}

void collectVertices(const io::PolygonSoup& soup, PolygonMesh& mesh) {
  std::vector<std::vector<int>> polygons_at(soup.vertices.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    for (const int corner : soup.polygons[i].corners) {
      std::vector<int>& here = polygons_at[static_cast<std::size_t>(corner)];
      if (std::find(here.begin(), here.end(), mesh.polygon_of[i]) == here.end()) {
        here.push_back(mesh.polygon_of[i]);
      }
    }
  }
  for (std::size_t v = 0; v < polygons_at.size(); ++v) {
    if (!polygons_at[v].empty()) {
      mesh.vertices.push_back(soup.vertices[v]);
    }
    if (polygons_at[v].size() >= 3) {
      mesh.corners.push_back(soup.vertices[v]);
    }
  }
}

}  // namespace

Vector3d areaNormal(const io::PolygonSoup& soup, const Polygon& polygon) {
  const Vector3d origin = vertexOf(soup, polygon.corners[0]);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k) {
    sum += (vertexOf(soup, polygon.corners[k]) - origin)
               .cross(vertexOf(soup, polygon.corners[k + 1]) - origin);
  }
  return sum;
}

Vector3d upOfModel(const io::PolygonSoup& soup) {
  constexpr double kRounding = 1e-9;  // rad
  Vector3d sum = Vector3d::Zero();
  for (const Polygon& polygon : soup.polygons) {
    if (polygon.label == static_cast<std::uint8_t>(FaceLabel::Roof)) {
      sum += areaNormal(soup, polygon);
    }
  }
  const bool is_tilted = sum.head<2>().norm() > kRounding * std::abs(sum.z()) || sum.z() < 0.0;
  return is_tilted ? Vector3d(sum.normalized()) : Vector3d(Vector3d::UnitZ());
}

PolygonMesh measurable(const io::PolygonSoup& soup) {
  PolygonMesh mesh;
  if (!soup.polygons.empty()) {
    triangulate(soup, mesh);
    mergeCoplanar(soup, mesh);
    collectVertices(soup, mesh);
  }
  return mesh;
}

}  // namespace storey::synth
