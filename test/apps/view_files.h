// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "io/cloud_writer.h"
#include "io/model_io.h"
#include "temporary_files.h"

namespace storey::test {

/// Corners of the box [0, 4] x [0, 3] x [0, 6], corner i at the bits of i.
inline io::PolygonSoup boxSoup() {
  io::PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back(i & 1 ? 4.0 : 0.0, i & 2 ? 3.0 : 0.0, i & 4 ? 6.0 : 0.0);
  }
  const auto add = [&](std::vector<int> corners, std::uint8_t label, bool hypothetical) {
    soup.polygons.push_back({std::move(corners), label, label == 0 ? 0 : -1, 0, hypothetical});
  };
  add({0, 1, 5, 4}, 0, false);
  add({1, 3, 7, 5}, 0, false);
  add({3, 2, 6, 7}, 0, false);
  add({2, 0, 4, 6}, 0, true);
  add({4, 5, 7, 6}, 1, false);
  add({0, 2, 3, 1}, 2, false);
  return soup;
}

/// The files of storey_reconstruct for the box, in an input frame that is turned about x.
class BoxReconstruction {
 public:
  BoxReconstruction() {
    local_to_input_.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
    local_to_input_.translation() = Eigen::Vector3d(500000.0, -7000.0, 30.0);
    io::writePolygonsPly(file("model.ply"), boxSoup(), local_to_input_);
    directory_.write("floorplans.geojson", floorplans());
    directory_.write("report.json", R"({"input": {"file": "some/where/box.ply",
      "offset": [500000, -7000, 30]}, "space": {"side": "outside"}, "planar": {"T_k": 0.25},
      "directions": [{"azimuth_deg": -90}, {"azimuth_deg": 0}],
      "slices": {"thickness": 2, "count": 3}, "model": {"grid": 0.0001}})");
  }

  const std::string& path() const { return directory_.path(); }
  std::string file(const std::string& name) const { return directory_.file(name); }
  const TemporaryDirectory& directory() const { return directory_; }
  const Eigen::Isometry3d& localToInput() const { return local_to_input_; }

  /// 30 points of the southern wall, ten in each of three slices of thickness 2, and one of none;
  /// the refined ones lie on y = 0, those before on y = -0.25. Slice 1 has a floorplan.
  void writeStages() const {
    pcl::PointCloud<pcl::PointXYZLNormal> sliced;
    pcl::PointCloud<pcl::PointNormal> before;
    pcl::PointCloud<pcl::PointNormal> after;
    for (int slice = 2; slice >= 0; --slice) {  // the whole cloud is in any order
      for (int i = 0; i < 10; ++i) sliced.push_back(labelled(i, slice));
    }
    sliced.push_back(labelled(5, -1));
    for (int slice = 0; slice < 3; ++slice) {  // those of the slices come slice by slice
      for (int i = 0; i < 10; ++i) {
        const auto p = labelled(i, slice);
        before.push_back({p.x, -0.25f, p.z, 0.0f, -1.0f, 0.0f});
        after.push_back({p.x, 0.0f, p.z, 0.0f, -1.0f, 0.0f});
      }
    }
    io::writeCloud(file("01_upright.pcd"), before);
    io::writeCloud(file("04_slices.pcd"), sliced);
    io::writeCloud(file("05_normals.pcd"), before);
    io::writeCloud(file("08_refined.pcd"), after);
    directory_.write("09_floorplans.vtk",
                     "# vtk DataFile Version 3.0\nstorey\nASCII\nDATASET POLYDATA\n"
                     "POINTS 4 double\n0 0 3\n4 0 3\n4 3 3\n0 3 3\nLINES 1 6\n5 0 1 2 3 0\n");
    for (std::size_t i = 0; i < sliced.size(); ++i) {  // halves of the wall are two regions
      const std::size_t slice = i / 10;
      sliced[i].label = static_cast<std::uint32_t>(2 * slice + (i % 10 < 5 ? 1 : 2));
    }
    sliced.resize(30);
    io::writeCloud(file("07_regions.pcd"), sliced);
  }

  /// The southern wall, seen in two runs; two blocks of two cells, the eastern one inside in both,
  /// the western one in the lower block.
  void writePlans() const {
    directory_.write("09_walls.geojson", R"({"features": [{"properties": {"normal": [0, -1],
      "z_min": 1, "z_max": 6}, "geometry": {"coordinates": [[[0, 0], [1.5, 0]],
      [[2, 0], [4, 0]]]}}]})");
    directory_.write("09_cells.geojson", R"({"blocks": [[0, 4], [4, 6]], "features": [
      {"properties": {"inside": [0]}, "geometry": {"coordinates":
        [[[0, 0], [2, 0], [2, 3], [0, 3], [0, 0]]]}},
      {"properties": {"inside": [0, 1]}, "geometry": {"coordinates":
        [[[2, 0], [4, 0], [4, 3], [2, 3], [2, 0]]]}}]})");
  }

 private:
  static pcl::PointXYZLNormal labelled(int i, int slice) {
    pcl::PointXYZLNormal p;
    p.x = 0.4f * static_cast<float>(i);
    p.y = -0.25f;
    p.z = 2.0f * static_cast<float>(slice) + 0.15f * static_cast<float>(i + 1);
    p.label = static_cast<std::uint32_t>(slice + 1);
    p.normal_y = -1.0f;
    return p;
  }

  std::string floorplans() const {
    std::string rows;
    for (int row = 0; row < 4; ++row) {
      rows += row == 0 ? "[" : ",[";
      for (int column = 0; column < 4; ++column) {
        char number[32];
        std::snprintf(number, sizeof number, "%s%.17g", column == 0 ? "" : ",",
                      local_to_input_.matrix()(row, column));
        rows += number;
      }
      rows += "]";
    }
    return R"({"type": "FeatureCollection", "frame_to_input": [)" + rows + "]}";
  }

  TemporaryDirectory directory_;
  Eigen::Isometry3d local_to_input_ = Eigen::Isometry3d::Identity();
};

}  // namespace storey::test
