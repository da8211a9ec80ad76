// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/window_detection.h>

#include <optional>
#include <vector>

#include "synth/photos/photo_scene.h"

namespace storey::synth {

/// Windows found on facades against those that were painted. Doubtful ones are not found.
struct WindowMeasures {
  int painted = 0;
  int found = 0;
  int right = 0;                ///< found, and share half of their union with a painted one
  std::vector<double> corners;  ///< of each right one, how far its farthest edge is off, in texels

  double precision() const { return found > 0 ? static_cast<double>(right) / found : 1.0; }
  double recall() const { return painted > 0 ? static_cast<double>(right) / painted : 1.0; }
};

/// Adds the windows of one facade.
void compareWindows(const WindowGrid& grid, const std::vector<PaintedWindow>& painted,
                    WindowMeasures& measures);

/// A quadrilateral loosely about the window of a facade that a photo shows largest with nothing in
/// front of it; nothing if none does.
std::optional<WindowMark> markWindow(const PhotoScene& scene, const std::vector<Camera>& cameras,
                                     std::size_t facade);

}  // namespace storey::synth
