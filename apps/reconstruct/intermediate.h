// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_file.h"
#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// Writes the cloud of each stage for `pcl_viewer`, in the upright local frame, numbered as the
/// stages of the method: 01_upright, 02_confidence (field intensity), 03_directions, 04_slices,
/// 05_normals, 06_labels, 07_refined, 08_regions (field label, 0 = none) as binary PCD, and the
/// floorplans of all slices as lines in 09_floorplans.vtk, the model as 11_model.vtk, and coloured
/// by what the points show of each face as 11_support.vtk. \throws io::Failure
void writeIntermediate(const io::OutputDirectory& directory, const Result& result);

}  // namespace storey::reconstruct
