// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_grammar.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "../segmentation/floorplans.h"

namespace {

using namespace storey;
using namespace storey::test;
using Encoding = FloorplanGrammar::Encoding;

constexpr double kTolerance = 0.15;  // 1.5 noise deviations of 0.1
const Corners kL = {{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}};

Floorplan plan(const std::vector<Corners>& rings) {
  Floorplan result;
  for (const Corners& ring : rings) result.components.push_back({ringOf(ring), {}});
  return result;
}

// Every corner moved by N(0, deviation) in x and y.
Floorplan noisy(Floorplan result, double deviation, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, deviation);
  for (FloorplanComponent& component : result.components) {
    for (Eigen::Vector2d& v : component.outer.vertices) {
      v += Eigen::Vector2d(noise(random), noise(random));
    }
  }
  return result;
}

Floorplan startingAt(Floorplan result, std::size_t first) {
  for (FloorplanComponent& component : result.components) {
    const auto shift = static_cast<std::ptrdiff_t>(first % component.outer.size());
    auto& vertices = component.outer.vertices;
    std::rotate(vertices.begin(), vertices.begin() + shift, vertices.end());
    auto& edges = component.outer.edges;
    std::rotate(edges.begin(), edges.begin() + shift, edges.end());
  }
  return result;
}

FloorplanGrammar grammarOf(const std::vector<Floorplan>& plans, Encoding encoding) {
  FloorplanGrammar grammar;
  grammar.setEncoding(encoding);
  grammar.setLengthTolerance(kTolerance);
  grammar.encode(plans);
  return grammar;
}

// --- both encodings ---------------------------------------------------------------------------

class BothEncodings : public ::testing::TestWithParam<Encoding> {};

INSTANTIATE_TEST_SUITE_P(Encodings, BothEncodings,
                         ::testing::Values(Encoding::Walls, Encoding::Turns),
                         [](const auto& encoding) {
                           return encoding.param == Encoding::Walls ? "Walls" : "Turns";
                         });

TEST_P(BothEncodings, EqualFloorplansAreAtDistanceZeroWhateverTheirFirstCorner) {
  const Floorplan l = plan({kL});
  const FloorplanGrammar grammar = grammarOf({l, startingAt(l, 2), startingAt(l, 5)}, GetParam());
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) EXPECT_EQ(grammar.distance(a, b), 0.0);
  }
}

TEST_P(BothEncodings, ComponentsAreMatchedInAnyOrder) {
  const Corners first = kL;
  const Corners second = box(20, 0, 26, 8);
  const Corners third = box(40, 3, 43, 20);
  const FloorplanGrammar grammar = grammarOf(
      {plan({first, second, third}), plan({third, first, second}), plan({second, third, first})},
      GetParam());
  EXPECT_EQ(grammar.distance(0, 1), 0.0);
  EXPECT_EQ(grammar.distance(1, 2), 0.0);
}

TEST_P(BothEncodings, AnUnmatchedComponentCostsItsLength) {
  // 6 + 4 letters against 6: 4 / 10.
  const FloorplanGrammar grammar = grammarOf(
      {plan({kL, box(20, 0, 26, 8)}), plan({kL}), plan({kL, box(20, 0, 26, 8)})}, GetParam());
  EXPECT_DOUBLE_EQ(grammar.distance(0, 1), 0.4);
  EXPECT_DOUBLE_EQ(grammar.distance(1, 0), 0.4);
}

TEST_P(BothEncodings, EmptyFloorplansAreAtDistanceOneFromOthers) {
  const FloorplanGrammar grammar = grammarOf({plan({kL}), {}, plan({kL}), {}}, GetParam());
  EXPECT_TRUE(grammar.getStrings(1).empty());
  EXPECT_EQ(grammar.distance(1, 3), 0.0);
  EXPECT_EQ(grammar.distance(0, 1), 1.0);
  EXPECT_TRUE(grammar.decode(1).empty());
}

