// SPDX-License-Identifier: BSD-3-Clause
#include "view/layout.h"

#include <algorithm>
#include <limits>

namespace storey::view {

Layout layoutOf(int width, int height) {
  constexpr double kMargin = 20.0;
  constexpr double kTitle = 110.0;
  constexpr double kFoot = 130.0;
  constexpr double kLegend = 300.0;
  Layout layout;
  layout.width = width;
  layout.height = height;
  layout.unit = std::min(width / 1600.0, height / 1200.0);
  layout.left = kMargin * layout.unit;
  layout.bottom = kFoot * layout.unit;
  layout.right = layout.width - kLegend * layout.unit;
  layout.top = layout.height - kTitle * layout.unit;
  return layout;
}

double pixelsPerLength(const Layout& layout, const ProjectedBounds& bounds) {
  constexpr double kRoom = 0.97;  // points and lines are wider than their coordinates
  const Eigen::Vector3d size = bounds.max - bounds.min;
  double pixels = std::numeric_limits<double>::infinity();
  if (size.x() > 0.0) pixels = std::min(pixels, (layout.right - layout.left) / size.x());
  if (size.y() > 0.0) pixels = std::min(pixels, (layout.top - layout.bottom) / size.y());
  return pixels < std::numeric_limits<double>::infinity() ? kRoom * pixels : 1.0;
}

}  // namespace storey::view
