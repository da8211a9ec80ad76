// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes binary STL. Its floats are about a local origin; "storey X Y Z" in the header is what to
/// add to get the input's coordinates, followed by the name of the reference system where the 80
/// characters of the header have room for it.
/// \throws io::Failure (CannotCreate, IoError)
void writeStl(const std::string& path, const Exported& exported);

}  // namespace storey::exports
