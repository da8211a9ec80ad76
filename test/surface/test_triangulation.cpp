// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/mesh_export.h>
#include <storey/surface/triangulation.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "stacks.h"

namespace {

using namespace storey;
using namespace storey::test;
using Edge = std::pair<int, int>;

// One level face from rings of integer points: counter-clockwise outside, clockwise holes.
PolyhedralModel levelFace(const std::vector<std::vector<Eigen::Vector2d>>& rings) {
  PolyhedralModel model;
  model.grid = 1.0;
  PolyhedralFace face;
  face.label = FaceLabel::Roof;
  for (const auto& points : rings) {
    std::vector<int> indices;
    for (const Eigen::Vector2d& p : points) {
      indices.push_back(static_cast<int>(model.vertices.size()));
      model.vertices.emplace_back(p.x(), p.y(), 5.0);
    }
    if (face.outer.empty()) {
      face.outer = indices;
    } else {
      face.inner.push_back(indices);
    }
  }
  model.faces.push_back(face);
  return model;
}

Eigen::Vector3d areaOf(const PolyhedralModel& model, const std::vector<int>& ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = model.vertices[static_cast<std::size_t>(ring[0])];
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += 0.5 * (model.vertices[static_cast<std::size_t>(ring[i])] - origin)
                     .cross(model.vertices[static_cast<std::size_t>(ring[i + 1])] - origin);
  }
  return sum;
}

void addEdges(const std::vector<int>& ring, std::map<Edge, int>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) ++edges[{ring[i], ring[(i + 1) % ring.size()]}];
}

// Pieces are the face: areas add up, each ring edge is there once, each new one in both senses;
// no piece is degenerate or turned over. Pieces of the right total area whose edges cancel out
// cannot overlap.
void expectPieces(const PolyhedralModel& model, const PolyhedralFace& face,
                  const std::vector<std::vector<int>>& pieces) {
  ASSERT_FALSE(pieces.empty());
  std::map<Edge, int> border;
  std::set<int> vertices(face.outer.begin(), face.outer.end());
  addEdges(face.outer, border);
  Eigen::Vector3d area = areaOf(model, face.outer);
  for (const std::vector<int>& hole : face.inner) {
    area += areaOf(model, hole);
    addEdges(hole, border);
    vertices.insert(hole.begin(), hole.end());
  }
  std::map<Edge, int> edges;
  std::set<int> used;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::vector<int>& piece : pieces) {
    const Eigen::Vector3d part = areaOf(model, piece);
    EXPECT_GT(part.dot(area), 0.0);
    EXPECT_EQ(std::set<int>(piece.begin(), piece.end()).size(), piece.size());
    sum += part;
    addEdges(piece, edges);
    used.insert(piece.begin(), piece.end());
  }
  EXPECT_LT((sum - area).norm(), 1e-9 * area.norm());
  EXPECT_EQ(used, vertices);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(border.count(edge) != 0 || edges.count({edge.second, edge.first}) != 0);
  }
  for (const auto& entry : border) EXPECT_EQ(edges.count(entry.first), 1u);
}

// Also: V - 2 + 2 holes triangles, for holes that do not touch anything.
void expectTriangulates(const PolyhedralModel& model, const PolyhedralFace& face) {
  std::vector<std::vector<int>> pieces;
  for (const auto& t : triangulateFace(model, face)) pieces.emplace_back(t.begin(), t.end());
  expectPieces(model, face, pieces);
}

std::vector<Eigen::Vector2d> square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

std::vector<Eigen::Vector2d> hole(double x, double y, double size) {
  auto points = square(x, y, size);
  std::reverse(points.begin(), points.end());
  return points;
}

TEST(Triangulation, CollinearVerticesAreAllUsed) {
  const PolyhedralModel model =
      levelFace({{{0, 0}, {3, 0}, {5, 0}, {9, 0}, {9, 4}, {9, 9}, {6, 9}, {2, 9}, {0, 9}, {0, 5}}});
  EXPECT_EQ(triangulateFace(model, model.faces[0]).size(), 8u);
  expectTriangulates(model, model.faces[0]);
  // a triangle with all its extra corners on one side
  const PolyhedralModel fan = levelFace({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 1}}});
  expectTriangulates(fan, fan.faces[0]);
}

TEST(Triangulation, Holes) {
  const PolyhedralModel model = levelFace({square(0, 0, 20), hole(2, 2, 3), hole(2, 12, 3),
                                           hole(8, 7, 5), hole(15, 2, 3), hole(15, 15, 3)});
  EXPECT_EQ(triangulateFace(model, model.faces[0]).size(), 24u - 2 + 2 * 5);
  expectTriangulates(model, model.faces[0]);
}

TEST(Triangulation, HolesInARowShareTheirLines) {
  const PolyhedralModel model = levelFace({square(0, 0, 12), hole(1, 1, 2), hole(4, 1, 2),
                                           hole(7, 1, 2), hole(1, 4, 2), hole(4, 4, 2)});
  expectTriangulates(model, model.faces[0]);
}

