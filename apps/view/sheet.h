// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "view/drawing.h"
#include "view/layout.h"

namespace storey::view {

// Sizes in a picture of 1600 x 1200.
constexpr double kFont = 21.0;
constexpr double kLine = 30.0;  // from one line of the legend to the next
constexpr double kMargin = 24.0;
constexpr Colour kGrey{95, 95, 100};

enum class Align { Left, Centre, Right };

/// Draws flat things onto a window, in its pixels.
class Sheet {
 public:
  using Points = std::vector<Eigen::Vector2d>;

  Sheet(vtkRenderer& renderer, const Layout& layout) : renderer_(renderer), layout_(layout) {}

  /// Text with its middle height at `at`, set smaller if it would be wider than `max_width`.
  void text(const std::string& text, const Eigen::Vector2d& at, double font, double max_width,
            Colour colour, Align align = Align::Left);
  void polygon(const Points& corners, Colour colour) { add(corners, colour, true, 1.0); }
  void line(const Points& corners, Colour colour, double width) {
    add(corners, colour, false, width);
  }
  /// Separate lines, drawn as one.
  void segments(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& ends, Colour colour,
                double width);
  void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Colour colour) {
    polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, colour);
  }

 private:
  void add(const Points& corners, Colour colour, bool filled, double width);
  void add(vtkPolyData* data, Colour colour, double width);

  vtkRenderer& renderer_;
  const Layout& layout_;
};

}  // namespace storey::view
