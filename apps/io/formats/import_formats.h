// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/input_file.h"
#include "io/point_records.h"

namespace storey::io {

// Readers of further formats, each from the first byte of the file. No number in it is trusted.

/// LAS 1.0 to 1.4, uncompressed: the coordinates, integers that are scaled and shifted in double.
RawCloud readLas(InputFile& file, const ReadLimits& limits);

/// Lines of numbers, "x y z ...", separated by blanks, commas or semicolons; the same number of
/// them in all lines. Columns 4 to 6, or else the last three, are the normal if they have length 1.
/// Comments (# or //) and one line of names may come first, or the number of points (.pts).
RawCloud readXyz(InputFile& file, const ReadLimits& limits);

/// PMVS's patches (.patch), with the photos that see them.
RawCloud readPatches(InputFile& file, const ReadLimits& limits);

/// The points of legacy VTK polygonal data, ASCII or binary, with their normals if these are the
/// first of the point data.
RawCloud readVtkPoints(InputFile& file, const ReadLimits& limits);

}  // namespace storey::io
