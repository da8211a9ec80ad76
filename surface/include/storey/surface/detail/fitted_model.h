// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/layerwise_model.h>

#include <Eigen/Geometry>
#include <map>
#include <vector>

namespace storey::detail {

/// The noise that the walls show: the residual of the wall in the middle, counted by points.
double noiseOfWalls(const std::map<int, WallFit>& walls, double guess);

/// Takes the points to the frame of the model.
void turnPoints(const Eigen::Isometry3d& upright, unsigned int threads, FitPoints& points);

/// The solid over fitted layers, its checks, and what the points and the fits (`result.walls`,
/// `result.levels`) say of its faces and vertices.
void extrudeFits(const std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
                 const LayerwiseModelOptions& options, LayerwiseModel& result);

}  // namespace storey::detail
