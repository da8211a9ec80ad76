// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/cloud_reader.h"
#include "stages/stage_cloud.h"

namespace storey::stages {

/// Writes a cloud for the next stage, and for `pcl_viewer`: binary PCD or PLY by its name, with the
/// fields x, y, z, normal_x, normal_y, normal_z, curvature; `intensity`, the planar confidence;
/// `class`, `slice`, `direction`, `region` and `wall`, numbered from 1, 0 = none; and `label`,
/// which repeats the newest of these under the name that PCL colours by. Fields without content are
/// left out. The state is in comments of the header, "storey KEY VALUES".
/// \throws io::Failure (CannotCreate, IoError)
void writeStageCloud(const std::string& path, const StageCloud& cloud);

/// Reads what `writeStageCloud` wrote, bit by bit as it was. Any other cloud is taken for upright
/// and with outward normals, and read as `io::readCloud` does.
/// \throws io::Failure (BadInput, MissingInput, IoError)
StageCloud readStageCloud(const std::string& path);

/// A cloud before its first stage, as it was loaded.
StageCloud fromLoaded(io::LoadedCloud& loaded, const std::string& name);

}  // namespace storey::stages
