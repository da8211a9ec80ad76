// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "stacks.h"

namespace {

using namespace storey;
using namespace storey::test;

PolyhedralModel tower() {
  return extrudeFloorplans(
      {layer(0, 3, {rectangle(0, 0, 10, 10)}), layer(3, 6, {rectangle(3, 3, 6, 6)})}, 0.5);
}

PolyhedralModel box(double x = 0.0, double y = 0.0, double z = 0.0, double size = 4.0) {
  return extrudeFloorplans({layer(z, z + size, {rectangle(x, y, x + size, y + size)})}, 0.5);
}

// Both as shells of one model.
PolyhedralModel join(PolyhedralModel a, const PolyhedralModel& b) {
  const int offset = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (PolyhedralFace face : b.faces) {
    for (int& i : face.outer) i += offset;
    for (std::vector<int>& ring : face.inner) {
      for (int& i : ring) i += offset;
    }
    face.shell += a.num_shells;
    a.faces.push_back(face);
  }
  a.num_shells += b.num_shells;
  return a;
}

// Inside out.
PolyhedralModel flipped(PolyhedralModel model) {
  for (PolyhedralFace& face : model.faces) {
    std::reverse(face.outer.begin(), face.outer.end());
    for (std::vector<int>& ring : face.inner) std::reverse(ring.begin(), ring.end());
    if (face.label == FaceLabel::Roof) {
      face.label = FaceLabel::Ceiling;
    } else if (face.label != FaceLabel::Wall) {
      face.label = FaceLabel::Roof;
    }
  }
  return model;
}

int findFace(const PolyhedralModel& model, FaceLabel label) {
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    if (model.faces[f].label == label) return static_cast<int>(f);
  }
  return -1;
}

PolyhedralFace& faceOf(PolyhedralModel& model, FaceLabel label) {
  return model.faces[static_cast<std::size_t>(findFace(model, label))];
}

TEST(ModelCheck, GoodModel) {
  const ModelCheck check = checkModel(tower());
  EXPECT_TRUE(check.ok());
  EXPECT_EQ(check.vertices, 16u);
  EXPECT_EQ(check.faces, 11u);
  EXPECT_EQ(check.edges, 24u);  // two boxes of 12
  EXPECT_EQ(check.shells, 1u);
  EXPECT_EQ(check.euler, 2);
  EXPECT_NEAR(check.volume, 300.0 + 27.0, 1e-9);
  EXPECT_NEAR(check.area, 200.0 + 120.0 + 36.0, 1e-9);
}

TEST(ModelCheck, EmptyModelIsNoGood) { EXPECT_FALSE(checkModel(PolyhedralModel{}).ok()); }

TEST(ModelCheck, IndexOutOfRange) {
  for (const int index : {-1, 16, 1 << 30}) {
    PolyhedralModel model = tower();
    model.faces[2].outer[1] = index;
    EXPECT_EQ(checkModel(model).bad_indices, 1u);
  }
}

TEST(ModelCheck, UnusedVertex) {
  PolyhedralModel model = tower();
  model.vertices.emplace_back(0, 0, 0);
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.bad_indices, 1u);
  EXPECT_EQ(check.problems.size(), 1u);
}

TEST(ModelCheck, OffTheGrid) {
  for (const double x : {1e-7, std::nan(""), HUGE_VAL, 1e30}) {
    PolyhedralModel model = tower();
    model.vertices[3].x() += x;
    EXPECT_EQ(checkModel(model).off_grid, 1u) << x;
  }
  PolyhedralModel model = tower();
  for (const double grid : {0.0, -1.0, std::nan("")}) {
    model.grid = grid;
    EXPECT_EQ(checkModel(model).off_grid, 16u);
  }
}

