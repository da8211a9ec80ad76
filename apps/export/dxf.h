// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes the floorplans as DXF (R12, text), which every CAD program reads: a layer `STOREY_k` for
/// each floorplan, bottom up, in it a closed polyline for each ring at the height of the foot of
/// its walls (elevation), as high as they are (thickness). Coordinates as `io::planFrame`;
/// their reference system is in the comments (999) at the start.
/// \throws io::Failure (CannotCreate, IoError)
void writeDxf(const std::string& path, const Exported& exported);

}  // namespace storey::exports