TEST(Triangulation, HoleTouchesTheOutlineAtACorner) {
  const PolyhedralModel model =
      levelFace({{{0, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}}, {{5, 10}, {7, 6}, {3, 6}}});
  PolyhedralModel shared = model;
  shared.faces[0].inner[0][0] = 3;  // the same vertex
  std::vector<std::vector<int>> pieces;
  for (const auto& t : triangulateFace(shared, shared.faces[0])) {
    pieces.emplace_back(t.begin(), t.end());
  }
  expectPieces(shared, shared.faces[0], pieces);
}

TEST(Triangulation, HolesTouchEachOther) {
  PolyhedralModel model = levelFace({square(0, 0, 10), hole(2, 2, 3), hole(5, 5, 3)});
  // corner (5, 5) is in both holes
  for (int& i : model.faces[0].inner[1]) {
    if (model.vertices[static_cast<std::size_t>(i)] == Eigen::Vector3d(5, 5, 5)) {
      for (const int j : model.faces[0].inner[0]) {
        if (model.vertices[static_cast<std::size_t>(j)] == Eigen::Vector3d(5, 5, 5)) i = j;
      }
    }
  }
  expectTriangulates(model, model.faces[0]);
}

TEST(Triangulation, FacesThatAreNoPolygonsGiveNothing) {
  PolyhedralModel model = levelFace({square(0, 0, 10), hole(2, 2, 3)});
  const PolyhedralFace good = model.faces[0];
  PolyhedralFace face = good;
  face.outer[1] = 99;
  EXPECT_TRUE(triangulateFace(model, face).empty());
  face = good;
  face.outer = {0, 2};
  EXPECT_TRUE(triangulateFace(model, face).empty());
  face = good;
  std::swap(face.outer[1], face.outer[2]);  // crosses itself
  EXPECT_TRUE(triangulateFace(model, face).empty());
  model.vertices[5].x() = 30;  // the hole sticks out
  EXPECT_TRUE(triangulateFace(model, good).empty());
  model.vertices[5].x() = std::nan("");
  EXPECT_TRUE(triangulateFace(model, good).empty());
  EXPECT_TRUE(splitHoles(model, good).empty());
  EXPECT_TRUE(triangulateFace(PolyhedralModel{}, good).empty());
}

TEST(Triangulation, SplitHolesGivesFewPieces) {
  const PolyhedralModel one = levelFace({square(0, 0, 10), hole(2, 2, 3)});
  const auto pieces = splitHoles(one, one.faces[0]);
  expectPieces(one, one.faces[0], pieces);
  EXPECT_EQ(pieces.size(), 2u);  // one piece around a hole would touch itself
  const PolyhedralModel none = levelFace({square(0, 0, 10)});
  EXPECT_EQ(splitHoles(none, none.faces[0]), std::vector<std::vector<int>>{none.faces[0].outer});
}

// All faces of random models, walls at any yaw among them.
TEST(Triangulation, FacesOfRandomModels) {
  for (unsigned seed = 1000; seed < 1150; ++seed) {
    std::mt19937 random(seed);
    const PolyhedralModel model =
        extrudeFloorplans(seed % 2 == 0 ? randomCellStack(random) : randomStarStack(random));
    for (const PolyhedralFace& face : model.faces) {
      std::vector<std::vector<int>> triangles;
      for (const auto& t : triangulateFace(model, face)) triangles.emplace_back(t.begin(), t.end());
      if (face.label == FaceLabel::Wall) {
        // Planar within the grid only: areas agree to it, and edges exactly.
        std::map<Edge, int> edges;
        std::map<Edge, int> border;
        addEdges(face.outer, border);
        for (const auto& ring : face.inner) addEdges(ring, border);
        for (const auto& t : triangles) addEdges(t, edges);
        for (const auto& [edge, count] : edges) {
          EXPECT_EQ(count, 1);
          EXPECT_TRUE(border.count(edge) != 0 || edges.count({edge.second, edge.first}) != 0);
        }
        for (const auto& entry : border) EXPECT_EQ(edges.count(entry.first), 1u);
      } else {
        expectPieces(model, face, triangles);
        expectPieces(model, face, splitHoles(model, face));
      }
    }
  }
}

TEST(MeshExport, TrianglesAreAClosedSurface) {
  const PolyhedralModel model =
      extrudeFloorplans({layer(0, 3, {rectangle(0, 0, 20, 10)}),
                         layer(3, 9, {rectangle(2, 2, 6, 6), rectangle(10, 3, 15, 8)})});
  const pcl::PolygonMesh mesh = toPolygonMesh(model);
  EXPECT_EQ(mesh.cloud.width * mesh.cloud.height, model.vertices.size());
  ASSERT_EQ(mesh.cloud.fields.size(), 3u);
  EXPECT_EQ(mesh.cloud.fields[2].name, "z");
  std::map<Edge, int> edges;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    ASSERT_EQ(polygon.vertices.size(), 3u);
    std::vector<int> ring;
    for (const auto i : polygon.vertices) {
      ASSERT_LT(static_cast<std::size_t>(i), model.vertices.size());
      ring.push_back(static_cast<int>(i));
    }
    addEdges(ring, edges);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(mesh.polygons.size(), 2 * (model.vertices.size() - 2));  // genus 0
  EXPECT_TRUE(toPolygonMesh(PolyhedralModel{}).polygons.empty());
}

}  // namespace
