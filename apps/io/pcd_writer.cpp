// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_writer.h"

#include "io/output_file.h"

namespace storey::io::detail {
namespace {

std::size_t bytesOf(const pcl::PCLPointField& field) {
  return static_cast<std::size_t>(pcl::getFieldSize(field.datatype)) * field.count;
}

void writeHeader(OutputFile& file, const CloudView& cloud) {
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
  file.write("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n");
  file.write(names + "\n" + sizes + "\n" + types + "\n" + counts + "\n");
  file.write("WIDTH " + std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) +
             "\nVIEWPOINT");
  const Eigen::Quaternionf& q = cloud.orientation;
  for (const float value :
       {cloud.origin.x(), cloud.origin.y(), cloud.origin.z(), q.w(), q.x(), q.y(), q.z()}) {
    file.write(" ");
    file.writeNumber(static_cast<double>(value));
  }
  file.write("\nPOINTS " + std::to_string(cloud.width * cloud.height) + "\nDATA binary\n");
}

}  // namespace

void writePcd(const std::string& path, const CloudView& cloud) {
  OutputFile file(path);
  writeHeader(file, cloud);
  for (std::size_t i = 0; i < cloud.width * cloud.height; ++i) {
    const unsigned char* const point = cloud.points + i * cloud.point_bytes;
    for (const pcl::PCLPointField& field : cloud.fields) {
      file.write(point + field.offset, bytesOf(field));
    }
  }
  file.commit();
}

}  // namespace storey::io::detail
