// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

// Kernels of VerticalDirectionEstimation, in the order they are used. `normals` are unit.
namespace storey::detail {

using Vectors3d = std::vector<Eigen::Vector3d>;

/// Two unit vectors that complete a unit vector to a right-handed frame (e1, e2, up).
Eigen::Matrix<double, 3, 2> tangentFrame(const Eigen::Vector3d& up);

/// Evenly spread unit vectors with z >= 0, on a golden spiral.
Vectors3d fibonacciHemisphere(int count);

/// Share of the normals with |n.u| < gate.
double shareAcross(const Vectors3d& normals, const Eigen::Vector3d& u, double gate);

/// Where to begin, and how sure that is.
struct VerticalStart {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double score = 0.0;         ///< share of normals that `up` makes walls
  double second_score = 0.0;  ///< the best such share more than 30 degrees away from `up`
};

/// `guess` if the normals bear it out or if it is `forced`, else the direction across which most
/// normals lie, on the side of `guess`.
VerticalStart findVerticalStart(const Vectors3d& normals, const Eigen::Vector3d& guess, bool forced,
                                int num_threads);

/// Turns `up` until the wall normals lie across it: iterated weighted least squares of n.up over
/// |n.up| < 0.35 (Tukey's weights).
Eigen::Vector3d refineByNormals(const Vectors3d& normals, const Eigen::Vector3d& up,
                                int num_threads);

/// What the fit to positions found.
struct VerticalFit {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double deviation = 0.0;      ///< standard deviation of the weaker of the two angles, rad
  int patches = 0;             ///< flat columns of wall that took part
  bool one_direction = false;  ///< their normals are parallel: one angle is not determined
  Eigen::Vector3d loose = Eigen::Vector3d::Zero();  ///< then: the axis along which `up` may move
};

/// Cuts the wall points into upright columns of side `cell`, fits a plane to each, and turns `up`
/// until it lies in all of them (least squares weighted by the accuracy of each plane's lean,
/// Tukey's weights against what is no wall). Repeated, because columns lean with `up`.
VerticalFit refineByPositions(const Vectors3d& positions, const Vectors3d& normals,
                              const Eigen::Vector3d& up, double cell, int num_threads);

/// Turns `up` along `axis` until the normals within 25 degrees of it are centred there. Unchanged
/// if those are below 5 % of all.
Eigen::Vector3d refineByHorizontals(const Vectors3d& normals, const Eigen::Vector3d& up,
                                    const Eigen::Vector3d& axis);

}  // namespace storey::detail
