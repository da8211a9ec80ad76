// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/point_records.h"

namespace storey::io {

/// Reads a cloud of any format we know, told apart by its content: points as they are in the file.
/// Points beyond `ReadLimits::max_points` are thinned while they are read, but for VTK and PMVS's
/// patches, which are all there. \param extras names of further fields to read, where the file has
/// them \throws Failure (BadInput)
RawCloud readRawCloud(InputFile& file, const ReadLimits& limits,
                      const std::vector<std::string>& extras = {});

}  // namespace storey::io
