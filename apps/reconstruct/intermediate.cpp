// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/intermediate.h"

#include <pcl/common/io.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <array>

#include "io/pcd_writer.h"

namespace storey::reconstruct {
namespace {

using Labelled = pcl::PointCloud<pcl::PointXYZLNormal>;

// A cloud whose points carry a label, 0 where there is none.
Labelled withLabels(const Cloud& cloud, const std::vector<int>& labels) {
  Labelled labelled;
  pcl::copyPointCloud(cloud, labelled);
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    labelled[i].label = static_cast<std::uint32_t>(labels[i] + 1);
  }
  return labelled;
}

void writeConfidence(const io::OutputDirectory& directory, const Result& result) {
  pcl::PointCloud<pcl::PointXYZINormal> confident;
  pcl::copyPointCloud(*result.cloud, confident);
  for (std::size_t i = 0; i < confident.size(); ++i) {
    confident[i].intensity = result.confidences[i];
  }
  io::writeCloudPcd(directory.file("02_confidence.pcd"), confident);
}

// The clouds of all slices together. Flattened points go back to the heights that they came from,
// so that the stages can be looked at over each other.
void writeSliceStages(const io::OutputDirectory& directory, const Result& result) {
  std::vector<int> slice_of(result.cloud->size(), -1);
  Cloud smoothed;
  Cloud refined;
  std::vector<int> labels;
  std::vector<int> regions;
  int num_regions = 0;
  for (std::size_t s = 0; s < result.stages.size(); ++s) {
    const SliceStages<Point>& stages = result.stages[s];
    std::vector<int> region_of(stages.smoothed.size(), -1);
    for (const pcl::PointIndices& region : stages.regions) {
      for (const pcl::index_t i : region.indices) {
        region_of[static_cast<std::size_t>(i)] = num_regions;
      }
      ++num_regions;
    }
    for (std::size_t i = 0; i < stages.smoothed.size(); ++i) {
      const auto origin = static_cast<std::size_t>(stages.indices[i]);
      slice_of[origin] = static_cast<int>(s);
      smoothed.push_back(stages.smoothed[i]);
      smoothed.back().z = (*result.cloud)[origin].z;
      refined.push_back(stages.refined[i]);
      refined.back().z = smoothed.back().z;
      labels.push_back(stages.labels[i]);
      regions.push_back(region_of[i]);
    }
  }
  io::writeCloudPcd(directory.file("04_slices.pcd"), withLabels(*result.cloud, slice_of));
  io::writeCloudPcd(directory.file("05_normals.pcd"), smoothed);
  io::writeCloudPcd(directory.file("06_labels.pcd"), withLabels(smoothed, labels));
  io::writeCloudPcd(directory.file("07_refined.pcd"), refined);
  io::writeCloudPcd(directory.file("08_regions.pcd"), withLabels(refined, regions));
}

// Legacy VTK, the only format besides PCD that pcl_viewer reads.
class VtkFile {
 public:
  explicit VtkFile(const std::string& path) : file_(path) {
    file_.write("# vtk DataFile Version 3.0\nstorey\nASCII\nDATASET POLYDATA\n");
  }

  void points(const std::vector<Eigen::Vector3d>& points) {
    file_.write("POINTS " + std::to_string(points.size()) + " double\n");
    for (const Eigen::Vector3d& p : points) {
      for (int k = 0; k < 3; ++k) {
        file_.writeNumber(p[k]);
        file_.write(k < 2 ? " " : "\n");
      }
    }
  }

  template <typename Cells>
  void cells(const std::string& kind, const Cells& cells) {
    std::size_t numbers = 0;
    for (const auto& cell : cells) numbers += cell.size() + 1;
    file_.write(kind + " " + std::to_string(cells.size()) + " " + std::to_string(numbers) + "\n");
    for (const auto& cell : cells) {
      file_.write(std::to_string(cell.size()));
      for (const int i : cell) file_.write(" " + std::to_string(i));
      file_.write("\n");
    }
  }

  // A colour for each point, shares of red, green and blue.
  void colours(const std::string& name, const std::vector<Eigen::Vector3d>& colours) {
    file_.write("POINT_DATA " + std::to_string(colours.size()) + "\nCOLOR_SCALARS " + name +
                " 3\n");
    for (const Eigen::Vector3d& c : colours) {
      for (int k = 0; k < 3; ++k) {
        file_.writeNumber(c[k]);
        file_.write(k < 2 ? " " : "\n");
      }
    }
  }

  void commit() { file_.commit(); }

 private:
  io::OutputFile file_;
};

void writeFloorplanLines(const std::string& path, const std::vector<FloorplanLayer>& slices) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> lines;
  const auto append = [&](const FloorplanRing& ring, double z) {
    std::vector<int> line;
    for (const Eigen::Vector2d& v : ring.vertices) {
      line.push_back(static_cast<int>(points.size()));
      points.emplace_back(v.x(), v.y(), z);
    }
    line.push_back(line.front());
    lines.push_back(std::move(line));
  };
  for (const FloorplanLayer& slice : slices) {
    const double z = 0.5 * (slice.z_min + slice.z_max);
    for (const FloorplanComponent& component : slice.plan.components) {
      append(component.outer, z);
      for (const FloorplanRing& hole : component.holes) append(hole, z);
    }
  }
  VtkFile file(path);
  file.points(points);
  file.cells("LINES", lines);
  file.commit();
}

void writeModelTriangles(const std::string& path, const PolyhedralModel& model) {
  std::vector<std::array<int, 3>> triangles;
  for (const PolyhedralFace& face : model.faces) {
    for (const std::array<int, 3>& triangle : triangulateFace(model, face)) {
      triangles.push_back(triangle);
    }
  }
  VtkFile file(path);
  file.points(model.vertices);
  file.cells("POLYGONS", triangles);
  file.commit();
}

// Each face from red (no points on it) over yellow to green (points all over it).
void writeSupport(const std::string& path, const PolyhedralModel& model) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> colours;
  std::vector<std::array<int, 3>> triangles;
  for (const PolyhedralFace& face : model.faces) {
    const Eigen::Vector3d colour(std::min(1.0, 2.0 - 2.0 * face.coverage),
                                 std::min(1.0, 2.0 * face.coverage), 0.2);
    for (const std::array<int, 3>& triangle : triangulateFace(model, face)) {
      std::array<int, 3> corners{};  // its own: pcl_viewer colours points
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = static_cast<int>(points.size());
        points.push_back(model.vertices[static_cast<std::size_t>(triangle[k])]);
        colours.push_back(colour);
      }
      triangles.push_back(corners);
    }
  }
  VtkFile file(path);
  file.points(points);
  file.cells("POLYGONS", triangles);
  file.colours("coverage", colours);
  file.commit();
}

}  // namespace

void writeIntermediate(const io::OutputDirectory& directory, const Result& result) {
  io::writeCloudPcd(directory.file("01_upright.pcd"), *result.cloud);
  writeConfidence(directory, result);
  io::writeCloudPcd(directory.file("03_directions.pcd"),
                    withLabels(*result.cloud, result.point_directions));
  if (result.slices.empty()) {
    writeFloorplanLines(directory.file("09_floorplans.vtk"), result.blocks);
  } else {
    writeSliceStages(directory, result);
    writeFloorplanLines(directory.file("09_floorplans.vtk"), result.slices);
  }
  writeModelTriangles(directory.file("11_model.vtk"), result.model.model);
  writeSupport(directory.file("11_support.vtk"), result.model.model);
}

}  // namespace storey::reconstruct
