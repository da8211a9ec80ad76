// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Core>
#include <vector>

namespace storey {

/// A flat piece of a model's surface: the points inside an odd number of its rings. The rings may
/// be an outline with holes, or adjoining pieces of it.
struct Facade {
  std::vector<std::vector<Eigen::Vector3d>> rings;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, out of the building
};

/// The faces of a model, in their order.
std::vector<Facade> facadesOf(const PolyhedralModel& model);

/// Rings in the coordinates (x, y) of a `FacadeFrame`.
using FacadeOutline = std::vector<std::vector<Eigen::Vector2d>>;

/// The rectangle about a facade: seen from outside, x runs to the right and y upwards from the
/// lower left corner. On a level facade, y is the world's y (or x, if the vertical is along y).
struct FacadeFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< lower left corner
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double width = 0.0;  ///< in the model's unit, as height
  double height = 0.0;

  Eigen::Vector3d normal() const { return right.cross(up); }
  Eigen::Vector3d point(double x, double y) const { return origin + x * right + y * up; }
  Eigen::Vector2d local(const Eigen::Vector3d& point) const {
    return {right.dot(point - origin), up.dot(point - origin)};
  }
  FacadeOutline outline(const Facade& facade) const;
};

/// \param vertical unit vector, upwards
FacadeFrame frameOf(const Facade& facade,
                    const Eigen::Vector3d& vertical = Eigen::Vector3d::UnitZ());

/// Whether a point lies inside an odd number of rings.
bool isInside(const FacadeOutline& outline, const Eigen::Vector2d& point);

}  // namespace storey
