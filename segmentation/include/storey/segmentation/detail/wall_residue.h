// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

/// A short stretch of a line along which points lie more densely than beside it.
struct DensePlace {
  Eigen::Vector2d normal;  ///< outwards
  double offset = 0.0;
  double s_min = 0.0;  ///< along the tangent
  double s_max = 0.0;
  double clarity = 0.0;  ///< log-likelihood ratio against an even density, nats
};

/// Short walls, as the jambs of a notch, have too few points for a vote among all lines, but theirs
/// lie close together, in a direction that is known. In strips across each direction the points of
/// a window as wide as a wall are counted against those beside it; a place counts if fewer than one
/// in a hundred such searches would find one as clear in an even density (Desolneux et al. 2000,
/// with a Poisson tail).
/// \param left of each point, whether it is of no wall yet: those alone make a place; the others
/// count beside it \param angles of the outward normals that walls may have, rad
/// \param threads 0: all cores; the result is the same for any number
/// \return the clearest first; places of the same wall may overlap
std::vector<DensePlace> findDensePlaces(const std::vector<WallPoint>& points,
                                        const std::vector<char>& left,
                                        const std::vector<double>& angles, double noise,
                                        unsigned int threads = 0);

}  // namespace storey::detail