TEST_P(BothEncodings, DistancesAreSymmetricWithinZeroAndOneAndZeroForEqualsOnly) {
  std::mt19937 random(1);
  const std::vector<Corners> parts = {kL,
                                      box(0, 0, 10, 10),
                                      box(0, 0, 10, 7),
                                      {{0, 0}, {10, 0}, {10, 7}, {5, 7}, {5, 10}, {0, 10}},
                                      box(20, 0, 26, 8),
                                      box(20, 0, 26, 12),
                                      box(40, 0, 46, 8),
                                      clockwise(box(2, 1, 4, 3))};
  std::vector<Floorplan> plans;
  for (int i = 0; i < 30; ++i) {
    std::vector<Corners> chosen;
    for (const Corners& part : parts) {
      if (random() % 3 == 0) chosen.push_back(part);
    }
    plans.push_back(plan(chosen));
  }
  const FloorplanGrammar grammar = grammarOf(plans, GetParam());
  for (std::size_t a = 0; a < plans.size(); ++a) {
    EXPECT_EQ(grammar.distance(a, a), 0.0);
    for (std::size_t b = 0; b < plans.size(); ++b) {
      const double ab = grammar.distance(a, b);
      EXPECT_GE(ab, 0.0);
      EXPECT_LE(ab, 1.0);
      EXPECT_EQ(ab, grammar.distance(b, a));
      // The triangle inequality does not hold: (10) divides by the longer string's length.
      if (ab == 0.0) {
        EXPECT_DOUBLE_EQ(area(plans[a]), area(plans[b]));
      }
    }
  }
}

TEST_P(BothEncodings, RareEdgesShareTheSpecialLetter) {
  // The box is seen twice, the triangle once; none of its edges is one of the box.
  const FloorplanGrammar grammar = grammarOf(
      {plan({box(0, 0, 10, 6)}), plan({box(0, 0, 10, 6)}), plan({{{30, 1}, {37, 3}, {31, 9}}})},
      GetParam());
  for (const int letter : grammar.getStrings(2)[0]) {
    EXPECT_EQ(letter, FloorplanGrammar::kSpecialLetter);
  }
  for (const int letter : grammar.getStrings(0)[0]) {
    EXPECT_GE(letter, 0);
    EXPECT_LT(letter, static_cast<int>(grammar.getDictionarySize()));
  }
  EXPECT_EQ(grammar.distance(0, 2), 1.0);
  EXPECT_EQ(grammar.distance(2, 2), 0.0);
}

TEST_P(BothEncodings, BadTolerancesGiveNoStringsAndDecodeToTheInput) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    FloorplanGrammar grammar;
    grammar.setEncoding(GetParam());
    grammar.setLengthTolerance(bad);
    grammar.encode({plan({kL}), plan({kL})});
    EXPECT_EQ(grammar.getDictionarySize(), 0U);
    EXPECT_TRUE(grammar.getStrings(0).empty());
    EXPECT_TRUE(sameCorners(grammar.decode(1).components.at(0).outer, kL, 0.0));
  }
  FloorplanGrammar grammar;
  grammar.setLengthTolerance(1.0);
  grammar.setAngleTolerance(0.0);
  grammar.encode({plan({kL})});
  EXPECT_TRUE(grammar.getStrings(0).empty());
}

TEST_P(BothEncodings, EncodingAgainForgetsWhatWas) {
  FloorplanGrammar grammar = grammarOf({plan({kL}), plan({kL})}, GetParam());
  grammar.encode({plan({box(0, 0, 4, 4)}), plan({box(0, 0, 4, 4)})});
  const FloorplanGrammar fresh =
      grammarOf({plan({box(0, 0, 4, 4)}), plan({box(0, 0, 4, 4)})}, GetParam());
  EXPECT_EQ(grammar.getStrings(0), fresh.getStrings(0));
  EXPECT_EQ(grammar.getDictionarySize(), fresh.getDictionarySize());
}

// --- Turns, the paper's -------------------------------------------------------------------------

