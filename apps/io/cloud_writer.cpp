// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_writer.h"

#include <cctype>

#include "io/output_file.h"

namespace storey::io {
namespace {

std::size_t bytesOf(const pcl::PCLPointField& field) {
  return static_cast<std::size_t>(pcl::getFieldSize(field.datatype)) * field.count;
}

void writePcdHeader(OutputFile& file, const CloudView& cloud) {
  std::string names = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const pcl::PCLPointField& field : cloud.fields) {
    names += " " + field.name;
    sizes += " " + std::to_string(pcl::getFieldSize(field.datatype));
    types += std::string(" ") + pcl::getFieldType(field.datatype);
    counts += " " + std::to_string(field.count);
  }
  file.write("# .PCD v0.7 - Point Cloud Data file format\n");
  for (const std::string& note : cloud.notes) file.write("# storey " + note + "\n");
  file.write("VERSION 0.7\n" + names + "\n" + sizes + "\n" + types + "\n" + counts + "\n");
  file.write("WIDTH " + std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) +
             "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(cloud.width * cloud.height) +
             "\nDATA binary\n");
}

const char* plyType(const pcl::PCLPointField& field) {
  using Field = pcl::PCLPointField;
  switch (field.datatype) {
    case Field::INT8:
      return "char";
    case Field::UINT8:
      return "uchar";
    case Field::INT16:
      return "short";
    case Field::UINT16:
      return "ushort";
    case Field::INT32:
      return "int";
    case Field::UINT32:
      return "uint";
    case Field::FLOAT64:
      return "double";
    default:
      return "float";
  }
}

void writePlyHeader(OutputFile& file, const CloudView& cloud) {
  file.write("ply\nformat binary_little_endian 1.0\n");
  for (const std::string& note : cloud.notes) file.write("comment storey " + note + "\n");
  file.write("element vertex " + std::to_string(cloud.width * cloud.height) + "\n");
  constexpr std::string_view kNormal = "normal_";
  for (const pcl::PCLPointField& field : cloud.fields) {
    const bool normal = field.name.rfind(kNormal, 0) == 0;
    const std::string name = normal ? "n" + field.name.substr(kNormal.size()) : field.name;
    file.write(std::string("property ") + plyType(field) + " " + name + "\n");
  }
  file.write("end_header\n");
}

}  // namespace

void writeCloud(const std::string& path, const CloudView& cloud) {
  OutputFile file(path);
  if (hasExtension(path, ".ply")) {
    writePlyHeader(file, cloud);
  } else {
    writePcdHeader(file, cloud);
  }
  for (std::size_t i = 0; i < cloud.width * cloud.height; ++i) {
    const unsigned char* const row = cloud.row(i);
    for (const pcl::PCLPointField& field : cloud.fields) {
      file.write(row + field.offset, bytesOf(field));
    }
  }
  file.commit();
}

bool hasExtension(const std::string& path, const std::string& extension) {
  if (path.size() < extension.size()) return false;
  const std::size_t start = path.size() - extension.size();
  for (std::size_t i = 0; i < extension.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(path[start + i])) != extension[i]) return false;
  }
  return true;
}

}  // namespace storey::io
