// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/input_file.h"
#include "io/point_records.h"

namespace storey::io {

/// Reads a PCD file (ascii, binary, binary_compressed; version 0.5 to 0.7) from its first byte.
/// Every size is checked against the size of the file before memory is taken. The keywords must
/// come at most once and in the order of the format; VIEWPOINT must be finite and is not applied.
/// \param extras names of further fields to read, where the file has them
RawCloud readPcd(InputFile& file, const ReadLimits& limits, const std::vector<std::string>& extras);

}  // namespace storey::io
