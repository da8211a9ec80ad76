// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// The floorplans as SVG, side by side, bottom up: a group `storey_k` for each, with its heights,
/// area and perimeter as data attributes; in it a path for each component and a line for each wall
/// with its length, dashed where it is guessed, and written beside those that are long enough; and
/// a scale bar. Paths and lines are in the cloud's unit, relative to the corner of all plans that
/// the description names with the reference system, in the frame of `io::planFrame`; transforms
/// take them to the drawing.
std::string drawFloorplans(const Exported& exported);

/// Writes them as a file. \throws io::Failure (CannotCreate, IoError)
void writeSvg(const std::string& path, const Exported& exported);

}  // namespace storey::exports
