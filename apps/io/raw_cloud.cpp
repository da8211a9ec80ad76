// SPDX-License-Identifier: BSD-3-Clause
#include "io/raw_cloud.h"

#include <algorithm>

#include "io/cloud_writer.h"
#include "io/formats/import_formats.h"
#include "io/pcd_reader.h"
#include "io/ply_reader.h"
#include "io/scan.h"

namespace storey::io {

namespace {

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// Whether the file begins with a line of numbers, or is called as such files are.
bool isXyz(InputFile& file, std::string_view start) {
  for (const char* extension : {".xyz", ".txt", ".pts", ".asc", ".csv"}) {
    if (hasExtension(file.path(), extension)) return true;
  }
  const std::size_t end = std::min(start.find_first_of(" \t,;\r\n"), start.size());
  double number = 0.0;
  return parseNumber(start.substr(0, end), number);
}

}  // namespace

RawCloud readRawCloud(InputFile& file, const ReadLimits& limits,
                      const std::vector<std::string>& extras) {
  const std::string start(file.peek(64));
  if (startsWith(start, "ply\n") || startsWith(start, "ply\r\n")) {
    return readPlyCloud(file, limits, extras);
  }
  if (startsWith(start, "LASF")) return readLas(file, limits);
  if (startsWith(start, "# vtk DataFile")) return readVtkPoints(file, limits);
  if (startsWith(start, "PATCHES")) return readPatches(file, limits);
  const bool is_xyz = isXyz(file, start);
  for (const char* first : {"# .PCD", "VERSION", "FIELDS", "COLUMNS", "#"}) {
    const bool any_comment = std::string_view(first) == "#";
    if (startsWith(start, first) && !(any_comment && is_xyz)) {
      return readPcd(file, limits, extras);
    }
  }
  if (is_xyz) return readXyz(file, limits);
  file.fail("is neither PCD nor PLY, nor of another format that is read",
            "convert it to PLY or PCD (LAS, VTK, PMVS patches and lines 'x y z' are read too)");
}

}  // namespace storey::io