TEST(GrammarOfTurns, LettersAreTurnsAndLengths) {
  // The L has five left turns and one right turn, lengths 10, 10, 5, 5, 5, 5: an edge takes the
  // turn before it. From the corner (0, 0), nearest to the far point: left 10, left 5, left 5,
  // right 5, left 5, left 10. Three letters; and the box of 5 x 5 beside it has but one of them.
  const FloorplanGrammar grammar =
      grammarOf({plan({kL}), plan({box(20, 0, 25, 5)})}, Encoding::Turns);
  EXPECT_EQ(grammar.getDictionarySize(), 2U);  // the right turn occurs once: special
  const std::vector<int>& l = grammar.getStrings(0)[0];
  ASSERT_EQ(l.size(), 6U);
  const int left10 = l[0];
  const int left5 = l[1];
  EXPECT_NE(left10, left5);
  EXPECT_EQ(
      l, (std::vector<int>{left10, left5, left5, FloorplanGrammar::kSpecialLetter, left5, left10}));
  EXPECT_EQ(grammar.getStrings(1)[0], std::vector<int>(4, left5));
  // Three substitutions at the least turn and cut one string to the other: 6 letters against 4,
  // of which three agree: 3 / 6.
  EXPECT_DOUBLE_EQ(grammar.distance(0, 1), 0.5);
}

TEST(GrammarOfTurns, StartsAtTheCornerNearestToTheFarPoint) {
  for (std::size_t first = 0; first < 6; ++first) {
    const FloorplanGrammar grammar =
        grammarOf({startingAt(plan({kL}), first), plan({kL})}, Encoding::Turns);
    EXPECT_EQ(grammar.getStrings(0)[0], grammar.getStrings(1)[0]);
  }
}

TEST(GrammarOfTurns, DecodesToTheFloorplanAsGiven) {
  const FloorplanGrammar grammar = grammarOf({plan({kL}), plan({kL})}, Encoding::Turns);
  EXPECT_TRUE(sameCorners(grammar.decode(0).components.at(0).outer, kL, 0.0));
}

// --- Walls --------------------------------------------------------------------------------------

TEST(GrammarOfWalls, ALetterIsAWallOfTheBuilding) {
  // An L of two storeys that lacks its wing above: the four walls that go on keep their letters.
  const Floorplan above = plan({box(0, 0, 5, 10)});
  const FloorplanGrammar grammar =
      grammarOf({plan({kL}), above, plan({kL}), above}, Encoding::Walls);
  EXPECT_EQ(grammar.getDictionarySize(), 6U);
  const std::vector<int>& l = grammar.getStrings(0)[0];
  const std::vector<int>& b = grammar.getStrings(1)[0];
  EXPECT_EQ(std::set<int>(l.begin(), l.end()).size(), 6U);
  // Bottom, right (the L's inner wall), top, left.
  EXPECT_EQ(b, (std::vector<int>{l[0], l[3], l[4], l[5]}));
  EXPECT_DOUBLE_EQ(grammar.distance(0, 1), 2.0 / 6.0);
}

TEST(GrammarOfWalls, OppositeFacesAreDifferentLetters) {
  // A wall of thickness 0.1, less than the tolerance: a courtyard's face and the outer one.
  Floorplan ring = plan({box(0, 0, 10, 10)});
  ring.components[0].holes.push_back(ringOf(clockwise(box(0.1, 0.1, 9.9, 9.9))));
  const FloorplanGrammar grammar = grammarOf({ring, ring}, Encoding::Walls);
  EXPECT_EQ(grammar.getDictionarySize(), 8U);
}

TEST(GrammarOfWalls, AShiftIsSeenFromTheToleranceOn) {
  const auto distanceOfShift = [](double shift) {
    const Floorplan here = plan({kL});
    const Floorplan there = plan({moved(kL, 0.0, {shift, 0.0})});
    return grammarOf({here, there, here, there}, Encoding::Walls).distance(0, 1);
  };
  EXPECT_EQ(distanceOfShift(0.9 * kTolerance), 0.0);
  EXPECT_GT(distanceOfShift(1.1 * kTolerance), 0.0);
}

TEST(GrammarOfWalls, AMirroredFloorplanIsAnother) {
  Corners mirrored;
  for (const Eigen::Vector2d& c : kL) mirrored.emplace_back(10.0 - c.x(), c.y());
  const Floorplan first = plan({kL});
  const Floorplan second = plan({clockwise(mirrored)});  // reversed again: counter-clockwise
  ASSERT_GT(area(second), 0.0);
  EXPECT_GT(grammarOf({first, second, first, second}, Encoding::Walls).distance(0, 1), 0.0);
}

