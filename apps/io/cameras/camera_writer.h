// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/cameras/camera_set.h"

namespace storey::io {

/// Writes a COLMAP text model (cameras.txt, images.txt, points3D.txt) of photos without distortion
/// and skew into a folder that is there. \throws Failure (CannotCreate, IoError)
void writeColmapText(const std::string& folder, const CameraSet& cameras);

/// Writes bundle.out and list.txt of photos without distortion whose principal point is in the
/// middle and whose two focal lengths are equal. \throws Failure (CannotCreate, IoError)
void writeBundler(const std::string& folder, const CameraSet& cameras);

}  // namespace storey::io
