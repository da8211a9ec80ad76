// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: VTK's writer opens the final name itself, so that a full disk leaves half a
// file.
#include "export/stl.h"

#include <cstdint>

#include "export/local_mesh.h"
#include "export/number_text.h"
#include "io/output_file.h"

namespace storey::exports {

namespace {

constexpr std::size_t kHeaderSize = 80;

}  // namespace

void writeStl(const std::string& path, const Exported& exported) {
  const LocalMesh mesh = toLocalMesh(exported);
  io::OutputFile file(path);
  std::string header = "storey";  // short: three doubles may have 24 characters each
  for (const double coordinate : mesh.origin) header += " " + numberText(coordinate);
  if (header.size() + 1 + exported.crs.size() <= kHeaderSize) header += " " + exported.crs;
  header.resize(kHeaderSize, ' ');
  file.write(header);
  const auto count = static_cast<std::uint32_t>(mesh.countTriangles());
  file.write(&count, sizeof count);  // the host is little-endian
  for (const LocalMesh::Face& face : mesh.faces) {
    for (const std::array<int, 3>& triangle : face.triangles) {
      file.write(face.normal.data(), 3 * sizeof(float));
      for (const int index : triangle) {
        file.write(mesh.vertices[static_cast<std::size_t>(index)].data(), 3 * sizeof(float));
      }
      const std::uint16_t attribute = 0;
      file.write(&attribute, sizeof attribute);
    }
  }
  file.commit();
}

}  // namespace storey::exports
