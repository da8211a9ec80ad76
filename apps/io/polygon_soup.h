// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace storey::io {

/// What model files hold: hole-free polygons over shared vertices. The type of every file that is
/// written from a model or read for evaluation.
struct PolygonSoup {
  struct Polygon {
    std::vector<int> corners;   ///< >= 3 indices into `vertices`, counter-clockwise from outside
    std::uint8_t label = 0;     ///< `FaceLabel`: 0 wall, 1 roof, 2 ground, 3 ceiling
    int wall = -1;              ///< `PolyhedralFace::wall`
    int shell = 0;              ///< index of the closed part it belongs to
    bool hypothetical = false;  ///< a wall that was not seen in the points
  };

  std::vector<Eigen::Vector3d> vertices;
  std::vector<Polygon> polygons;
};

}  // namespace storey::io