TEST(ModelCheck, BadRings) {
  PolyhedralModel repeated = tower();
  repeated.faces[0].outer.push_back(repeated.faces[0].outer[1]);
  EXPECT_EQ(checkModel(repeated).bad_rings, 1u);

  PolyhedralModel two_corners = tower();
  two_corners.faces[0].outer.resize(2);
  EXPECT_EQ(checkModel(two_corners).bad_rings, 1u);

  PolyhedralModel empty = tower();
  empty.faces[0].outer.clear();
  EXPECT_EQ(checkModel(empty).bad_rings, 1u);

  PolyhedralModel crossing = tower();
  std::swap(crossing.faces[0].outer[0], crossing.faces[0].outer[1]);
  EXPECT_EQ(checkModel(crossing).bad_rings, 1u);

  // The roof around the tower: hole run the wrong way; hole outside the outer ring.
  PolyhedralModel wrong_way = tower();
  for (PolyhedralFace& f : wrong_way.faces) {
    if (!f.inner.empty()) std::reverse(f.inner[0].begin(), f.inner[0].end());
  }
  EXPECT_EQ(checkModel(wrong_way).bad_rings, 1u);
  PolyhedralModel outside = tower();
  for (PolyhedralFace& f : outside.faces) {
    if (f.inner.empty()) continue;
    std::swap(f.outer, f.inner[0]);
    std::reverse(f.outer.begin(), f.outer.end());
    std::reverse(f.inner[0].begin(), f.inner[0].end());
  }
  EXPECT_EQ(checkModel(outside).bad_rings, 1u);
}

TEST(ModelCheck, NotPlanar) {
  PolyhedralModel model = box();
  model.vertices[0].z() -= 0.5;  // one corner of the ground; the walls stay planar
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.non_planar, 1u);
  EXPECT_EQ(check.problems.size(), 1u);
  // A wall may deviate by one grid unit to either side, not by more.
  PolyhedralModel wall =
      extrudeFloorplans({layer(0, 3, {ring({{0, 0}, {10, 0}, {20, 0.5}, {20, 8}, {0, 8}})})}, 0.1);
  EXPECT_TRUE(checkModel(wall).ok());
  EXPECT_EQ(wall.faces.size(), 7u);  // five walls: 0.25 off is more than 0.1
  PolyhedralModel bent = wall;       // the front as one face
  std::vector<PolyhedralFace*> front;
  for (PolyhedralFace& f : bent.faces) {
    const bool in_front = std::all_of(f.outer.begin(), f.outer.end(), [&](int i) {
      return bent.vertices[static_cast<std::size_t>(i)].y() < 1.0;
    });
    if (in_front && f.label == FaceLabel::Wall) front.push_back(&f);
  }
  ASSERT_EQ(front.size(), 2u);
  const auto vertex = [&](double x, double z) {
    for (std::size_t i = 0; i < bent.vertices.size(); ++i) {
      const Eigen::Vector3d& v = bent.vertices[i];
      if (std::abs(v.x() - x) < 0.01 && std::abs(v.z() - z) < 0.01 && v.y() < 1) {
        return static_cast<int>(i);
      }
    }
    return -1;
  };
  front[0]->outer = {vertex(0, 0),  vertex(10, 0), vertex(20, 0),
                     vertex(20, 3), vertex(10, 3), vertex(0, 3)};
  bent.faces.erase(bent.faces.begin() + (front[1] - bent.faces.data()));
  EXPECT_EQ(checkModel(bent).non_planar, 1u);
}

TEST(ModelCheck, Mislabelled) {
  PolyhedralModel model = box();
  faceOf(model, FaceLabel::Ground).label = FaceLabel::Roof;
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.mislabelled, 1u);
  EXPECT_EQ(check.problems.size(), 1u);
}

TEST(ModelCheck, MissingFaceLeavesItsEdgesOpen) {
  PolyhedralModel model = box();
  model.faces.erase(model.faces.begin() + findFace(model, FaceLabel::Roof));
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.open_edges, 4u);
  EXPECT_EQ(check.overused_edges, 0u);
}

TEST(ModelCheck, TurnedFaceRunsEdgesInTheSameSense) {
  PolyhedralModel model = box();
  PolyhedralFace& wall = faceOf(model, FaceLabel::Wall);
  std::reverse(wall.outer.begin(), wall.outer.end());
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.overused_edges, 4u);
  EXPECT_EQ(check.open_edges, 4u);
}

