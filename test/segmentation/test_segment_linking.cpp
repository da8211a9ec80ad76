// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <random>

#include "floorplans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::LineSegment;
using detail::LinkingMethod;
using detail::LinkingOptions;
using Segments = std::vector<LineSegment>;

constexpr double kTolerance = 0.25;

LineSegment segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  LineSegment s;
  s.start = a;
  s.end = b;
  const Eigen::Vector2d t = (b - a).normalized();
  s.normal = {t.y(), -t.x()};
  s.support = 100;
  return s;
}

// The edges of a ring, each without `trimmed` at both ends.
Segments segmentsOf(const Corners& corners, double trimmed = 0.0) {
  Segments segments;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    const Eigen::Vector2d t = (b - a).normalized();
    segments.push_back(segment(a + trimmed * t, b - trimmed * t));
  }
  return segments;
}

Segments together(Segments a, const Segments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Segments without(Segments segments, std::size_t i) {
  segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(i));
  return segments;
}

// Linked, closed and assembled, as SliceFloorplanExtraction does.
Floorplan planOf(const Segments& segments, const LinkingOptions& options) {
  const std::vector<int> next = detail::linkSegments(segments, options);
  std::vector<char> seen(next.size(), 0);
  std::vector<FloorplanRing> rings;
  for (std::size_t first = 0; first < next.size(); ++first) {
    Segments cycle;
    for (std::size_t i = first; seen[i] == 0 && next[i] >= 0;
         i = static_cast<std::size_t>(next[i])) {
      seen[i] = 1;
      cycle.push_back(segments[i]);
    }
    if (cycle.size() >= 2) rings.push_back(detail::closeRing(cycle, options));
  }
  return detail::assembleFloorplan(rings, 1.0);
}

class Linking : public ::testing::TestWithParam<LinkingMethod> {
 protected:
  LinkingOptions options(double yaw = 0.0) const {
    LinkingOptions result;
    result.method = GetParam();
    result.tolerance = kTolerance;
    for (int i = 0; i < 4; ++i) {
      result.directions.emplace_back(std::cos(yaw + 0.5 * M_PI * i),
                                     std::sin(yaw + 0.5 * M_PI * i));
    }
    return result;
  }

