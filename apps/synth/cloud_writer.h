// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "synth/sampling.h"

namespace storey::synth {

/// Whether floats would cut the cloud's coordinates to steps above a millionth of its diagonal.
bool needsDouble(const SyntheticCloud& cloud);

/// Writes the cloud as binary little-endian PLY: x y z (float, or double on demand) and, unless
/// left out, nx ny nz (float). Where the points came from is not written.
/// \throws io::Failure (CannotCreate, IoError)
void writeCloudPly(const std::string& path, const SyntheticCloud& cloud, bool double_positions,
                   bool with_normals);

}  // namespace storey::synth
