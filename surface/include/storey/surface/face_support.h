// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>
#include <storey/surface/polyhedral_model.h>

#include <map>
#include <vector>

namespace storey {

/// What the points say of each face: `support`, `coverage` and `residual`, and `hypothetical` where
/// less than a third of the face is covered, whether wall, roof or ground.
///
/// A point supports the nearest face that it lies within three noise deviations of, inside its
/// rings, with a normal within 60 degrees of the face's (a zero normal agrees with every wall).
/// Faces are cut into cells of about max(3 sigma, sqrt(6 / density)), but no more cells in all than
/// there are points: a face that was seen has 6 points in a cell on average, and 1 - exp(-6) of its
/// cells are covered. The density is that of the face which the point in the middle lies on.
/// \param noise standard deviation of the points about their walls, > 0; else, after a PCL_ERROR,
///        nothing changes
/// \param threads 0: all cores; the result is the same for any number
/// \par Complexity O(n) in the points, times the faces near each.
void measureSupport(const FitPoints& points, double noise, PolyhedralModel& model,
                    unsigned int threads = 0);

/// Sets `PolyhedralFace::deviation` of every face and `PolyhedralModel::covariances` of every
/// vertex from those of the fits. A vertex is the crossing of the two of its walls that meet at the
/// largest angle, at its level. With n_1, n_2 their normals and v_i the variance of wall i at the
/// vertex, the plan part of the covariance is N^-1 diag(v_1, v_2) N^-T, N = (n_1, n_2)^T: walls
/// that cross share no direction, so their errors are independent. What was not seen is infinite.
void propagateDeviations(const std::map<int, WallFit>& walls, const std::vector<HeightFit>& levels,
                         PolyhedralModel& model);

}  // namespace storey