  // The plan of the rings turned, shifted, and with the segments in any order.
  void expectFoundEverywhere(const std::vector<Corners>& outers, const std::vector<Corners>& holes,
                             double trimmed) const {
    std::mt19937 random(5);
    for (const double yaw : {0.0, 0.4, 1.1, 2.0, -2.9}) {
      const Eigen::Vector2d shift(100.0 * yaw, -50.0 * yaw);
      Segments segments;
      double expected = 0.0;
      for (const std::vector<Corners>* rings : {&outers, &holes}) {
        for (const Corners& ring : *rings) {
          segments = together(segments, segmentsOf(moved(ring, yaw, shift), trimmed));
          expected += signedArea(ringOf(ring));
        }
      }
      std::shuffle(segments.begin(), segments.end(), random);
      const Floorplan plan = planOf(segments, options(yaw));
      expectValid(plan);
      ASSERT_EQ(plan.components.size(), outers.size()) << "yaw " << yaw;
      EXPECT_NEAR(area(plan), expected, 1e-9);
      for (const Corners& outer : outers) {
        const Corners there = moved(outer, yaw, shift);
        EXPECT_TRUE(std::any_of(plan.components.begin(), plan.components.end(),
                                [&](const FloorplanComponent& component) {
                                  return sameCorners(component.outer, there, 1e-9) &&
                                         countHypothetical(component.outer) == 0;
                                }))
            << "yaw " << yaw;
      }
      ASSERT_EQ(plan.components[0].holes.size(), holes.size());
      for (std::size_t h = 0; h < holes.size(); ++h) {
        EXPECT_TRUE(sameCorners(plan.components[0].holes[h], moved(holes[h], yaw, shift), 1e-9));
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Linking,
                         ::testing::Values(LinkingMethod::Optimal, LinkingMethod::Greedy),
                         [](const auto& method) {
                           return method.param == LinkingMethod::Optimal ? "Optimal" : "Greedy";
                         });

const Corners kL = {{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}};

TEST_P(Linking, FindsABox) { expectFoundEverywhere({box(0, 0, 10, 6)}, {}, 0.1); }

TEST_P(Linking, FindsAnL) { expectFoundEverywhere({kL}, {}, 0.1); }

TEST_P(Linking, FindsACourtyard) {
  expectFoundEverywhere({box(0, 0, 20, 16)}, {clockwise(box(6, 5, 14, 11))}, 0.1);
}

TEST_P(Linking, FindsACourtyardBehindThinWalls) {
  expectFoundEverywhere({box(0, 0, 20, 16)}, {clockwise(box(1, 1, 19, 15))}, 0.1);
}

TEST_P(Linking, FindsTwoComponents) {
  expectFoundEverywhere({box(0, 0, 10, 10), box(14, 0, 20, 6)}, {}, 0.1);
}

TEST_P(Linking, FindsObliqueWalls) {
  expectFoundEverywhere({{{0, 0}, {12, 0}, {16, 4}, {16, 12}, {8, 14}, {0, 12}}}, {}, 0.1);
}

TEST_P(Linking, ExtendsWallsToTheirCorners) {
  expectFoundEverywhere({kL}, {}, 0.8);
  expectFoundEverywhere({box(0, 0, 20, 16)}, {clockwise(box(6, 5, 14, 11))}, 1.0);
}

TEST_P(Linking, AWindowGapLeavesNoVertex) {
  Segments segments = without(segmentsOf(box(0, 0, 10, 6)), 0);
  segments.push_back(segment({0, 0}, {4, 0}));
  segments.push_back(segment({5.5, -0.01}, {10, -0.01}));  // fitted apart: a little aside
  const Floorplan plan = planOf(segments, options());
  ASSERT_EQ(plan.components.size(), 1U);
  expectValid(plan);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, box(0, 0, 10, 6), 0.01));
  EXPECT_EQ(countHypothetical(plan.components[0].outer), 0U);
}

TEST_P(Linking, AMissingWallIsCompletedAndMarked) {
  for (const double yaw : {0.0, 0.7, -2.0}) {
    const Corners corners = moved(box(0, 0, 10, 6), yaw, {3, -4});
    const Floorplan plan = planOf(without(segmentsOf(corners), 1), options(yaw));
    ASSERT_EQ(plan.components.size(), 1U);
    expectValid(plan);
    const FloorplanRing& outer = plan.components[0].outer;
    EXPECT_TRUE(sameCorners(outer, corners, 1e-9));
    EXPECT_EQ(countHypothetical(outer), 1U);
    for (std::size_t i = 0; i < outer.size(); ++i) {
      EXPECT_EQ(outer.edges[i].hypothetical, (outer.vertices[i] - corners[1]).norm() < 1e-6);
    }
  }
}

TEST_P(Linking, TheCompletedWallTurnsAboutItsCentreToTheDominantDirection) {
  // The gap runs from (10, 0) to (9, 6): its centre has x = 9.5, the wall there is upright.
  Segments segments = without(segmentsOf(box(0, 0, 10, 6)), 1);
  segments[1] = segment({9, 6}, {0, 6});
  const Floorplan turned = planOf(segments, options());
  ASSERT_EQ(turned.components.size(), 1U);
  EXPECT_TRUE(sameCorners(turned.components[0].outer, box(0, 0, 9.5, 6), 1e-9));
  // Without directions it stays as the gap runs.
  LinkingOptions undirected = options();
  undirected.directions.clear();
  const Floorplan straight = planOf(segments, undirected);
  ASSERT_EQ(straight.components.size(), 1U);
  EXPECT_TRUE(sameCorners(straight.components[0].outer, {{0, 0}, {10, 0}, {9, 6}, {0, 6}}, 1e-9));
  EXPECT_EQ(countHypothetical(straight.components[0].outer), 1U);
}

TEST_P(Linking, AnUnseenJogIsCompletedSquareToTheWall) {
  const Corners jogged = {{0, 0}, {5, 0}, {5, 1}, {10, 1}, {10, 6}, {0, 6}};
  const Floorplan plan = planOf(without(segmentsOf(jogged), 1), options());
  ASSERT_EQ(plan.components.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, jogged, 1e-9));
  EXPECT_EQ(countHypothetical(plan.components[0].outer), 1U);
}

TEST_P(Linking, AJogBelowTheToleranceGoes) {
  const double jog = 0.8 * kTolerance;
  const Corners jogged = {{0, 0}, {5, 0}, {5, jog}, {10, jog}, {10, 6}, {0, 6}};
  const Floorplan plan = planOf(segmentsOf(jogged), options());
  ASSERT_EQ(plan.components.size(), 1U);
  // One wall half way, by its two equal parts.
  EXPECT_TRUE(sameCorners(plan.components[0].outer, box(0, 0.5 * jog, 10, 6), 1e-6));
}

TEST_P(Linking, WallsThatMeetExactlyNeedNoCompletion) {
  expectFoundEverywhere({kL}, {}, 0.0);
  expectFoundEverywhere({box(0, 0, 20, 16)}, {clockwise(box(6, 5, 14, 11))}, 0.0);
}

TEST_P(Linking, WallsThatOvershootTheirCornerAreCutBack) {
  // By noise; the second wall also where the first one ends just at the corner.
  expectFoundEverywhere({kL}, {}, -0.1);
  for (const double overshoot : {1e-12, 0.01, 0.1, 0.2}) {
    for (std::size_t i = 0; i < 4; ++i) {
      Segments segments = segmentsOf(box(0, 0, 10, 6), 1e-3);
      segments[i].start -= overshoot * segments[i].tangent();
      const Floorplan plan = planOf(segments, options());
      ASSERT_EQ(plan.components.size(), 1U) << overshoot;
      EXPECT_TRUE(sameCorners(plan.components[0].outer, box(0, 0, 10, 6), 1e-9)) << overshoot;
      EXPECT_EQ(countHypothetical(plan.components[0].outer), 0U);
    }
  }
}

