// SPDX-License-Identifier: BSD-3-Clause
#include "io/raw_cloud.h"

#include "io/pcd_reader.h"
#include "io/ply_reader.h"

namespace storey::io {

RawCloud readRawCloud(InputFile& file, std::uint64_t max_memory,
                      const std::vector<std::string>& extras) {
  const std::string_view start = file.peek(16);
  if (start.substr(0, 4) == "ply\n" || start.substr(0, 5) == "ply\r\n") {
    return readPlyCloud(file, max_memory, extras);
  }
  for (const char* first : {"#", "VERSION", "FIELDS", "COLUMNS"}) {
    if (start.rfind(first, 0) == 0) return readPcd(file, max_memory, extras);
  }
  file.fail("is neither a PCD nor a PLY file", "convert the cloud to one of the two");
}

}  // namespace storey::io
