// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

constexpr double kWidth = 10.0;
constexpr double kDepth = 6.0;
constexpr double kHeight = 9.0;

/// A box of 10 x 6 x 9, turned about the vertical.
PolyhedralModel boxAt(double yaw) {
  const Eigen::Rotation2Dd turn(yaw);
  FloorplanRing ring;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {kWidth, 0.0}, {kWidth, kDepth}, {0.0, kDepth}}) {
    ring.vertices.push_back(turn * Eigen::Vector2d(x, y));
  }
  ring.edges.resize(4);
  FloorplanComponent component;
  component.outer = ring;
  FloorplanLayer layer;
  layer.z_min = 0.0;
  layer.z_max = kHeight;
  layer.plan.components.push_back(component);
  return extrudeFloorplans({layer});
}

/// A wall that is 10 wide.
std::size_t wideWall(const PolyhedralModel& model) {
  const std::vector<Facade> facades = facadesOf(model);
  for (std::size_t f = 0; f < facades.size(); ++f) {
    const bool is_wall = model.faces[f].label == FaceLabel::Wall;
    if (is_wall && std::abs(frameOf(facades[f]).width - kWidth) < 0.01) return f;
  }
  return facades.size();
}

/// 4 x 3 windows of 1.2 x 1.5.
std::vector<FacadeWindow> windowsInRows() {
  std::vector<FacadeWindow> windows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      FacadeWindow window;
      window.min = {0.7 + 2.3 * column, 0.8 + 2.7 * row};
      window.max = window.min + Eigen::Vector2d(1.2, 1.5);
      windows.push_back(window);
    }
  }
  return windows;
}

class WindowCutting : public ::testing::TestWithParam<double> {};

// 12 windows of 1.2 x 1.5, d deep, take 21.6 d off the volume, and more if they stand out. Corners
// are off by up to 8.5 grid units, 6 in x and in y.
TEST_P(WindowCutting, ChangesTheVolumeByThatOfTheWindows) {
  for (const double depth : {0.3, -0.2, 2.0}) {
    for (const bool from_inside : {false, true}) {
      PolyhedralModel model = boxAt(GetParam());
      const double before = checkModel(model).volume;
      const std::size_t wall = wideWall(model);
      Facade facade = facadesOf(model)[wall];
      if (from_inside) facade.normal *= -1.0;
      const auto cut = cutWindows(model, wall, frameOf(facade), windowsInRows(), depth);
      EXPECT_EQ(std::count(cut.begin(), cut.end(), true), 12);
      const ModelCheck check = checkModel(model);
      EXPECT_TRUE(check.ok()) << check.problems.front();
      const double sign = from_inside ? 1.0 : -1.0;
      const double off = 12.0 * 8.5 * model.grid * 2.0 * (1.2 + 1.5 + 1.2 * 1.5);
      EXPECT_NEAR(check.volume - before, sign * depth * 12.0 * 1.2 * 1.5, off);
      const auto count = [&](WindowPart part) {
        return std::count_if(model.faces.begin(), model.faces.end(),
                             [part](const PolyhedralFace& f) { return f.window == part; });
      };
      EXPECT_EQ(count(WindowPart::Pane), 12);
      EXPECT_EQ(count(WindowPart::Reveal), 48);
    }
  }
}

TEST_P(WindowCutting, LeavesOutWhatWouldBreakTheModel) {
  PolyhedralModel model = boxAt(GetParam());
  const std::size_t wall = wideWall(model);
  const FacadeFrame frame = frameOf(facadesOf(model)[wall]);
  std::vector<FacadeWindow> windows = windowsInRows();
  windows[1].max.x() = windows[2].min.x() + 0.1;  // overlaps the next one
  windows[11].max.x() = kWidth + 0.5;             // reaches beyond the wall
  const std::vector<bool> cut = cutWindows(model, wall, frame, windows, 0.3);
  EXPECT_TRUE(checkModel(model).ok());
  EXPECT_FALSE(cut[11]);
  EXPECT_NE(cut[1], cut[2]);  // one of the two
  EXPECT_EQ(std::count(cut.begin(), cut.end(), true), 10);
}

TEST_P(WindowCutting, LeavesTheModelAloneIfTheDepthIsNone) {
  for (const double depth : {0.0, kDepth + 1.0, std::nan("")}) {
    PolyhedralModel model = boxAt(GetParam());
    const std::size_t wall = wideWall(model);
    const FacadeFrame frame = frameOf(facadesOf(model)[wall]);
    const auto cut = cutWindows(model, wall, frame, windowsInRows(), depth);
    EXPECT_EQ(std::count(cut.begin(), cut.end(), true), 0);
    EXPECT_EQ(model.faces.size(), 6u);
    EXPECT_EQ(model.vertices.size(), 8u);
  }
}

INSTANTIATE_TEST_SUITE_P(Yaw, WindowCutting, ::testing::Values(0.0, 0.3, 0.7853981633974483));

}  // namespace
}  // namespace storey
