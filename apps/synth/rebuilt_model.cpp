// SPDX-License-Identifier: BSD-3-Clause
#include "synth/rebuilt_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "io/label_names.h"

namespace storey::synth {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

/// The border of a merged polygon: directed edges of its pieces whose reverse none of them has.
std::set<Edge> borderOf(const io::PolygonSoup& soup, const std::vector<std::size_t>& pieces) {
  std::set<Edge> border;
  for (const std::size_t piece : pieces) {
    const std::vector<int>& corners = soup.polygons[piece].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Edge edge(corners[i], corners[(i + 1) % corners.size()]);
      if (border.erase({edge.second, edge.first}) == 0) {
        border.insert(edge);
      }
    }
  }
  return border;
}

/// Chains of the border. An open end ends the ring there, for the check to find.
std::vector<std::vector<int>> ringsOf(std::set<Edge> border) {
  std::vector<std::vector<int>> rings;
  while (!border.empty()) {
    std::vector<int> ring;
    auto edge = border.begin();
    while (edge != border.end()) {
      ring.push_back(edge->first);
      const int next = edge->second;
      border.erase(edge);
      edge = border.lower_bound({next, 0});
      if (edge != border.end() && edge->first != next) {
        edge = border.end();
      }
    }
    rings.push_back(ring);
  }
  return rings;
}

Vector3d areaNormal(const std::vector<Vector3d>& vertices, const std::vector<int>& ring) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d& origin = vertices[static_cast<std::size_t>(ring[0])];
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += (vertices[static_cast<std::size_t>(ring[i])] - origin)
               .cross(vertices[static_cast<std::size_t>(ring[i + 1])] - origin);
  }
  return sum;
}

WindowPart windowPartOf(const io::PolygonSoup::Polygon& piece) {
  if (piece.label == io::kWindowLabel) return WindowPart::Pane;
  return piece.label == io::kRevealLabel ? WindowPart::Reveal : WindowPart::None;
}

FaceLabel labelOf(const io::PolygonSoup::Polygon& piece, const Vector3d& normal) {
  constexpr double kHorizontal = 0.9;  // of the normal's z
  const bool of_window = windowPartOf(piece) != WindowPart::None;
  const auto label = of_window ? FaceLabel::Wall : static_cast<FaceLabel>(piece.label);
  if (label != FaceLabel::Wall || std::abs(normal.z()) < kHorizontal) {
    return label;
  }
  if (normal.z() > 0.0) return FaceLabel::Roof;
  return of_window ? FaceLabel::Ceiling : FaceLabel::Ground;
}

PolyhedralFace faceOf(const io::PolygonSoup& soup, const std::vector<std::size_t>& pieces,
                      const std::vector<Vector3d>& vertices) {
  std::vector<std::vector<int>> rings = ringsOf(borderOf(soup, pieces));
  // The outer ring encloses the others: it has the largest area.
  const auto outer =
      std::max_element(rings.begin(), rings.end(), [&](const auto& a, const auto& b) {
        return areaNormal(vertices, a).squaredNorm() < areaNormal(vertices, b).squaredNorm();
      });
  PolyhedralFace face;
  if (outer == rings.end()) {
    return face;
  }
  const io::PolygonSoup::Polygon& first = soup.polygons[pieces[0]];
  face.outer = *outer;
  rings.erase(outer);
  face.inner = rings;
  face.label = labelOf(first, areaNormal(vertices, face.outer).normalized());
  face.window = windowPartOf(first);
  face.wall = first.wall;
  face.shell = first.shell;
  face.hypothetical = first.hypothetical;
  return face;
}

Eigen::Quaterniond turnUpright(const Vector3d& up) {
  return up == Vector3d::UnitZ() ? Eigen::Quaterniond::Identity()
                                 : Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ());
}

/// Vertices relative to the first, with `up` along +z, and the grid for their extent.
std::vector<Vector3d> upright(const io::PolygonSoup& soup, const Vector3d& up, double& grid) {
  const Eigen::Quaterniond turn = turnUpright(up);
  const bool is_upright = up == Vector3d::UnitZ();
  std::vector<Vector3d> vertices;
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : soup.vertices) {
    const Vector3d local = vertex - soup.vertices[0];
    vertices.push_back(is_upright ? local : Vector3d(turn * local));
    box.extend(vertices.back());
  }
  const double extent = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  grid = extent > 0.0 ? std::pow(10.0, std::ceil(std::log10(std::ldexp(extent, -20)))) : 1.0;
  for (Vector3d& vertex : vertices) {
    vertex = (vertex / grid).array().round() * grid;
  }
  return vertices;
}

}  // namespace

PolyhedralModel rebuildModel(const io::PolygonSoup& soup, const PolygonMesh& mesh,
                             const Vector3d& up) {
  PolyhedralModel model;
  const std::vector<Vector3d> vertices = upright(soup, up, model.grid);
  std::vector<std::vector<std::size_t>> pieces(mesh.num_polygons);
  for (std::size_t i = 0; i < mesh.polygon_of.size(); ++i) {
    pieces[static_cast<std::size_t>(mesh.polygon_of[i])].push_back(i);
  }
  std::map<int, int> renumbered;  // vertices that only joints of pieces used are gone
  const auto keep = [&](int& index) {
    const auto [at, is_new] = renumbered.emplace(index, static_cast<int>(model.vertices.size()));
    if (is_new) {
      model.vertices.push_back(vertices[static_cast<std::size_t>(index)]);
    }
    index = at->second;
  };
  for (const std::vector<std::size_t>& of_polygon : pieces) {
    PolyhedralFace face = faceOf(soup, of_polygon, vertices);
    std::for_each(face.outer.begin(), face.outer.end(), keep);
    for (std::vector<int>& ring : face.inner) {
      std::for_each(ring.begin(), ring.end(), keep);
    }
    model.num_shells = std::max(model.num_shells, face.shell + 1);
    model.faces.push_back(face);
  }
  return model;
}

Eigen::Isometry3d rebuiltToFile(const io::PolygonSoup& soup, const Vector3d& up) {
  Eigen::Isometry3d to_file = Eigen::Isometry3d::Identity();
  to_file.linear() = turnUpright(up).inverse().toRotationMatrix();
  to_file.translation() = soup.vertices[0];
  return to_file;
}

}  // namespace storey::synth
