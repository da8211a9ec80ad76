// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_reader.h"

#include "io/ply_header.h"
#include "io/ply_rows.h"

namespace storey::io {
namespace {

std::vector<PointField> fieldsOf(const PlyElement& vertex) {
  std::vector<PointField> fields;
  std::size_t offset = 0;
  for (const PlyProperty& property : vertex.properties) {
    PointField field;
    field.name = property.name;
    field.type = property.type;
    field.is_list = property.is_list;
    field.index = fields.size();
    field.offset = offset;
    offset += sizeOf(property.type);
    fields.push_back(field);
  }
  return fields;
}

/// The way for vertices with lists, whose rows differ in length.
void readRowByRow(InputFile& file, const PlyElement& vertex, PlyFormat format,
                  const PointColumns& columns, RawCloud& raw) {
  std::vector<double> values(columns.field.size());
  PlyRows rows(file, vertex, format);
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    rows.next();
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = rows.scalar(columns.field[c]);
    raw.add(values);
  }
}

RawCloud readVertices(InputFile& file, const PlyElement& vertex, PlyFormat format,
                      const ReadLimits& limits, const std::vector<std::string>& extras) {
  const std::vector<PointField> fields = fieldsOf(vertex);
  const PointColumns columns = findPointColumns(fields, file, extras);
  checkPoints(file, vertex.count, limits, columns.extra_names.size());
  RawCloud raw;
  raw.format = std::string("ply ") + nameOf(format) + " " + nameOf(fields[columns.field[0]].type);
  raw.begin(vertex.count, columns, limits);
  if (vertex.hasLists()) {
    readRowByRow(file, vertex, format, columns, raw);
  } else if (format == PlyFormat::Ascii) {
    readAsciiRecords(file, fields, columns, raw);
  } else {
    readBinaryRecords(file, fields, columns, format == PlyFormat::BinaryBigEndian, raw);
  }
  return raw;
}

}  // namespace

RawCloud readPlyCloud(InputFile& file, const ReadLimits& limits,
                      const std::vector<std::string>& extras) {
  const PlyHeader header = readPlyHeader(file);
  RawCloud raw;
  bool found = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      raw = readVertices(file, element, header.format, limits, extras);
      found = true;
    } else {
      skipElement(file, element, header.format);
    }
  }
  if (!found) file.fail("has no element 'vertex'", "write the points as the element 'vertex'");
  expectPlyEnd(file, header.format);
  raw.notes = header.notes;
  return raw;
}

}  // namespace storey::io
