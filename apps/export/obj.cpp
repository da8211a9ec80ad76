// SPDX-License-Identifier: BSD-3-Clause
#include "export/obj.h"

#include <filesystem>

#include "export/materials.h"
#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::exports {

void writeObj(const std::string& path, const Exported& exported) {
  const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
  io::OutputFile file(library.string());
  for (std::size_t m = 0; m < kNumMaterials; ++m) {
    file.write("newmtl " + materialName(m) + "\nKd");
    for (const double channel : materialColour(m)) {
      file.write(" ");
      file.writeNumber(channel);
    }
    file.write("\n");
  }
  file.commit();  // first: an OBJ never names a library that is not there
  io::writePolygonsObj(path, io::toPolygons(exported.model, exported.crs), exported.local_to_input,
                       library.filename().string());
}

}  // namespace storey::exports
