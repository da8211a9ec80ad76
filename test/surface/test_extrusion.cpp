// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "solids.h"
#include "stacks.h"

namespace {

using namespace storey;
using namespace storey::test;

TEST(Extrusion, Box) {
  const auto layers = std::vector<FloorplanLayer>{layer(1, 4, {rectangle(0, 0, 10, 5)})};
  expectSolid(layers, {8, 6, 1, 2});
  const PolyhedralModel model = extrudeFloorplans(layers);
  EXPECT_NEAR(checkModel(model).area, 2 * 50 + 30 * 3, 1e-9);
  EXPECT_EQ(countLabel(model, FaceLabel::Ground), 1u);
  EXPECT_EQ(countLabel(model, FaceLabel::Roof), 1u);
  EXPECT_EQ(model.storeys.size(), 1u);
}

TEST(Extrusion, DefaultGridIsAPowerOfTenAbove2ToMinus20OfTheExtent) {
  for (const double scale : {1e-3, 1.0, 7.0, 1e3}) {
    const double extent = 10 * scale;
    const double grid = extrudeFloorplans({layer(0, scale, {rectangle(0, 0, extent, scale)})}).grid;
    EXPECT_GE(grid, extent / (1 << 20));
    EXPECT_LT(grid, 10 * extent / (1 << 20));
    EXPECT_NEAR(std::log10(grid), std::round(std::log10(grid)), 1e-9);
  }
}

TEST(Extrusion, GridGiven) {
  const PolyhedralModel model =
      extrudeFloorplans({layer(0.1, 2.9, {rectangle(0.1, 0.2, 7.3, 5.4)})}, 0.5);
  EXPECT_TRUE(checkModel(model).ok());
  EXPECT_EQ(model.vertices.front(), Eigen::Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(model.vertices.back(), Eigen::Vector3d(7.5, 5.5, 3.0));
}

TEST(Extrusion, LShape) {
  expectSolid({layer(0, 3, {ring({{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 9}, {0, 9}})})},
              {12, 8, 1, 2});
}

TEST(Extrusion, Courtyard) {
  FloorplanLayer yard = layer(0, 3, {rectangle(0, 0, 10, 8)});
  yard.plan.components[0].holes.push_back(reversed(rectangle(3, 2, 6, 5)));
  expectSolid({yard}, {16, 10, 1, 0});  // a torus
  const PolyhedralModel model = extrudeFloorplans({yard});
  EXPECT_EQ(std::count_if(model.faces.begin(), model.faces.end(),
                          [](const PolyhedralFace& f) { return f.inner.size() == 1; }),
            2);
}

TEST(Extrusion, TowersOnPodiumLeaveHolesInItsRoof) {
  const std::vector<FloorplanLayer> layers = {
      layer(0, 3, {rectangle(0, 0, 20, 10)}),
      layer(3, 9, {rectangle(2, 2, 6, 6), rectangle(10, 3, 15, 8)})};
  expectSolid(layers, {8 + 8 + 8, 6 + 5 + 5, 1, 2});
  const PolyhedralModel model = extrudeFloorplans(layers);
  EXPECT_EQ(std::count_if(model.faces.begin(), model.faces.end(),
                          [](const PolyhedralFace& f) { return f.inner.size() == 2; }),
            1);
  EXPECT_EQ(countLabel(model, FaceLabel::Roof), 3u);
}

TEST(Extrusion, OverhangIsACeilingLegsAreGround) {
  // Two legs carry a slab that hangs over between them and beyond one of them.
  const std::vector<FloorplanLayer> layers = {
      layer(0, 3, {rectangle(0, 0, 4, 6), rectangle(8, 0, 12, 6)}),
      layer(3, 6, {rectangle(0, 0, 14, 6)})};
  expectSolid(layers, {20, 12, 1, 2});  // a prism over a 10-gon
  const PolyhedralModel model = extrudeFloorplans(layers);
  EXPECT_EQ(countLabel(model, FaceLabel::Ground), 2u);
  EXPECT_EQ(countLabel(model, FaceLabel::Ceiling), 2u);
  EXPECT_EQ(countLabel(model, FaceLabel::Roof), 1u);
}

TEST(Extrusion, SetbackFlushWithAWallIsOnePolygon) {
  // The upper storey shares the wall y = 0 in part, and x = 0 and x = 10 in part.
  expectSolid({layer(0, 3, {rectangle(0, 0, 10, 6)}), layer(3, 6, {rectangle(0, 0, 10, 4)})},
              {12, 8, 1, 2});  // a prism over an L
  // In the middle of the front only: the front is one polygon with 8 corners.
  const std::vector<FloorplanLayer> middle = {layer(0, 3, {rectangle(0, 0, 10, 6)}),
                                              layer(3, 6, {rectangle(3, 0, 7, 4)})};
  expectSolid(middle, {16, 10, 1, 2});
  const PolyhedralModel model = extrudeFloorplans(middle);
  EXPECT_EQ(std::count_if(model.faces.begin(), model.faces.end(),
                          [](const PolyhedralFace& f) { return f.outer.size() == 8; }),
            2);  // the front, and the roof around the tower
}

TEST(Extrusion, CoplanarWallsAreOnePolygonAtAnyYaw) {
  for (int i = 0; i < 40; ++i) {
    const double yaw = 0.17 * i;
    std::vector<FloorplanLayer> layers = {layer(0, 3, {rectangle(0, 0, 10, 6)}),
                                          layer(3, 6, {rectangle(3, 0, 7, 4)}),
                                          layer(6, 7, {rectangle(4, 0, 5.5, 2)})};
    move(layers, 1.0, yaw, {1000.0, -2000.0});
    expectSolid(layers, {24, 14, 1, 2});
  }
}

TEST(Extrusion, ComponentsAreShells) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 2, 2), rectangle(5, 5, 7, 7)})}, {16, 12, 2, 4});
}

