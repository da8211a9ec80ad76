// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "export/exported.h"

namespace storey::exports {

/// A model as triangles about an origin in its middle, along the axes of the input's coordinates:
/// for formats that hold floats. There a float resolves 2^-24 of the extent, a sixteenth of the
/// default grid, so that no two vertices fall together.
struct LocalMesh {
  Eigen::Vector3d origin;                 ///< in the input's coordinates
  std::vector<Eigen::Vector3f> vertices;  ///< relative to `origin`, parallel to the model's
  struct Face {
    std::size_t face;                           ///< index into the model's faces
    Eigen::Vector3f normal;                     ///< unit length, out of the solid
    std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`
  };
  std::vector<Face> faces;

  std::size_t countTriangles() const;
};

/// \throws io::Failure (Internal) if a face is no polygon
LocalMesh toLocalMesh(const Exported& exported);

}  // namespace storey::exports
