// SPDX-License-Identifier: BSD-3-Clause
// The first grid of windows, from an image of a wall that is painted here.
#include <gtest/gtest.h>
#include <storey/surface/detail/window_proposal.h>

#include <cmath>
#include <random>
#include <vector>

namespace storey::detail {
namespace {

constexpr double kTexel = 0.1;

/// A wall as one photo shows it: grey of deviation 6, and what is painted on it.
class PaintedWall {
 public:
  PaintedWall(int width, int height)
      : grid_(0, frame(width, height), outline(width, height), kTexel) {
    RectifiedView view;
    view.photo = 0;
    view.sharpness = 1.0;
    view.seen.assign(static_cast<std::size_t>(width * height), 1);
    std::mt19937 random(1);
    for (std::size_t i = 0; i < view.seen.size(); ++i) {
      // Sum of four uniform numbers: a deviation of 6, the same on every machine.
      double sum = 0.0;
      for (int k = 0; k < 4; ++k) sum += static_cast<double>(random()) / 4294967296.0 - 0.5;
      view.colors.push_back(Eigen::Array3f::Constant(static_cast<float>(140.0 + 10.4 * sum)));
    }
    views_.push_back(std::move(view));
  }

  void paint(int left, int top, int width, int height, float level) {
    for (int y = top; y < top + height; ++y) {
      for (int x = left; x < left + width; ++x) {
        const auto texel = static_cast<std::size_t>(y * grid_.width + x);
        views_[0].colors[texel] += level - 140.0f;
      }
    }
  }

  /// A dark pane in a light frame.
  void paintWindow(int left, int top, int width, int height) {
    paint(left, top, width, height, 200.0f);
    paint(left + 2, top + 2, width - 4, height - 4, 140.0f - 150.0f);
  }

  const TextureGrid& grid() const { return grid_; }
  std::vector<RectifiedView>& views() { return views_; }

 private:
  static FacadeFrame frame(int width, int height) {
    FacadeFrame frame;
    frame.width = width * kTexel;
    frame.height = height * kTexel;
    return frame;
  }
  static FacadeOutline outline(int width, int height) {
    const double w = width * kTexel;
    const double h = height * kTexel;
    return {{{0.0, 0.0}, {w, 0.0}, {w, h}, {0.0, h}}};
  }

  TextureGrid grid_;
  std::vector<RectifiedView> views_;
};

constexpr int kColumns[] = {15, 40, 80, 105};  // no pitch
constexpr int kRows[] = {12, 50, 85};
constexpr int kWidth = 14;
constexpr int kHeight = 20;

/// Windows at all crossings but one.
PaintedWall wallWithWindows() {
  PaintedWall wall(140, 120);
  for (const int column : kColumns) {
    for (const int row : kRows) {
      if (column != kColumns[1] || row != kRows[2]) wall.paintWindow(column, row, kWidth, kHeight);
    }
  }
  return wall;
}

void expectBands(const std::vector<Band>& bands, const int* begins, std::size_t count, int length) {
  ASSERT_EQ(bands.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(bands[i].begin, begins[i], 1.0) << i;  // half a pixel and noise
    EXPECT_NEAR(bands[i].end, begins[i] + length, 1.0) << i;
  }
}

TEST(WindowProposal, IsTheGridThatWasPainted) {
  PaintedWall wall = wallWithWindows();
  const WindowProposal proposal = proposeGrid(wall.grid(), wall.views());
  ASSERT_EQ(proposal.problem, "");
  expectBands(proposal.bands.columns, kColumns, 4, kWidth);
  expectBands(proposal.bands.rows, kRows, 3, kHeight);
  EXPECT_GT(proposal.scores.block(kRows[0], kColumns[0], kHeight, kWidth).mean(), 0.5f);
  EXPECT_LT(proposal.scores.block(kRows[2], kColumns[1], kHeight, kWidth).mean(), -0.5f);
}

TEST(WindowProposal, IsOfWhatMostPhotosShow) {
  PaintedWall wall = wallWithWindows();
  const RectifiedView clear = wall.views()[0];
  wall.paint(0, 30, 140, 30, 30.0f);  // something in front of a quarter of the wall
  for (Eigen::Array3f& color : wall.views()[0].colors) color *= 1.2f;  // and brighter
  wall.views().push_back(clear);
  wall.views().push_back(clear);
  const WindowProposal proposal = proposeGrid(wall.grid(), wall.views());
  ASSERT_EQ(proposal.problem, "");
  expectBands(proposal.bands.columns, kColumns, 4, kWidth);
  expectBands(proposal.bands.rows, kRows, 3, kHeight);
}

TEST(WindowProposal, NeedsRepetition) {
  PaintedWall blank(140, 120);
  EXPECT_NE(proposeGrid(blank.grid(), blank.views()).problem, "");
  PaintedWall one(140, 120);
  one.paintWindow(60, 50, kWidth, kHeight);
  EXPECT_NE(proposeGrid(one.grid(), one.views()).problem, "");
}

TEST(WindowProposal, NeedsToSeeTheWall) {
  PaintedWall wall = wallWithWindows();
  for (std::size_t i = 0; i < wall.views()[0].seen.size() * 3 / 5; ++i) wall.views()[0].seen[i] = 0;
  EXPECT_NE(proposeGrid(wall.grid(), wall.views()).problem, "");
  EXPECT_NE(proposeGrid(wall.grid(), {}).problem, "");
}

TEST(WindowProposal, WithAMarkIsOfThatWindow) {
  PaintedWall wall(140, 120);
  for (const int column : kColumns) {
    wall.paintWindow(column, 12, kWidth, kHeight);
    wall.paintWindow(column, 48, kWidth, kHeight);
    wall.paintWindow(column + 2, 90, 10, 10);  // half as high
  }
  const WindowProposal large = proposeGridWith(wall.grid(), wall.views(), {14, 30}, {11, 33});
  ASSERT_EQ(large.problem, "");
  // The rows of large windows, as painted; half as high may still be taken for one of them.
  ASSERT_GE(large.bands.rows.size(), 2u);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_NEAR(large.bands.rows[row].begin, row == 0 ? 12.0 : 48.0, 1.0);
    EXPECT_NEAR(large.bands.rows[row].length(), kHeight, 1.0);
  }
  const WindowProposal small = proposeGridWith(wall.grid(), wall.views(), {16, 28}, {89, 101});
  ASSERT_EQ(small.problem, "");
  EXPECT_EQ(small.bands.columns.size(), 4u);
  EXPECT_NEAR(small.bands.rows.back().middle(), 95.0, 1.5);
  EXPECT_NEAR(small.bands.rows.back().length(), 10.0, 2.0);
  EXPECT_NE(proposeGridWith(wall.grid(), wall.views(), {130, 140}, {112, 120}).problem, "");
}

TEST(WindowProposal, OfAnySizeOfWallIsNoMistake) {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 400}, {100000, 3}, {7, 5}}) {
    PaintedWall wall(width, height);
    EXPECT_NE(proposeGrid(wall.grid(), wall.views()).problem, "") << width << " x " << height;
    const Band columns{width - 1.0, static_cast<double>(width)};
    const Band rows{height - 1.0, static_cast<double>(height)};
    EXPECT_NE(proposeGridWith(wall.grid(), wall.views(), columns, rows).problem, "");
  }
}

}  // namespace
}  // namespace storey::detail