TEST(ModelCheck, FaceTwice) {
  PolyhedralModel model = box();
  model.faces.push_back(faceOf(model, FaceLabel::Roof));
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.overused_edges, 4u);
  EXPECT_FALSE(check.ok());
}

TEST(ModelCheck, SharedVertexOfTwoShellsIsSplit) {
  // two boxes that touch at a corner, with one vertex for both
  PolyhedralModel model = join(box(), box(4, 4, 4));
  ASSERT_TRUE(checkModel(model).ok());
  int keep = -1;
  int drop = -1;
  for (std::size_t i = 0; i < model.vertices.size(); ++i) {
    if (model.vertices[i] == Eigen::Vector3d(4, 4, 4))
      (keep < 0 ? keep : drop) = static_cast<int>(i);
  }
  for (PolyhedralFace& f : model.faces) {
    for (int& i : f.outer) i = i == drop ? keep : i > drop ? i - 1 : i;
  }
  model.vertices.erase(model.vertices.begin() + drop);
  EXPECT_EQ(checkModel(model).split_vertices, 1u);
}

TEST(ModelCheck, WrongShells) {
  PolyhedralModel model = box();
  model.faces[3].shell = 1;
  EXPECT_EQ(checkModel(model).wrong_shells, 1u);
  model = box();
  model.num_shells = 2;
  EXPECT_EQ(checkModel(model).wrong_shells, 1u);
  model = join(box(), box(10, 10));
  for (PolyhedralFace& f : model.faces) f.shell = 0;
  EXPECT_GE(checkModel(model).wrong_shells, 1u);
}

TEST(ModelCheck, InvertedShell) {
  const ModelCheck check = checkModel(flipped(box()));
  EXPECT_EQ(check.inverted_shells, 1u);
  EXPECT_EQ(check.problems.size(), 1u);
  EXPECT_LT(check.volume, 0.0);
}

TEST(ModelCheck, CavityIsAllowedSolidInSolidIsNot) {
  const PolyhedralModel outer = box(0, 0, 0, 12);
  const ModelCheck cavity = checkModel(join(outer, flipped(box(4, 4, 4))));
  EXPECT_TRUE(cavity.ok());
  EXPECT_NEAR(cavity.volume, 12 * 12 * 12 - 64, 1e-9);
  EXPECT_EQ(checkModel(join(outer, box(4, 4, 4))).inverted_shells, 1u);
  EXPECT_EQ(checkModel(join(outer, flipped(box(20, 20, 20)))).inverted_shells, 1u);
}

TEST(ModelCheck, TJunction) {
  // A vertex in the middle of an edge of the roof only: the wall runs the whole edge.
  PolyhedralModel model = box();
  PolyhedralFace& roof = faceOf(model, FaceLabel::Roof);
  const Eigen::Vector3d a = model.vertices[static_cast<std::size_t>(roof.outer[0])];
  const Eigen::Vector3d b = model.vertices[static_cast<std::size_t>(roof.outer[1])];
  roof.outer.insert(roof.outer.begin() + 1, static_cast<int>(model.vertices.size()));
  model.vertices.push_back(0.5 * (a + b));
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.t_junctions, 1u);
  EXPECT_EQ(check.open_edges, 3u);  // the wall's whole edge, the roof's two halves
}

TEST(ModelCheck, SelfContact) {
  // Two towers on a podium, moved until they touch along an edge: combinatorially still a
  // manifold, but not in space.
  PolyhedralModel model =
      extrudeFloorplans({layer(0, 3, {rectangle(0, 0, 10, 10)}),
                         layer(3, 6, {rectangle(2, 2, 4, 4), rectangle(4.5, 4.5, 8, 8)})},
                        0.5);
  ASSERT_TRUE(checkModel(model).ok());
  for (Eigen::Vector3d& v : model.vertices) {
    if (v.x() == 4.5) v.x() = 4.0;
    if (v.y() == 4.5) v.y() = 4.0;
  }
  EXPECT_EQ(checkModel(model).self_contacts, 2u);  // foot and top of the edge
}

