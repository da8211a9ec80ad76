// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace storey::io {

/// A cloud in memory, whatever its point type.
struct CloudView {
  std::vector<pcl::PCLPointField> fields;                ///< their offsets are those in a row
  std::function<const unsigned char*(std::size_t)> row;  ///< the bytes of point i
  std::size_t width = 0;
  std::size_t height = 1;
  std::vector<std::string> notes;  ///< "storey ..." comments of the header, a line each
};

/// Writes a cloud as binary PCD or, if the name ends in .ply, as binary PLY (normals are nx, ny, nz
/// there, and the cloud is not organised), for `pcl_viewer` and `pcl::io`. Not `pcl::PCDWriter`:
/// that one maps the file into memory, where a full disk ends in a signal or goes unnoticed; here
/// every write is checked and the file appears complete or not at all.
/// \throws Failure (CannotCreate, IoError)
void writeCloud(const std::string& path, const CloudView& cloud);

/// The same with all registered fields of the point type.
template <typename PointT>
void writeCloud(const std::string& path, const pcl::PointCloud<PointT>& cloud) {
  CloudView view;
  view.fields = pcl::getFields<PointT>();
  view.row = [&cloud](std::size_t i) {
    return reinterpret_cast<const unsigned char*>(&cloud.points[i]);
  };
  const bool organised = std::size_t{cloud.width} * cloud.height == cloud.size();
  view.width = organised ? cloud.width : cloud.size();
  view.height = organised ? cloud.height : 1;
  writeCloud(path, view);
}

/// Whether a path ends in this extension (".ply"), in capitals or not.
bool hasExtension(const std::string& path, const std::string& extension);

}  // namespace storey::io
