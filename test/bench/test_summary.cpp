// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bench/summary.h"

namespace storey::bench {
namespace {

TEST(Quantile, IsTheNearestRank) {
  const std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0, 10.0, 9.0, 8.0, 7.0, 6.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.9), 9.0);  // 9 of 10 do not exceed it
  EXPECT_EQ(quantile(values, 0.91), 10.0);
  EXPECT_EQ(quantile(values, 1.0), 10.0);
  EXPECT_EQ(quantile({2.5}, 0.9), 2.5);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 10.0}), 3.0);
  EXPECT_EQ(median({}), 0.0);
}

/// A valid model of a box, as good as can be.
Outcome good() {
  Outcome outcome;
  Measures& m = outcome.measures;
  m.noise = 0.1;
  m.polygons = m.true_polygons = 6;
  m.corners = m.true_corners = 8;
  m.worst_corner = 0.5;
  m.error_limit = m.corner_limit = 0.01;
  m.error = 0.02;
  m.corner = 0.03;
  m.iou = 0.999;
  m.has_model = m.valid = true;
  m.seconds = 2.0;
  return outcome;
}

Outcome refused() {
  Outcome outcome = good();
  outcome.measures.has_model = outcome.measures.valid = false;
  outcome.measures.iou = 0.0;
  return outcome;
}

TEST(Exactness, WantsPolygonsAndCornersAndTheirPlaces) {
  EXPECT_TRUE(isExact(good()));
  EXPECT_FALSE(isExact(refused()));
  Outcome outcome = good();
  outcome.measures.polygons = 7;
  EXPECT_FALSE(isExact(outcome));
  outcome = good();
  outcome.measures.corners = 7;
  EXPECT_FALSE(isExact(outcome));
  outcome = good();
  outcome.measures.worst_corner = 0.51;  // the noise is 0.1
  EXPECT_FALSE(isExact(outcome));
  outcome.measures.noise = 0.2;
  EXPECT_TRUE(isExact(outcome));
}

TEST(ExactWhereShown, IsExactWhereNoWallIsHidden) {
  EXPECT_TRUE(isExactWhereShown(good()));
  EXPECT_FALSE(isExactWhereShown(refused()));
  Outcome outcome = good();
  outcome.measures.worst_corner = 0.51;  // of the noise 0.1, the corners shown do not count
  EXPECT_FALSE(isExactWhereShown(outcome));
}

TEST(ExactWhereShown, ForgivesWhatAHiddenWallCanHide) {
  Outcome outcome = good();
  Measures& m = outcome.measures;
  m.hidden_walls = 1;
  m.worst_corner = 20.0;
  m.worst_shown_corner = 0.5;
  EXPECT_TRUE(isExactWhereShown(outcome));
  m.polygons = 4;
  m.corners = 4;
  EXPECT_TRUE(isExactWhereShown(outcome));
  m.polygons = 3;
  EXPECT_FALSE(isExactWhereShown(outcome));
  m.polygons = 4;
  m.corners = 3;
  EXPECT_FALSE(isExactWhereShown(outcome));
  m.hidden_walls = 2;
  EXPECT_TRUE(isExactWhereShown(outcome));
}

TEST(ExactWhereShown, ForgivesNothingTooManyNorACornerShown) {
  Outcome outcome = good();
  outcome.measures.hidden_walls = 1;
  outcome.measures.worst_corner = 20.0;
  for (const auto too_many : {&Measures::polygons, &Measures::corners}) {
    Outcome more = outcome;
    ++(more.measures.*too_many);
    EXPECT_FALSE(isExactWhereShown(more));
  }
  outcome.measures.worst_shown_corner = 0.51;
  EXPECT_FALSE(isExactWhereShown(outcome));
  outcome = refused();
  outcome.measures.hidden_walls = 1;
  outcome.measures.worst_corner = 20.0;
  EXPECT_FALSE(isExactWhereShown(outcome));
}

TEST(Summary, CountsFailuresAsWhatTheyAre) {
  Outcome worse = good();
  worse.measures.iou = 0.9;
  worse.measures.error = 0.05;
  worse.measures.valid = false;
  const Summary s = summarize({good(), refused(), worse}, 0.99);
  EXPECT_EQ(s.count, 3u);
  EXPECT_EQ(s.models, 2u);
  EXPECT_EQ(s.valid, 1u);
  EXPECT_EQ(s.exact, 2u);
  EXPECT_EQ(s.overlapping, 1u);
  EXPECT_EQ(s.iou_min, 0.0);
  EXPECT_EQ(s.iou_median, 0.9);
  EXPECT_DOUBLE_EQ(s.ratio_median, 3.5);  // of 2 and 5: the refusal has none
  EXPECT_DOUBLE_EQ(s.ratio_max, 5.0);
  EXPECT_DOUBLE_EQ(s.corner_ratio_median, 3.0);
}

TEST(Summary, OfNothingIsZero) {
  const Summary s = summarize({}, 0.99);
  EXPECT_EQ(s.count, 0u);
  EXPECT_EQ(s.ratio_max, 0.0);
}

}  // namespace
}  // namespace storey::bench
