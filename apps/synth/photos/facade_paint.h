// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace storey::synth {

/// A window's rectangle in the coordinates of its facade's frame.
struct PaintedWindow {
  Eigen::Vector2d min;
  Eigen::Vector2d max;
};

/// What a facade looks like seen at right angles, in grey levels 0 to 255 of red, green and blue:
/// plaster with stains and courses of brick, and windows with frames, mullions and dark panes, no
/// two quite the same. A continuous function, so that the truth is known at any resolution.
class FacadePaint {
 public:
  /// \param pitch from window to window, along the facade and upwards; also sets the size of stains
  FacadePaint(const FacadeFrame& frame, const FacadeOutline& outline, bool has_windows,
              double pitch, std::uint64_t seed);

  const std::vector<PaintedWindow>& windows() const { return windows_; }
  /// The window at a place, or nullptr.
  const PaintedWindow* windowAt(const Eigen::Vector2d& at) const;

  Eigen::Vector3d color(const Eigen::Vector2d& at) const;
  /// Of the reveals of recessed windows.
  Eigen::Vector3d wallColor(const Eigen::Vector2d& at) const;

 private:
  Eigen::Vector3d windowColor(const PaintedWindow& window, const Eigen::Vector2d& at) const;
  double noise(const Eigen::Vector2d& at, double wavelength) const;

  double pitch_;
  std::uint64_t seed_;
  int columns_ = 0;
  Eigen::Vector2d cell_ = Eigen::Vector2d::Ones();
  Eigen::Vector3d base_;
  std::vector<PaintedWindow> windows_;
  std::vector<int> window_in_;  // of each cell of the raster, -1 if none
};

}  // namespace storey::synth
