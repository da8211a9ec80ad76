// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "synth/photos/photo_scene.h"
#include "synth/sampling.h"

namespace storey::synth {

/// Takes photos of a building and writes, all in the coordinates of the pose:
///   images/view_00.png ...;  sparse/ (COLMAP text);  bundler/ (bundle.out, list.txt);
///   truth.json: for each facade its frame (origin, right, up, width, height), the size of a texel
///   and the windows, [x0, y0, x1, y1] in the frame, with the depth of their recess;
///   truth/facade_000.png ...: the facades seen at right angles.
/// \throws Failure (CannotCreate, IoError)
void writePhotos(const std::string& folder, const PolyhedralModel& model,
                 const PhotoOptions& options, const Pose& pose);

}  // namespace storey::synth
