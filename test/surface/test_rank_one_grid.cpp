// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_edges.h>

#include <algorithm>
#include <random>

namespace storey::detail {
namespace {

const std::vector<Band> kColumns = {{10, 22}, {31, 43}, {60, 72}, {80, 92}};  // no one pitch
const std::vector<Band> kRows = {{8, 26}, {40, 58}, {65, 83}};

Eigen::ArrayXXf gridScores(const std::vector<std::pair<int, int>>& missing) {
  Eigen::ArrayXXf scores = Eigen::ArrayXXf::Constant(100, 110, -1.0f);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (std::find(missing.begin(), missing.end(), std::pair(row, column)) != missing.end()) {
        continue;
      }
      const auto& x = kColumns[static_cast<std::size_t>(column)];
      const auto& y = kRows[static_cast<std::size_t>(row)];
      scores.block(static_cast<int>(y.begin), static_cast<int>(x.begin),
                   static_cast<int>(y.length()), static_cast<int>(x.length())) = 1.0f;
    }
  }
  return scores;
}

TEST(BandGrid, FindsIrregularPitchesFromOneWindow) {
  const BandGrid grid = fitBandGrid(gridScores({}), kColumns[1], kRows[2]);
  EXPECT_EQ(grid.columns, kColumns);
  EXPECT_EQ(grid.rows, kRows);
}

TEST(BandGrid, AllowsForMissingWindows) {
  const BandGrid grid =
      fitBandGrid(gridScores({{0, 0}, {0, 1}, {1, 2}, {1, 3}, {2, 0}}), kColumns[1], kRows[2]);
  EXPECT_EQ(grid.columns, kColumns);
  EXPECT_EQ(grid.rows, kRows);
}

// Every tenth label wrong: over the 18 or 12 texels across a band the wrong ones are too few to
// move an edge, but those of a row or two may.
TEST(BandGrid, StandsWrongLabels) {
  Eigen::ArrayXXf scores = gridScores({{1, 1}});
  std::mt19937 random(5);
  std::bernoulli_distribution wrong(0.1);
  for (Eigen::Index i = 0; i < scores.size(); ++i) {
    if (wrong(random)) scores(i) *= -1.0f;
  }
  const BandGrid grid = fitBandGrid(scores, {30, 45}, {62, 85});  // drawn loosely
  ASSERT_EQ(grid.columns.size(), kColumns.size());
  ASSERT_EQ(grid.rows.size(), kRows.size());
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    EXPECT_NEAR(grid.columns[i].begin, kColumns[i].begin, 1.0);
    EXPECT_NEAR(grid.columns[i].end, kColumns[i].end, 1.0);
  }
}

TEST(BandGrid, IsEmptyWhereNothingIsWindow) {
  const BandGrid grid =
      fitBandGrid(Eigen::ArrayXXf::Constant(100, 110, -1.0f), kColumns[1], kRows[2]);
  EXPECT_TRUE(grid.columns.empty() || grid.rows.empty());
}

// Labels of texels that an edge crosses are of window in proportion to their area. Edges measured
// so are exact up to the texels' rim; one photo lies far off, as where a branch hides the edge.
TEST(WindowEdges, AreFoundWithinATenthOfATexel) {
  constexpr double kShift = 0.37;
  const auto share = [&](double at, const std::vector<Band>& bands) {
    double covered = 0.0;
    for (const Band& band : bands) {
      covered +=
          std::max(0.0, std::min(at + 1.0, band.end + kShift) - std::max(at, band.begin + kShift));
    }
    return covered;
  };
  WindowScores scores(100, 110);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 110; ++x) {
      scores(y, x) = static_cast<float>(2.0 * share(x, kColumns) * share(y, kRows) - 1.0);
    }
  }
  WindowScores hidden = scores;
  hidden.block(0, 55, 100, 8) = 1.0f;
  std::vector<RectifiedView> views(3);
  for (RectifiedView& view : views) view.sharpness = 1.0;
  const BandGrid grid = fitEdges(views, {scores, hidden, scores}, {kColumns, kRows});
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    EXPECT_NEAR(grid.columns[i].begin, kColumns[i].begin + kShift, 0.1);
    EXPECT_NEAR(grid.columns[i].end, kColumns[i].end + kShift, 0.1);
  }
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    EXPECT_NEAR(grid.rows[i].begin, kRows[i].begin + kShift, 0.1);
    EXPECT_NEAR(grid.rows[i].end, kRows[i].end + kShift, 0.1);
  }
}

}  // namespace
}  // namespace storey::detail
