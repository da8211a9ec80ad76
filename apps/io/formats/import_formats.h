// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/input_file.h"
#include "io/point_records.h"

namespace storey::io {

// Readers of further formats, each from the first byte of the file. No number in it is trusted.

/// LAS 1.0 to 1.4, uncompressed: the coordinates, integers that are scaled and shifted in double.
RawCloud readLas(InputFile& file, std::uint64_t max_memory);

/// Lines of numbers, "x y z ...", separated by blanks, commas or semicolons; the same number of
/// them in all lines. Columns 4 to 6, or else the last three, are the normal if they have length 1.
/// Comments (# or //) and one line of names may come first, or the number of points (.pts).
RawCloud readXyz(InputFile& file, std::uint64_t max_memory);

/// PMVS's patches (.patch), with the photos that see them.
RawCloud readPatches(InputFile& file, std::uint64_t max_memory);

/// The points of legacy VTK polygonal data, ASCII or binary, with their normals if these are the
/// first of the point data.
RawCloud readVtkPoints(InputFile& file, std::uint64_t max_memory);

/// Fails if so many points cannot be, or not with this memory.
void checkPointCount(const InputFile& file, std::uint64_t num_points, std::uint64_t max_memory);

}  // namespace storey::io
