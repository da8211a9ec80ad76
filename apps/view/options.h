// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "view/drawing.h"
#include "view/stage_list.h"

namespace storey::view {

/// Width and height of a picture in pixels.
struct PictureSize {
  int width = 1600;
  int height = 1200;
};

/// Everything a user can set.
struct Options {
  std::string directory;
  bool pictures = false;  ///< all pictures, into the directory
  std::string picture;    ///< or this one; neither: a window
  Stage stage = Stage::Model;
  std::optional<View> view;  ///< none: the stage's own
  std::optional<int> slice;  ///< none: the one nearest the middle that has a floorplan
  PictureSize size;
};

/// Reads the command line. \return false if help or the version was asked for and printed
/// \throws io::Failure (Usage)
bool parseOptions(int argc, char** argv, Options& options);

}  // namespace storey::view
