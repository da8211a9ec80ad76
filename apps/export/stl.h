// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes binary STL. Its floats are about a local origin, which the header of 80 bytes tells:
/// "storey, add X Y Z".
/// \throws io::Failure (CannotCreate, IoError)
void writeStl(const std::string& path, const Exported& exported);

}  // namespace storey::exports
