// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "view/drawing.h"

namespace storey::view {

/// A parallel projection: orthonormal axes of the picture in the frame of the drawing.
struct Projection {
  Eigen::Vector3d right;
  Eigen::Vector3d up;
  Eigen::Vector3d towards;  ///< to the eye; right x up
  double shortening = 1.0;  ///< of lengths along those of the axes x, y, z that are to be seen

  /// Coordinates to the right, up and towards the eye.
  Eigen::Vector3d apply(const Eigen::Vector3d& p) const {
    return {right.dot(p), up.dot(p), towards.dot(p)};
  }
};

Projection projectionOf(View view);

/// Bounds of a drawing in the axes of its projection; empty (`min` > `max`) if it shows nothing.
struct ProjectedBounds {
  Eigen::Vector3d min;
  Eigen::Vector3d max;

  bool empty() const { return !(min.x() <= max.x()); }
};

ProjectedBounds boundsOf(const Drawing& drawing, const Projection& projection);

/// The largest of 1, 2 and 5 times a power of ten that is at most `length`; needs length > 0.
double roundLength(double length);

}  // namespace storey::view
