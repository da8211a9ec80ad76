// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "io/limits.h"
#include "io/ply_header.h"
#include "io/ply_rows.h"
#include "io/polygon_builder.h"

namespace storey::io {
namespace {

// Memory of a vertex, and of a face with its 4 or so corners.
constexpr std::uint64_t kBytesPerVertex = sizeof(Eigen::Vector3d);
constexpr std::uint64_t kBytesPerFace = sizeof(PolygonSoup::Polygon) + 32;

std::size_t requireScalar(const InputFile& file, const PlyElement& element, const char* name) {
  const std::size_t index = element.find(name, false);
  if (index == PlyProperty::kNone) {
    file.fail("its element '" + element.name + "' has no property " + name);
  }
  return index;
}

/// A property of the row that is >= 0 or infinite; `missing` if there is none such.
double measureOr(const PlyRows& rows, std::size_t property, double missing) {
  if (property == PlyProperty::kNone) return missing;
  const double value = rows.scalar(property);
  return value >= 0.0 ? value : missing;
}

void readVertices(InputFile& file, const PlyElement& element, PlyFormat format,
                  PolygonBuilder& builder) {
  const std::size_t x = requireScalar(file, element, "x");
  const std::size_t y = requireScalar(file, element, "y");
  const std::size_t z = requireScalar(file, element, "z");
  const std::size_t deviation = element.find("deviation", false);
  PlyRows rows(file, element, format);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    rows.next();
    builder.addVertex(rows.scalar(x), rows.scalar(y), rows.scalar(z));
    if (deviation != PlyProperty::kNone) builder.addDeviation(measureOr(rows, deviation, 0.0));
  }
}

/// A property of the row as an integer within [low, high]; `missing` if there is none such.
int integerOr(const PlyRows& rows, std::size_t property, int low, int high, int missing) {
  if (property == PlyProperty::kNone) return missing;
  const double value = rows.scalar(property);
  if (!(value >= low && value <= high)) return missing;
  return static_cast<int>(value);
}

/// A corner as an integer; what is none (NaN, 1.5, out of the range of int) becomes -1.
std::int64_t cornerOf(double value) {
  const bool whole =
      value >= 0.0 && value <= std::numeric_limits<int>::max() && std::trunc(value) == value;
  return whole ? static_cast<std::int64_t>(value) : -1;
}

void readFaces(InputFile& file, const PlyElement& element, PlyFormat format,
               PolygonBuilder& builder) {
  std::size_t indices = element.find("vertex_indices", true);
  if (indices == PlyProperty::kNone) indices = element.find("vertex_index", true);
  if (indices == PlyProperty::kNone) file.fail("its faces have no list vertex_indices");
  const std::size_t label = element.find("label", false);
  const std::size_t wall = element.find("wall", false);
  const std::size_t shell = element.find("shell", false);
  const std::size_t hypothetical = element.find("hypothetical", false);
  const std::size_t support = element.find("support", false);
  const std::size_t coverage = element.find("coverage", false);
  const std::size_t residual = element.find("residual", false);
  const std::size_t deviation = element.find("deviation", false);
  constexpr int kMaxInt = std::numeric_limits<int>::max();

  PlyRows rows(file, element, format);
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    rows.next();
    corners.clear();
    for (const double value : rows.list(indices)) corners.push_back(cornerOf(value));
    PolygonSoup::Polygon polygon;
    polygon.label = static_cast<std::uint8_t>(integerOr(rows, label, 0, 255, 0));
    polygon.wall = integerOr(rows, wall, -1, kMaxInt, -1);
    polygon.shell = integerOr(rows, shell, 0, kMaxInt, 0);
    polygon.hypothetical = integerOr(rows, hypothetical, 0, kMaxInt, 0) != 0;
    polygon.support = integerOr(rows, support, 0, kMaxInt, 0);
    polygon.coverage = measureOr(rows, coverage, 0.0);
    polygon.residual = measureOr(rows, residual, 0.0);
    polygon.deviation = measureOr(rows, deviation, 0.0);
    builder.addPolygon(corners, std::move(polygon));
  }
}

}  // namespace

PolygonSoup readPlyPolygons(InputFile& file, std::uint64_t max_memory) {
  const PlyHeader header = readPlyHeader(file);
  PolygonBuilder builder(file, header.format == PlyFormat::Ascii);
  for (const std::string& note : header.notes) builder.addNote(note);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      file.checkMemory(element.count * kBytesPerVertex, max_memory, "its vertices");
      readVertices(file, element, header.format, builder);
    } else if (element.name == "face") {
      file.checkMemory(element.count * kBytesPerFace, max_memory, "its faces");
      readFaces(file, element, header.format, builder);
    } else {
      skipElement(file, element, header.format);
    }
  }
  expectPlyEnd(file, header.format);
  return builder.finish();
}

}  // namespace storey::io