TEST(GrammarOfWalls, WorksInAnyFrame) {
  for (const double yaw : {0.0, 0.5, M_PI_2, M_PI, -2.2}) {
    for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1e7, -4e6)}) {
      const Floorplan l = plan({moved(kL, yaw, shift)});
      const Floorplan b = plan({moved(box(0, 0, 5, 10), yaw, shift)});
      const FloorplanGrammar grammar = grammarOf({l, b, l, b}, Encoding::Walls);
      EXPECT_EQ(grammar.getDictionarySize(), 6U);
      EXPECT_DOUBLE_EQ(grammar.distance(0, 1), 2.0 / 6.0);
      EXPECT_TRUE(
          sameCorners(grammar.decode(0).components.at(0).outer, moved(kL, yaw, shift), 1e-6));
    }
  }
}

TEST(GrammarOfWalls, DecodedFloorplansCloseAndAreTheInputUpToTheNoise) {
  // Each line is the mean of those of 30 slices, whose corners are 0.03 off: a corner is off by
  // 0.03 / sqrt 30 times a few, by a third of the noise for certain; and it is the same in all.
  std::mt19937 random(3);
  std::vector<Floorplan> plans;
  for (int i = 0; i < 30; ++i) plans.push_back(noisy(plan({kL}), 0.03, random));
  const FloorplanGrammar grammar = grammarOf(plans, Encoding::Walls);
  EXPECT_EQ(grammar.getDictionarySize(), 6U);
  const FloorplanRing first = grammar.decode(0).components.at(0).outer;
  EXPECT_TRUE(sameCorners(first, kL, 0.03));
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const FloorplanRing decoded = grammar.decode(i).components.at(0).outer;
    EXPECT_TRUE(isSimple(decoded));
    EXPECT_TRUE(sameCorners(decoded, first.vertices, 1e-9));
    for (std::size_t e = 0; e < decoded.size(); ++e) {
      EXPECT_EQ(decoded.edges[e].wall, grammar.getStrings(i)[0][e]);
    }
  }
}

TEST(GrammarOfWalls, WallsWithinTheAngleToleranceKeepTheirOwnDirections) {
  // The upper walls of the two parts are 2 degrees apart, less than the tolerance of 3.
  const double rise = 40.0 * std::tan(2.0 * M_PI / 180.0);
  const Corners leaning = {{0, 0}, {40, 0}, {40, 10 + rise}, {0, 10}};
  const Corners straight = {{0, 20}, {40, 20}, {40, 30}, {0, 30}};
  const Floorplan both = plan({leaning, straight});
  const FloorplanGrammar grammar = grammarOf({both, both}, Encoding::Walls);
  const Floorplan decoded = grammar.decode(0);
  EXPECT_TRUE(sameCorners(decoded.components.at(0).outer, leaning, 1e-9));
  EXPECT_TRUE(sameCorners(decoded.components.at(1).outer, straight, 1e-9));
}

TEST(GrammarOfWalls, EdgesWithTheSpecialLetterKeepTheirLine) {
  Floorplan other = plan({{{0, 0}, {10, 0}, {10, 5}, {6, 5}, {6, 10}, {0, 10}}});
  other.components[0].outer.edges[3].hypothetical = true;
  const FloorplanGrammar grammar = grammarOf({plan({kL}), plan({kL}), other}, Encoding::Walls);
  const FloorplanRing decoded = grammar.decode(2).components.at(0).outer;
  EXPECT_TRUE(sameCorners(decoded, other.components[0].outer.vertices, 1e-9));
  EXPECT_EQ(decoded.edges[3].wall, FloorplanGrammar::kSpecialLetter);
  EXPECT_TRUE(decoded.edges[3].hypothetical);
  EXPECT_GE(decoded.edges[2].wall, 0);
}

TEST(GrammarOfWalls, ARingWhoseLettersDoNotMeetStaysAsItIs) {
  // Two collinear edges in a row have one letter, whose line does not meet itself.
  const Corners split = {{0, 0}, {5, 0}, {10, 0}, {10, 6}, {0, 6}};
  const FloorplanGrammar grammar = grammarOf({plan({split}), plan({split})}, Encoding::Walls);
  const FloorplanRing decoded = grammar.decode(0).components.at(0).outer;
  EXPECT_TRUE(sameCorners(decoded, split, 0.0));
  for (const FloorplanEdge& edge : decoded.edges) {
    EXPECT_EQ(edge.wall, FloorplanGrammar::kSpecialLetter);
  }
}

}  // namespace
