// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes legacy VTK in text, which pcl_viewer and ParaView read: doubles in the input's
/// coordinates, triangles (viewers fill concave polygons wrongly) with the index of their face and
/// its label, wall, shell, hypothetical, support, coverage, residual and deviation (-1: not known)
/// as cell data. The reference system is the field `crs`.
/// \throws io::Failure (CannotCreate, IoError)
void writeVtk(const std::string& path, const Exported& exported);

}  // namespace storey::exports
