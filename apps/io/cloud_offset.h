// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::io {

/// A round offset that brings a cloud near the origin. With q1 and q99 the 1 % and 99 % quantiles
/// of an axis (single stray points must not decide), E the largest q99 - q1 of the three axes and
/// u the power of ten with E / 10 < u <= E:
///   offset = floor(q1 / u) u   on an axis where max(|q1|, |q99|) > 8 E,   else 0.
/// Local coordinates of all but strays are below 8 E, so that a float resolves E / 2^21 or better.
/// \param positions 3 numbers a point; points that are not finite are left out
/// \param threads 0: all cores
/// \return the same for any order of the points; 0 if no point is finite or E = 0
Eigen::Vector3d chooseOffset(const std::vector<double>& positions, unsigned int threads = 1);

}  // namespace storey::io
