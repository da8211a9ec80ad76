// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/input_file.h"
#include "io/point_records.h"

namespace storey::io {

/// Reads the `vertex` element of a PLY file (ascii, binary of both byte orders) from its first
/// byte. All other elements are passed over, yet checked to be complete.
/// \param extras names of further properties to read, where the file has them
RawCloud readPlyCloud(InputFile& file, const ReadLimits& limits,
                      const std::vector<std::string>& extras);

}  // namespace storey::io
