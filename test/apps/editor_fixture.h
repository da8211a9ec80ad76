// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "windows/window_editor.h"

namespace storey::test {

/// A wall of 8 x 5 with 3 x 2 windows of 1 x 1, and two cameras that look at it from the front.
/// In the photos of 800 x 600 pixels a length of 1 is 80 pixels; the wall's lower left corner is at
/// (80, 500) in the first, at (0, 500) in the second.
class EditedWall {
 public:
  static constexpr int kWidth = 800;
  static constexpr int kHeight = 600;

  /// Pixel of the first photo that shows a place of the wall.
  static Eigen::Vector2d pixel(double x, double y) { return {80.0 + 80.0 * x, 500.0 - 80.0 * y}; }

  static storey::Camera camera(double shift) {
    constexpr double kDistance = 10.0;
    storey::Camera camera;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.focal = {800.0, 800.0};
    camera.principal = {400.0, 300.0};
    // Before the wall y = 0: the camera's x is the world's, its y points down, its z along +y.
    camera.world_to_camera.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    const Eigen::Vector3d center(4.0 + shift, -kDistance, 2.5);
    camera.world_to_camera.translation() = -camera.world_to_camera.linear() * center;
    return camera;
  }

  /// The windows, whatever is asked for; the last one is doubtful.
  static storey::WindowGrid grid() {
    storey::WindowGrid grid;
    grid.facade = 7;
    grid.frame.right = Eigen::Vector3d::UnitX();
    grid.frame.up = Eigen::Vector3d::UnitZ();
    grid.frame.width = 8.0;
    grid.frame.height = 5.0;
    grid.texel = 0.01;
    grid.depth = 0.25;
    grid.depth_known = true;
    grid.photos = {0, 1};
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) {
        storey::FacadeWindow window;
        window.min = {1.0 + 2.0 * column, 1.0 + 2.0 * row};
        window.max = window.min + Eigen::Vector2d::Ones();
        window.row = row;
        window.column = column;
        window.confidence = 0.9;
        grid.windows.push_back(window);
      }
    }
    grid.windows.back().doubtful = true;
    return grid;
  }

  static std::vector<storey::windows::EditorPhoto> photos() {
    return {{"front.png", camera(0.0)}, {"shifted.png", camera(1.0)}};
  }

  /// Finds the grid if the mark's first corner is in the left half of its photo.
  static storey::windows::WindowFinder finder() {
    using storey::windows::FacadeEdit;
    using storey::windows::FoundFacade;
    storey::windows::WindowFinder finder;
    finder.find = [](const FacadeEdit& edit) {
      storey::WindowGrid found = grid();
      if (edit.quad[0].x() < 0.5 * kWidth) return found;
      found.windows.clear();
      found.problem = "nothing looks like it";
      return found;
    };
    finder.find_all = [] {
      FoundFacade facade;
      facade.edit.facade = 7;
      facade.found = grid();
      return std::vector<FoundFacade>{facade};
    };
    return finder;
  }
};

}  // namespace storey::test
