// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "export/exported.h"

namespace storey::exports {

/// Writes binary glTF 2.0 (.glb): y is up, vertices are floats about a local origin, and the root
/// node's translation, in JSON and so in double, takes them to the input's coordinates
/// (x, z, -y). A node for each shell, in it a primitive for each material with flat normals; the
/// attribute `_FACE` is the index of the model's face that a corner belongs to. The reference
/// system of the input's coordinates is `asset.extras.crs`.
/// \throws io::Failure (CannotCreate, IoError)
void writeGltf(const std::string& path, const Exported& exported);

}  // namespace storey::exports
