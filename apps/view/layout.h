// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/projection.h"

namespace storey::view {

/// Where things go in a picture, in pixels from its lower left corner. The scene has a rectangle
/// of its own; the title is above it, axes and scale below, the legend to its right.
struct Layout {
  double width = 0.0;
  double height = 0.0;
  double unit = 1.0;  ///< pixels for one of a picture of 1600 x 1200
  double left = 0.0;  ///< the scene
  double bottom = 0.0;
  double right = 0.0;
  double top = 0.0;
};

Layout layoutOf(int width, int height);

/// Pixels for a unit of length with which the bounds just fit into the scene; 1 if the bounds are
/// a single point.
double pixelsPerLength(const Layout& layout, const ProjectedBounds& bounds);

}  // namespace storey::view
