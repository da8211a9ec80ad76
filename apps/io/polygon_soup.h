// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace storey::io {

/// What model files hold: hole-free polygons over shared vertices. The type of every file that is
/// written from a model or read for evaluation.
struct PolygonSoup {
  struct Polygon {
    std::vector<int> corners;   ///< >= 3 indices into `vertices`, counter-clockwise from outside
    std::uint8_t label = 0;     ///< place in `kLabelNames`: 0 wall, 1 roof, ...
    int wall = -1;              ///< `PolyhedralFace::wall`
    int shell = 0;              ///< index of the closed part it belongs to
    bool hypothetical = false;  ///< guessed, not seen in the points: `PolyhedralFace`
    int support = 0;            ///< points on the face that it is a piece of, and so on as there
    double coverage = 0.0;
    double residual = 0.0;
    double deviation = 0.0;
  };

  std::vector<Eigen::Vector3d> vertices;
  std::vector<Polygon> polygons;
  /// Expected displacement of each vertex, infinite where unknown; empty if the model was not
  /// fitted to points, and then nothing is known of the support of its polygons either.
  std::vector<double> deviations;
  std::string crs;  ///< coordinate reference system of the file; empty: not known
};

}  // namespace storey::io
