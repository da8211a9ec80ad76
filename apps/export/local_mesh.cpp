// SPDX-License-Identifier: BSD-3-Clause
#include "export/local_mesh.h"

#include <storey/surface/triangulation.h>

#include <cmath>

#include "io/failure.h"

namespace storey::exports {
namespace {

Eigen::Vector3d normalOf(const PolyhedralModel& model, const PolyhedralFace& face) {
  const auto vertex = [&](std::size_t i) {
    return model.vertices[static_cast<std::size_t>(face.outer[i % face.outer.size()])];
  };
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < face.outer.size(); ++i) {
    area += (vertex(i) - vertex(0)).cross(vertex(i + 1) - vertex(0));
  }
  // Walls are vertical, though the corners of one may stray from its plane by a grid unit.
  if (face.label == FaceLabel::Wall) area.z() = 0.0;
  return area.normalized();
}

// A point of the model's lattice, so that coordinates about it keep short decimals.
Eigen::Vector3d middleOf(const PolyhedralModel& model) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(v);
  Eigen::Vector3d middle = box.center() / model.grid;
  for (double& coordinate : middle) coordinate = std::round(coordinate) * model.grid;
  return middle;
}

}  // namespace

std::size_t LocalMesh::countTriangles() const {
  std::size_t count = 0;
  for (const Face& face : faces) count += face.triangles.size();
  return count;
}

LocalMesh toLocalMesh(const Exported& exported) {
  const PolyhedralModel& model = exported.model;
  const Eigen::Vector3d middle = middleOf(model);
  LocalMesh mesh;
  mesh.origin = exported.local_to_input * middle;
  for (const Eigen::Vector3d& v : model.vertices) {
    mesh.vertices.emplace_back((exported.local_to_input.linear() * (v - middle)).cast<float>());
  }
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const PolyhedralFace& face = model.faces[f];
    std::vector<std::array<int, 3>> triangles = triangulateFace(model, face);
    if (triangles.empty()) {
      throw io::Failure(io::Internal, "", "a face of the model is no polygon",
                        "please report it with the input");
    }
    const Eigen::Vector3d normal = exported.local_to_input.linear() * normalOf(model, face);
    mesh.faces.push_back({f, normal.cast<float>(), std::move(triangles)});
  }
  return mesh;
}

}  // namespace storey::exports
