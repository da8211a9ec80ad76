// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "io/point_records.h"

namespace storey::io {

/// Whether a file beside the cloud tells which photos saw each of its points.
bool hasVisibility(const std::string& path);

/// Turns the normals of a cloud to the photos that saw its points, where these and their cameras
/// are there: the photos of PMVS's patches with the cameras in `../txt`, those of COLMAP's
/// `fused.ply` in `fused.ply.vis` with the model in the same folder or in `sparse`. A normal is
/// turned if more of the point's photos lie behind it than before it.
/// \param path of the cloud
/// \return how many normals were turned; 0 where nothing is known of photos
/// \throws Failure (BadInput) for files that are there but do not fit the cloud
std::size_t turnToViewers(const std::string& path, std::uint64_t max_memory, RawCloud& raw);

}  // namespace storey::io