TEST_P(Linking, EndsScatteredAboutObliqueCornersGiveTheCorners) {
  // Turns of 30 to 120 degrees; every end is before or behind its corner by less than a tolerance.
  const Corners corners = {{0, 0}, {12, 0}, {17, 3}, {17, 12}, {8, 14}, {-2, 8}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> scatter(-0.4 * kTolerance, 0.4 * kTolerance);
  for (int round = 0; round < 200; ++round) {
    Segments segments = segmentsOf(corners);
    for (LineSegment& s : segments) {
      s.start += scatter(random) * s.tangent();
      s.end += scatter(random) * s.tangent();
    }
    const Floorplan plan = planOf(segments, options());
    ASSERT_EQ(plan.components.size(), 1U) << round;
    EXPECT_TRUE(sameCorners(plan.components[0].outer, corners, 1e-9)) << round;
    EXPECT_EQ(countHypothetical(plan.components[0].outer), 0U) << round;
  }
}

TEST_P(Linking, NoSegmentsGiveNoRing) {
  EXPECT_TRUE(detail::linkSegments({}, options()).empty());
  EXPECT_TRUE(planOf({}, options()).empty());
  EXPECT_TRUE(planOf({segment({0, 0}, {5, 0})}, options()).empty());
}

TEST_P(Linking, SegmentsInOnePlaceEndAndGiveAValidPlan) {
  Segments segments;
  for (int i = 0; i < 6; ++i) segments = together(segments, segmentsOf(box(0, 0, 10, 6)));
  expectValid(planOf(segments, options()));
  expectValid(planOf(Segments(9, segment({1, 1}, {1, 1})), options()));
}

TEST_P(Linking, SuccessorsAreAPermutationOfThoseInRings) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  for (int round = 0; round < 100; ++round) {
    Segments segments;
    for (int i = 0; i < 12; ++i) {
      segments.push_back(segment({place(random), place(random)}, {place(random), place(random)}));
    }
    const std::vector<int> next = detail::linkSegments(segments, options());
    ASSERT_EQ(next.size(), segments.size());
    std::vector<int> taken(segments.size(), 0);
    std::vector<int> leaves(segments.size(), 0);
    for (std::size_t i = 0; i < next.size(); ++i) {
      ASSERT_LT(next[i], static_cast<int>(next.size()));
      EXPECT_NE(next[i], static_cast<int>(i));
      if (next[i] < 0) continue;
      ++taken[static_cast<std::size_t>(next[i])];
      ++leaves[i];
    }
    for (std::size_t i = 0; i < next.size(); ++i) {
      EXPECT_LE(taken[i], 1);
      EXPECT_EQ(taken[i], leaves[i]) << "a path that does not close";
    }
    expectValid(planOf(segments, options()));
  }
}

TEST(LinkOptimally, GoesOnWhereTheNearestSegmentLeadsAstray) {
  // A comb of four teeth that are nearer to each other than to their ends, every wall trimmed:
  // the teeth's tips are 2 wide, the gaps between them 1.
  Corners comb = {{0, 0}, {11, 0}};
  for (int tooth = 3; tooth >= 0; --tooth) {
    const double x = 3.0 * tooth;
    comb.emplace_back(x + 2.0, 8.0);
    comb.emplace_back(x, 8.0);
    if (tooth > 0) {
      comb.emplace_back(x, 4.0);
      comb.emplace_back(x - 1.0, 4.0);
    }
  }
  LinkingOptions options;
  options.tolerance = kTolerance;
  const Floorplan plan = planOf(segmentsOf(comb, 0.3), options);
  ASSERT_EQ(plan.components.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, comb, 1e-9));
}

TEST(LinkOptimally, LeavesOutWhatIsNoWall) {
  // A short piece in the middle of a box: to link it would cost two gaps of 4.
  Segments segments = segmentsOf(box(0, 0, 10, 10));
  segments.push_back(segment({5, 5}, {5.5, 5.3}));
  LinkingOptions options;
  options.tolerance = kTolerance;
  const std::vector<int> next = detail::linkSegments(segments, options);
  EXPECT_EQ(next.back(), -1);
  EXPECT_TRUE(
      sameCorners(planOf(segments, options).components.at(0).outer, box(0, 0, 10, 10), 1e-9));
}

TEST(LinkOptimally, LeavesOutWhatIsFurtherThanT) {
  // Two walls face each other 30 apart; to close them would take two edges of 30.
  const Segments segments = {segment({0, 0}, {8, 0}), segment({8, 30}, {0, 30})};
  LinkingOptions options;
  options.tolerance = kTolerance;
  options.max_gap = 10.0;
  EXPECT_EQ(detail::linkSegments(segments, options), (std::vector<int>{-1, -1}));
}

}  // namespace
