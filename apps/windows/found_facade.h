// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/window_detection.h>

#include <Eigen/Geometry>

#include "windows/window_edit.h"

namespace storey::windows {

/// The windows found on a facade, and what is changed about them.
struct FoundFacade {
  FacadeEdit edit;
  WindowGrid found;  ///< without the changes

  double depth() const { return edit.depth.value_or(found.depth); }
  const WindowChange* change(const FacadeWindow& window) const;
  Eigen::AlignedBox2d rectangle(const FacadeWindow& window) const;
  bool isKept(const FacadeWindow& window) const;     ///< will be cut
  bool isDropped(const FacadeWindow& window) const;  ///< by the user

  /// With the changes made: windows moved, left out, or no longer doubtful.
  WindowGrid changed() const;
};

}  // namespace storey::windows
