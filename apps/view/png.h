// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderWindow.h>

#include <string>

namespace storey::view {

/// Writes what a window shows as PNG, complete or not at all.
/// \param shrink pixels of the window, in each direction, that are averaged to one
/// \throws io::Failure (CannotCreate, IoError)
void writePng(const std::string& path, vtkRenderWindow& window, int shrink);

}  // namespace storey::view
