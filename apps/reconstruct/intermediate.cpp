// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/intermediate.h"

#include <pcl/common/io.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <array>

#include "io/cloud_writer.h"
#include "io/model_io.h"
#include "stages/cell_file.h"
#include "stages/floorplan_file.h"
#include "stages/wall_file.h"
#include "synth/polygon_mesh.h"
#include "synth/triangle_tree.h"

namespace storey::reconstruct {
namespace {

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

// The points by how far the model is from them: green within three noise deviations, yellow within
// six, red beyond.
void writeExplainedPoints(const std::string& path, const Result& result) {
  constexpr double kNear = 3.0;  // noise deviations
  constexpr double kFar = 6.0;
  pcl::PointCloud<pcl::PointXYZRGBNormal> coloured;
  pcl::copyPointCloud(*result.cloud.points, coloured);
  std::vector<Eigen::Vector3d> positions;
  for (const Point& p : *result.cloud.points) {
    positions.push_back(result.model.upright * p.getVector3fMap().cast<double>());
  }
  const double noise = result.cloud.state.noise;
  const synth::TriangleTree surface(
      synth::measurable(io::toPolygons(result.model.model)).triangles);
  const std::vector<double> distances = surface.distances(positions, kFar * noise);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    coloured[i].r = distances[i] < kNear * noise ? 40 : 230;
    coloured[i].g = distances[i] < kFar * noise ? 200 : 40;
    coloured[i].b = 40;
  }
  io::writeCloud(path, coloured);
}

void writeFloorplanFiles(const io::OutputDirectory& directory, const Options& options,
                         const Result& result) {
  stages::StageFloorplans floorplans;
  floorplans.method = options.method;
  floorplans.layers = options.method == Method::Paper ? result.slices.layers : result.blocks;
  floorplans.state = result.cloud.state;
  writeFloorplans(directory.file("09_floorplans.geojson"), floorplans);
  writeFloorplanLines(directory.file("09_floorplans.vtk"), floorplans.layers);
  if (options.method == Method::Paper) return;  // it knows neither walls of all slices nor cells
  writeWalls(directory.file("09_walls.geojson"), result.building.walls, result.cloud.state);
  writeCells(directory.file("09_cells.geojson"), result.building, result.cloud.state);
}

}  // namespace

void writeIntermediate(const io::OutputDirectory& directory, const Options& options,
                       const Result& result) {
  writeFloorplanFiles(directory, options, result);
  writeModelTriangles(directory.file("11_model.vtk"), result.model.model);
  writeSupport(directory.file("11_support.vtk"), result.model.model);
  writeExplainedPoints(directory.file("11_points.pcd"), result);
}

}  // namespace storey::reconstruct
