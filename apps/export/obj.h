// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes OBJ as `io::writePolygonsObj` with a material for each label, and beside it the library
/// of the materials: the same name with the ending `.mtl`.
/// \throws io::Failure (CannotCreate, IoError)
void writeObj(const std::string& path, const Exported& exported);

}  // namespace storey::exports
