// SPDX-License-Identifier: BSD-3-Clause
#include "export/solids.h"

#include <storey/surface/extrusion.h>
#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>

namespace storey::exports {
namespace {

const Eigen::Vector3d& vertexOf(const PolyhedralModel& model, int index) {
  return model.vertices[static_cast<std::size_t>(index)];
}

FloorplanRing ringOf(const PolyhedralModel& model, const std::vector<int>& indices) {
  FloorplanRing ring;
  for (const int i : indices) ring.vertices.push_back(vertexOf(model, i).head<2>());
  ring.edges.resize(ring.vertices.size());
  return ring;
}

// The outline of a level face, as if seen from above a roof.
FloorplanComponent outlineOf(const PolyhedralModel& model, const PolyhedralFace& face) {
  FloorplanComponent component;
  component.outer = ringOf(model, face.outer);
  for (const std::vector<int>& hole : face.inner) component.holes.push_back(ringOf(model, hole));
  return component;
}

// Volume under the roofs of a shell less volume under its other level faces: negative for the wall
// of a cavity, whose floor is a face up.
bool isCavity(const PolyhedralModel& model, int shell) {
  double volume = 0.0;
  for (const PolyhedralFace& face : model.faces) {
    if (face.shell != shell || face.label == FaceLabel::Wall) continue;
    // Outlines of faces down run clockwise in plan: their area is negative already.
    volume += area({{outlineOf(model, face)}}) * vertexOf(model, face.outer[0]).z();
  }
  return volume < 0.0;
}

// A point in the interior of one of the level faces of a shell.
Eigen::Vector3d innerPoint(const PolyhedralModel& model, int shell) {
  for (const PolyhedralFace& face : model.faces) {
    if (face.shell != shell || face.label == FaceLabel::Wall) continue;
    const auto triangles = triangulateFace(model, face);
    if (triangles.empty()) continue;
    const auto& [a, b, c] = triangles.front();
    return (vertexOf(model, a) + vertexOf(model, b) + vertexOf(model, c)) / 3.0;
  }
  return Eigen::Vector3d::Zero();
}

// A ray up from inside a shell leaves it once more than it enters.
bool encloses(const PolyhedralModel& model, int shell, const Eigen::Vector3d& point) {
  bool odd = false;
  for (const PolyhedralFace& face : model.faces) {
    if (face.shell != shell || face.label == FaceLabel::Wall) continue;
    if (vertexOf(model, face.outer[0]).z() <= point.z()) continue;
    if (contains({{outlineOf(model, face)}}, point.head<2>())) odd = !odd;
  }
  return odd;
}

}  // namespace

std::vector<Solid> solidsOf(const PolyhedralModel& model) {
  std::vector<Solid> solids;
  std::vector<int> cavities;
  for (int shell = 0; shell < model.num_shells; ++shell) {
    if (isCavity(model, shell)) {
      cavities.push_back(shell);
    } else {
      solids.push_back({shell, {}});
    }
  }
  for (const int cavity : cavities) {
    const Eigen::Vector3d point = innerPoint(model, cavity);
    for (Solid& solid : solids) {
      if (encloses(model, solid.outer, point)) solid.cavities.push_back(cavity);
    }
  }
  return solids;
}

PolyhedralModel blockOver(const PolyhedralModel& model, int shell) {
  Eigen::AlignedBox3d box;
  std::vector<FloorplanLayer> roofs;
  for (const PolyhedralFace& face : model.faces) {
    if (face.shell != shell) continue;
    for (const int i : face.outer) box.extend(vertexOf(model, i));
    const bool is_sill = face.window != WindowPart::None;
    if (face.label == FaceLabel::Roof && !is_sill)
      roofs.push_back({0.0, 0.0, {{outlineOf(model, face)}}});
  }
  for (FloorplanLayer& roof : roofs) {  // layers at the same height are united
    roof.z_min = box.min().z();
    roof.z_max = box.max().z();
  }
  return extrudeFloorplans(roofs, model.grid);
}

}  // namespace storey::exports
