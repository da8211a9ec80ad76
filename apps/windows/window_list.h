// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/cameras/camera_set.h"
#include "windows/windowed_model.h"

namespace storey::windows {

/// What became of a window.
const char* stateOf(const CutWindows& facade, std::size_t window);

/// Writes windows.json: for each facade its frame in the coordinates of the model's file, the
/// photos that show it, the depth, and its windows with their confidence and what became of them.
/// \throws io::Failure (CannotCreate, IoError)
void writeWindows(const std::string& path, const std::vector<CutWindows>& facades,
                  const io::CameraSet& cameras, const Eigen::Isometry3d& to_file);

/// To stdout: a table for each facade.
void printWindows(const std::vector<CutWindows>& facades);

}  // namespace storey::windows
