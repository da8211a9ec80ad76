// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderer.h>

#include <string>

#include "view/display.h"
#include "view/drawing.h"
#include "view/options.h"

namespace storey::view {

/// Makes a renderer white and translucent facets right whatever lies behind them.
void prepareScene(vtkRenderer& renderer);

/// \throws io::Failure (Temporary) with the hint if VTK cannot draw on the display
void requireOpenGl(const DisplayConnection& display, const std::string& hint);

/// Renders drawings off-screen and writes them as PNG.
class PictureWriter {
 public:
  /// \throws io::Failure (Temporary) if there is no display to render with
  explicit PictureWriter(const PictureSize& size);

  /// Writes a picture, complete or not at all. \throws io::Failure (CannotCreate, IoError)
  void write(const std::string& path, const Drawing& drawing) const;

 private:
  DisplayConnection display_;
  PictureSize size_;
};

}  // namespace storey::view
