// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/cloud_reader.h"
#include "stages/attitude.h"
#include "stages/model.h"

namespace storey::stages {

/// All points of a file of which `loaded` is a sample, in parts and in the frame of `cloud`; empty
/// where there are no more, or where the file does not give them part by part with normals that
/// nobody has turned since (PLY and PCD do). A point that is there several times comes once in each
/// part that it is in.
PartSource partsOf(const io::LoadedCloud& loaded, const StageCloud& cloud,
                   const AttitudeOptions& options, unsigned int threads);

}  // namespace storey::stages
