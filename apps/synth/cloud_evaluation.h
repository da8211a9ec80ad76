// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "io/polygon_soup.h"

namespace storey::synth {

constexpr double kWallPoint = 0.3;  ///< largest |n.up| of a wall point

/// How well a model and a real cloud agree, where no truth is known.
struct CloudEvaluation {
  double sigma = 0.0;      ///< noise that the distances are compared with
  double cell_size = 0.0;  ///< of the raster on the walls
  std::size_t wall_points = 0;
  std::size_t explained_points = 0;    ///< of these, within 3 sigma of the model
  double wall_area = 0.0;              ///< of the model
  double supported_area = 0.0;         ///< of this, cells with a wall point within 3 sigma
  double shown_area = 0.0;             ///< of the model's walls that are not marked as guessed
  double supported_shown_area = 0.0;   ///< of this, as `supported_area`
  double explainedShare() const;       ///< 0 if there are no wall points
  double supportedShare() const;       ///< 0 if there are no walls
  double supportedShownShare() const;  ///< 0 if all walls are guessed
};

/// A point of the cloud in the coordinates of the model.
struct OrientedPosition {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit length; the sign does not matter
};

/// Wall points are those with |n.up| < kWallPoint; walls are polygons with |n.up| < 0.1. Walls are
/// rastered into square cells of max(3 sigma, sqrt(6 / density)), so that a cell on a wall that
/// was seen has 6 points on average and is missed once in 400 cells. A cell belongs to the
/// polygon that its centre lies in; a polygon too thin to have one counts as one cell.
/// Points without a finite normal are no wall points.
/// \param up unit length
/// \param sigma > 0, \param density points per unit area, > 0
CloudEvaluation evaluateAgainstCloud(const io::PolygonSoup& model,
                                     const std::vector<OrientedPosition>& points,
                                     const Eigen::Vector3d& up, double sigma, double density);

}  // namespace storey::synth
