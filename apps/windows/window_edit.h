// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/window_detection.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace storey::windows {

/// What a user wants of one window of a grid.
struct WindowChange {
  int row = 0;
  int column = 0;
  std::optional<bool> keep;  ///< cut it or leave it out; nothing: as its confidence says
  std::optional<Eigen::AlignedBox2d> rectangle;  ///< where it is instead, in its facade's frame

  bool isOf(const FacadeWindow& window) const {
    return row == window.row && column == window.column;
  }
};

/// How the windows of one facade are found, and what is changed about them.
struct FacadeEdit {
  std::string view;                       ///< the photo that is drawn on; empty: no mark
  std::array<Eigen::Vector2d, 4> quad{};  ///< around a window on it, pixels
  std::size_t facade = 0;                 ///< without a mark: the model's face
  std::optional<double> depth;            ///< of the panes; nothing: what the photos show
  std::vector<WindowChange> changes;      ///< at most one a window

  bool isMarked() const { return !view.empty(); }
};

/// All that a user did, to be done again by `storey_windows --edit-file`.
struct WindowEdit {
  std::vector<FacadeEdit> facades;
};

/// As JSON. What is written reads back as the same numbers.
void writeEdit(const std::string& path, const WindowEdit& edit);

/// \throws io::Failure (BadInput, MissingInput, IoError), one line that names what is wrong
WindowEdit readEdit(const std::string& path);

}  // namespace storey::windows
