// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "io/polygon_soup.h"
#include "synth/polygon_mesh.h"

namespace storey::synth {

/// The polyhedron that a file's polygons were written from, for `checkModel`: pieces joined to
/// faces with holes, the vertical turned to +z, vertices rounded to the grid that
/// `extrudeFloorplans` takes by default (2^-20 of the largest extent, rounded up to a power of
/// ten). Horizontal faces without a label get one by their sense. Rounding is by half a grid unit
/// at most, so a defect smaller than that is not seen.
/// \param mesh `measurable(soup)`
/// \param up unit length
PolyhedralModel rebuildModel(const io::PolygonSoup& soup, const PolygonMesh& mesh,
                             const Eigen::Vector3d& up);

/// From the coordinates of such a model to those of the file.
Eigen::Isometry3d rebuiltToFile(const io::PolygonSoup& soup, const Eigen::Vector3d& up);

}  // namespace storey::synth
