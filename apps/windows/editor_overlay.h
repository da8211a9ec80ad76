// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "windows/window_editor.h"

namespace storey::windows {

/// Where a photo is put in a window: a rectangle of the window, in its pixels from the lower left
/// corner, and what of the photo fills it.
struct PhotoView {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< corners of the rectangle
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  Eigen::Vector2d corner =
      Eigen::Vector2d::Zero();  ///< pixel of the photo in its upper left corner
  double scale = 1.0;           ///< pixels of the window for one of the photo

  Eigen::Vector2d toPhoto(const Eigen::Vector2d& at) const {
    return corner + Eigen::Vector2d(at.x() - low.x(), high.y() - at.y()) / scale;
  }
  Eigen::Vector2d toWindow(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d from = scale * (pixel - corner);
    return {low.x() + from.x(), high.y() - from.y()};
  }
  bool contains(const Eigen::Vector2d& at) const {
    return (at - low).minCoeff() >= 0.0 && (high - at).minCoeff() > 0.0;
  }
  /// Makes it larger or smaller; what is at a place stays there.
  void zoom(double factor, const Eigen::Vector2d& at);

  /// All of a photo in the middle of a rectangle.
  static PhotoView whole(const Camera& camera, const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high);
};

/// What lines of the overlay are of.
enum class Mark { Kept, Doubtful, Dropped, Pane, Corner };

using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Lines of one kind, in pixels of the window, cut at the edge of the photo's rectangle.
struct OverlayLines {
  Mark mark;
  bool current;  ///< of the facade that keys are about
  std::vector<Segment> segments;
};

/// The windows and corners that a photo shows.
std::vector<OverlayLines> overlayOf(const WindowEditor& editor, std::size_t photo,
                                    const PhotoView& view);

}  // namespace storey::windows
