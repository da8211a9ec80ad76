// SPDX-License-Identifier: BSD-3-Clause
// Written by hand for the reason given in stl.cpp.
#include "export/vtk.h"

#include <cmath>

#include "export/local_mesh.h"
#include "io/label_names.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

template <typename Value>
void writeCellData(io::OutputFile& file, const LocalMesh& mesh, const char* name, const char* type,
                   Value value) {
  file.write(std::string("SCALARS ") + name + " " + type + " 1\nLOOKUP_TABLE default\n");
  for (const LocalMesh::Face& face : mesh.faces) {
    for (std::size_t i = 0; i < face.triangles.size(); ++i) {
      file.writeNumber(value(face.face));
      file.write("\n");
    }
  }
}

void writeFaceData(io::OutputFile& file, const LocalMesh& mesh, const PolyhedralModel& model) {
  const auto integers = [&](const char* name, auto value) {
    writeCellData(file, mesh, name, "int",
                  [&](std::size_t f) { return static_cast<long long>(value(model.faces[f])); });
  };
  const auto numbers = [&](const char* name, auto value) {
    writeCellData(file, mesh, name, "double", [&](std::size_t f) {
      const double number = value(model.faces[f]);
      return std::isfinite(number) ? number : -1.0;
    });
  };
  using Face = PolyhedralFace;
  writeCellData(file, mesh, "face", "int", [](std::size_t f) { return static_cast<long long>(f); });
  integers("label", [](const Face& f) { return int{io::fileLabel(f)}; });
  integers("wall", [](const Face& f) { return f.wall; });
  integers("shell", [](const Face& f) { return f.shell; });
  integers("hypothetical", [](const Face& f) { return f.hypothetical; });
  integers("support", [](const Face& f) { return f.support; });
  numbers("coverage", [](const Face& f) { return f.coverage; });
  numbers("residual", [](const Face& f) { return f.residual; });
  numbers("deviation", [](const Face& f) { return f.deviation; });
}

// A string of VTK's files: what is no visible character of ASCII, and % and ", by its number.
std::string encoded(const std::string& text) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 0x20 && byte < 0x7f && c != '%' && c != '"') {
      result += c;
    } else {
      result += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return result;
}

}  // namespace

void writeVtk(const std::string& path, const Exported& exported) {
  const LocalMesh mesh = toLocalMesh(exported);
  io::OutputFile file(path);
  file.write("# vtk DataFile Version 3.0\nstorey\nASCII\nDATASET POLYDATA\n");
  if (!exported.crs.empty()) {
    file.write("FIELD FieldData 1\ncrs 1 1 string\n" + encoded(exported.crs) + "\n");
  }
  file.write("POINTS " + std::to_string(exported.model.vertices.size()) + " double\n");
  for (const Eigen::Vector3d& vertex : exported.model.vertices) {
    const Eigen::Vector3d p = exported.local_to_input * vertex;
    for (int axis = 0; axis < 3; ++axis) {
      file.writeNumber(p[axis]);
      file.write(axis < 2 ? " " : "\n");
    }
  }
  const std::size_t count = mesh.countTriangles();
  file.write("POLYGONS " + std::to_string(count) + " " + std::to_string(4 * count) + "\n");
  for (const LocalMesh::Face& face : mesh.faces) {
    for (const auto& [a, b, c] : face.triangles) {
      file.write("3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) +
                 "\n");
    }
  }
  file.write("CELL_DATA " + std::to_string(count) + "\n");
  writeFaceData(file, mesh, exported.model);
  file.commit();
}

}  // namespace storey::exports