TEST(ModelCheck, OverlappingShells) {
  EXPECT_GE(checkModel(join(box(), box(2, 2, 2))).self_intersections, 1u);
  EXPECT_GE(checkModel(join(box(), box(2, 0, 0))).self_intersections, 1u);  // coplanar sides
  EXPECT_GE(checkModel(join(box(), box(4, 0, 0))).self_intersections, 1u);  // a wall in common
  EXPECT_GE(checkModel(join(box(), box(0, 0, 0))).self_intersections, 1u);  // the same twice
}

TEST(ModelCheck, TouchingShellsAreAllowed) {
  EXPECT_TRUE(checkModel(join(box(), box(4, 4, 0))).ok());  // edge on edge
  EXPECT_TRUE(checkModel(join(box(), box(4, 4, 2))).ok());  // part of an edge
  EXPECT_TRUE(checkModel(join(box(), box(4, 4, 4))).ok());  // corner on corner
  EXPECT_TRUE(checkModel(join(box(), box(4, 0, 4))).ok());  // horizontal edge
  EXPECT_TRUE(checkModel(join(box(), box(10, 0, 0))).ok());
}

TEST(ModelCheck, PartThatCutsThroughItsOwnShell) {
  // The tower's roof lowered through the podium.
  PolyhedralModel model = tower();
  for (Eigen::Vector3d& v : model.vertices) {
    if (v.z() == 6.0) v.z() = -2.0;
  }
  const ModelCheck check = checkModel(model);
  EXPECT_GE(check.self_intersections, 1u);
  EXPECT_EQ(check.open_edges + check.overused_edges + check.split_vertices, 0u);
}

TEST(ModelCheck, SplitPlane) {
  // The roof of a box cut in two.
  PolyhedralModel model = box();
  PolyhedralFace& roof = faceOf(model, FaceLabel::Roof);
  const std::vector<int> r = roof.outer;
  roof.outer = {r[0], r[1], r[2]};
  PolyhedralFace half = roof;
  half.outer = {r[0], r[2], r[3]};
  model.faces.push_back(half);
  const ModelCheck check = checkModel(model);
  EXPECT_EQ(check.split_planes, 1u);
  EXPECT_EQ(check.problems.size(), 1u);
}

TEST(ModelCheck, ProblemsAreBounded) {
  PolyhedralModel model = tower();
  model.grid = 0.77;
  const ModelCheck check = checkModel(model);
  EXPECT_GT(check.off_grid, 3u);
  EXPECT_EQ(check.problems.size(), 3u);
}

// Whatever is broken: an answer, and for a change that matters the answer is no.
TEST(ModelCheck, GarbageNeverCrashes) {
  std::mt19937 random(7);
  const PolyhedralModel good = tower();
  for (int i = 0; i < 3000; ++i) {
    PolyhedralModel model = good;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int c = 0; c < changes; ++c) {
      PolyhedralFace& face = model.faces[random() % model.faces.size()];
      std::vector<int>& ring_of_face = face.outer;
      switch (random() % 7) {
        case 0:
          if (!ring_of_face.empty()) {
            ring_of_face[random() % ring_of_face.size()] = static_cast<int>(random() % 20) - 2;
          }
          break;
        case 1:
          std::shuffle(ring_of_face.begin(), ring_of_face.end(), random);
          break;
        case 2:
          ring_of_face.resize(random() % 6, 3);
          break;
        case 3:
          face.inner.push_back(model.faces[random() % model.faces.size()].outer);
          break;
        case 4:
          face.label = static_cast<FaceLabel>(random() % 4);
          break;
        case 5:
          model.vertices[random() % model.vertices.size()][static_cast<int>(random() % 3)] =
              std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 200) - 80);
          break;
        default:
          model.vertices[random() % model.vertices.size()] =
              model.vertices[random() % model.vertices.size()];
      }
    }
    const ModelCheck check = checkModel(model);
    EXPECT_EQ(check.ok(), check.problems.empty());
  }
}

}  // namespace