TEST(Extrusion, ClosedCavityIsAShellTurnedInwards) {
  FloorplanLayer yard = layer(3, 6, {rectangle(0, 0, 10, 10)});
  yard.plan.components[0].holes = {reversed(rectangle(2, 2, 5, 5))};
  expectSolid(
      {layer(0, 3, {rectangle(0, 0, 10, 10)}), yard, layer(6, 9, {rectangle(0, 0, 10, 10)})},
      {16, 12, 2, 4});
}

TEST(Extrusion, GapBetweenLayersStaysAGap) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 5, 5)}), layer(3.5, 5, {rectangle(0, 0, 5, 5)})},
              {16, 12, 2, 4});
  // The upper part has something below it.
  const PolyhedralModel model = extrudeFloorplans(
      {layer(0, 3, {rectangle(0, 0, 5, 5)}), layer(3.5, 5, {rectangle(0, 0, 5, 5)})});
  EXPECT_EQ(countLabel(model, FaceLabel::Ground), 1u);
  EXPECT_EQ(countLabel(model, FaceLabel::Ceiling), 1u);
}

TEST(Extrusion, EqualLayersAreOneBlock) {
  std::vector<FloorplanLayer> layers;
  for (int i = 0; i < 20; ++i) layers.push_back(layer(i, i + 1, {rectangle(0, 0, 5, 7)}));
  expectSolid(layers, {8, 6, 1, 2});
}

TEST(Extrusion, EndsOfCollinearWallsMakeNoTJunctions) {
  // Along y = 4: a row below with corners at 3 and 7, one above with corners at 2, 5 and 7.
  expectSolid({layer(0, 3, {rectangle(0, 0, 3, 4), rectangle(3.5, 0, 7, 4)}),
               layer(3, 5, {rectangle(0, 0, 7, 4)}),
               layer(5, 6, {rectangle(0, 1, 2, 4), rectangle(5, 1, 7, 4)})},
              {28, 16, 1, 2});
}

TEST(Extrusion, WallIdsAndHypothesesAreKept) {
  FloorplanLayer low = layer(0, 3, {rectangle(0, 0, 10, 6)});
  FloorplanLayer high = layer(3, 5, {rectangle(3, 0, 7, 6)});
  low.plan.components[0].outer.edges = {{4, false}, {5, true}, {6, false}, {7, false}};
  high.plan.components[0].outer.edges = {{4, true}, {8, true}, {6, false}, {9, false}};
  const PolyhedralModel model = extrudeFloorplans({low, high});
  ASSERT_TRUE(checkModel(model).ok());
  std::vector<std::pair<int, bool>> walls;
  for (const PolyhedralFace& f : model.faces) {
    if (f.label == FaceLabel::Wall) walls.emplace_back(f.wall, f.hypothetical);
    if (f.label != FaceLabel::Wall) {
      EXPECT_EQ(f.wall, -1);
    }
  }
  std::sort(walls.begin(), walls.end());
  // Wall 4: 30 seen below, 8 not seen above.
  const std::vector<std::pair<int, bool>> expected = {{4, false}, {5, true}, {6, false},
                                                      {7, false}, {8, true}, {9, false}};
  EXPECT_EQ(walls, expected);
}

TEST(Extrusion, OrderOfComponentsAndRingsDoesNotMatter) {
  const std::vector<FloorplanRing> rings = {rectangle(0, 0, 4, 4), rectangle(6, 1, 9, 5),
                                            rectangle(1, 6, 3, 9)};
  const PolyhedralModel a =
      extrudeFloorplans({layer(0, 3, rings), layer(3, 5, {rings[0], rings[1]})});
  FloorplanRing turned = rings[0];
  std::rotate(turned.vertices.begin(), turned.vertices.begin() + 2, turned.vertices.end());
  const PolyhedralModel b = extrudeFloorplans(
      {layer(0, 3, {rings[2], turned, rings[1]}), layer(3, 5, {rings[1], turned})});
  EXPECT_EQ(a.vertices, b.vertices);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(a.faces[f].outer, b.faces[f].outer);
    EXPECT_EQ(a.faces[f].inner, b.faces[f].inner);
    EXPECT_EQ(a.faces[f].shell, b.faces[f].shell);
  }
}

