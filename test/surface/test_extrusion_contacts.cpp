// SPDX-License-Identifier: BSD-3-Clause
// Blocks that touch others, or themselves, along edges and at points.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include "solids.h"
#include "stacks.h"

namespace {

using namespace storey;
using namespace storey::test;

TEST(ExtrusionContacts, BlocksThatTouchAlongAVerticalEdgeAreTwoShells) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 5, 5), rectangle(5, 5, 9, 9)})}, {16, 12, 2, 4});
  // of different heights: no vertex in the middle of the taller one's edge
  expectSolid({layer(0, 3, {rectangle(0, 0, 5, 5), rectangle(5, 5, 9, 9)}),
               layer(3, 5, {rectangle(5, 5, 9, 9)})},
              {16, 12, 2, 4});
}

TEST(ExtrusionContacts, BlocksThatTouchAtAPointAreTwoShells) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 5, 5)}), layer(3, 5, {rectangle(5, 5, 9, 9)})},
              {16, 12, 2, 4});
}

TEST(ExtrusionContacts, StoreyThatTouchesTheLowerOneAlongALineIsAShell) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 5, 5)}), layer(3, 5, {rectangle(5, 1, 9, 4)})},
              {16, 12, 2, 4});
}

TEST(ExtrusionContacts, CornerThatTouchesAWallIsAShell) {
  expectSolid({layer(0, 3, {rectangle(0, 0, 10, 4), ring({{5, 4}, {7, 6}, {5, 8}, {3, 6}})})},
              {16, 12, 2, 4});
}

// A part that touches itself is made one solid by a plug: closed, genus as in space, and as good
// as the same volume.
void expectPlugged(const std::vector<FloorplanLayer>& layers, int shells, int euler) {
  const PolyhedralModel model = extrudeFloorplans(layers);
  const ModelCheck check = checkModel(model);
  EXPECT_TRUE(check.ok()) << problemsOf(check);
  EXPECT_EQ(model.num_shells, shells);
  EXPECT_EQ(check.euler, euler);
  EXPECT_NEAR(check.volume, layerVolume(layers), 1e-3 * check.volume);
  EXPECT_TRUE(std::any_of(model.faces.begin(), model.faces.end(),
                          [](const PolyhedralFace& f) { return f.hypothetical; }));
}

TEST(ExtrusionContacts, SelfContactAlongAVerticalEdgeIsPlugged) {
  expectPlugged({layer(0, 3, {rectangle(0, 0, 5, 5), rectangle(5, 5, 9, 9)}),
                 layer(3, 5, {rectangle(0, 0, 9, 9)})},
                1, 2);  // the two legs and the plug are one leg
}

TEST(ExtrusionContacts, SelfContactAlongAHorizontalEdgeIsPlugged) {
  // A block hangs from the top storey beside the lower one and touches its upper edge; the two
  // are also connected by a leg: with the contact filled that is a handle.
  expectPlugged({layer(0, 3, {rectangle(0, 0, 4, 8)}),
                 layer(3, 6, {rectangle(4, 0, 8, 4), rectangle(0, 6, 4, 8)}),
                 layer(6, 9, {rectangle(0, 0, 8, 8)})},
                1, 0);
}

TEST(ExtrusionContacts, SelfContactAtAPointIsPlugged) {
  FloorplanLayer low = layer(0, 3, {rectangle(0, 0, 10, 10)});
  FloorplanLayer high = layer(3, 6, {rectangle(0, 0, 10, 10)});
  low.plan.components[0].outer = ring({{0, 0}, {10, 0}, {10, 10}, {5, 10}, {5, 5}, {0, 5}});
  high.plan.components[0].outer = ring({{0, 0}, {5, 0}, {5, 5}, {10, 5}, {10, 10}, {0, 10}});
  const ModelCheck check = checkModel(extrudeFloorplans({low, high}));
  EXPECT_TRUE(check.ok()) << problemsOf(check);
}

TEST(ExtrusionContacts, CourtyardsThatTouchAreSeparated) {
  FloorplanLayer yards = layer(0, 3, {rectangle(0, 0, 10, 10)});
  yards.plan.components[0].holes = {reversed(rectangle(2, 2, 5, 5)),
                                    reversed(rectangle(5, 5, 8, 8))};
  expectPlugged({yards}, 1, -2);  // genus 2
}

}  // namespace