TEST(Extrusion, UnusableInputGivesAnEmptyModel) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const FloorplanRing square = rectangle(0, 0, 1, 1);
  EXPECT_TRUE(extrudeFloorplans({}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(1, 0, {square})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, kNan, {square})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {rectangle(0, 0, 1, kNan)})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {rectangle(0, 0, 1, INFINITY)})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {ring({{0, 0}, {1, 1}})})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {ring({{0, 0}, {1, 1}, {2, 2}})})}).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {square})}, -1.0).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {square})}, kNan).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {square})}, 100.0).empty());
  EXPECT_TRUE(extrudeFloorplans({layer(0, 1, {square})}, 1e-12).empty());
  FloorplanLayer no_edges = layer(0, 1, {square});
  no_edges.plan.components[0].outer.edges.clear();
  EXPECT_TRUE(extrudeFloorplans({no_edges}).empty());
}

TEST(Extrusion, RingsThatAreNotSimpleStillGiveAClosedSolid) {
  const PolyhedralModel bow_tie =
      extrudeFloorplans({layer(0, 1, {ring({{0, 0}, {4, 4}, {4, 0}, {0, 4}})})});
  EXPECT_TRUE(checkModel(bow_tie).ok());
  EXPECT_EQ(bow_tie.num_shells, 2);
  const PolyhedralModel spike =
      extrudeFloorplans({layer(0, 1, {ring({{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}})})});
  EXPECT_TRUE(checkModel(spike).ok());
  EXPECT_NEAR(checkModel(spike).volume, 16.0, 1e-3);
}

// Random blocks of cells of an uneven, sheared, turned grid: walls shared between layers, holes,
// contacts along edges and at points everywhere.
TEST(Extrusion, RandomStacksOfCells) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::vector<FloorplanLayer> layers = randomCellStack(random);
    const double volume = layerVolume(layers);
    const PolyhedralModel model = extrudeFloorplans(layers);
    const ModelCheck check = checkModel(model);
    ASSERT_TRUE(check.ok()) << "seed " << seed << "\n" << problemsOf(check);
    EXPECT_NEAR(check.volume, volume, 2e-3 * volume) << "seed " << seed;  // plugs
  }
}

TEST(Extrusion, RandomStacksOfStars) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<FloorplanLayer> layers = randomStarStack(random);
    const PolyhedralModel model = extrudeFloorplans(layers);
    const ModelCheck check = checkModel(model);
    ASSERT_TRUE(check.ok()) << "seed " << seed << "\n" << problemsOf(check);
    EXPECT_NEAR(check.volume, layerVolume(layers),
                2 * volumeTolerance(layers, model.grid) + 1e-5 * check.volume)
        << "seed " << seed;
  }
}

TEST(Extrusion, MovedTurnedAndScaled) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
      std::mt19937 random(seed);
      std::vector<FloorplanLayer> layers = randomCellStack(random);
      std::uniform_real_distribution<double> angle(0.0, 2 * M_PI);
      move(layers, scale, angle(random), {1e3 * scale, -7e2 * scale});
      const ModelCheck check = checkModel(extrudeFloorplans(layers));
      ASSERT_TRUE(check.ok()) << "seed " << seed << " scale " << scale << "\n" << problemsOf(check);
      EXPECT_NEAR(check.volume, layerVolume(layers), 2e-3 * check.volume);
    }
  }
}

// A grid so coarse that everything collides on it: still closed and correct on the grid.
TEST(Extrusion, CoarseGrid) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const std::vector<FloorplanLayer> layers = randomStarStack(random);
    const ModelCheck check = checkModel(extrudeFloorplans(layers, 0.05));
    ASSERT_TRUE(check.ok()) << "seed " << seed << "\n" << problemsOf(check);
  }
}

// Every ten layers are equal: six blocks of forty walls.
TEST(Extrusion, SixtyLayersOfFortyWalls) {
  std::vector<FloorplanLayer> layers;
  for (int i = 0; i < 60; ++i) {
    FloorplanRing outline;
    for (int k = 0; k < 40; ++k) {
      const double radius = 8 + ((k * 7 + i / 10) % 5) * 0.4;
      outline.vertices.push_back(radius *
                                 Eigen::Vector2d(std::cos(k * M_PI / 20), std::sin(k * M_PI / 20)));
    }
    outline.edges.resize(40);
    layers.push_back(layer(0.5 * i, 0.5 * (i + 1), {outline}));
  }
  const PolyhedralModel model = extrudeFloorplans(layers);
  const ModelCheck check = checkModel(model);
  EXPECT_TRUE(check.ok()) << problemsOf(check);
  EXPECT_NEAR(check.volume, layerVolume(layers), volumeTolerance(layers, model.grid));
}

}  // namespace
