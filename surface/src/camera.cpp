// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/camera.h>

namespace storey {

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point) const {
  const std::optional<Eigen::Vector2d> image = lens.distort(world_to_camera * point);
  if (!image) return std::nullopt;
  return Eigen::Vector2d(focal.x() * image->x() + skew * image->y() + principal.x(),
                         focal.y() * image->y() + principal.y());
}

std::optional<Eigen::Vector3d> Camera::ray(const Eigen::Vector2d& pixel) const {
  const double y = (pixel.y() - principal.y()) / focal.y();
  const double x = (pixel.x() - principal.x() - skew * y) / focal.x();
  const std::optional<Eigen::Vector3d> direction = lens.undistort({x, y});
  if (!direction) return std::nullopt;
  return Eigen::Vector3d(world_to_camera.linear().transpose() * *direction);
}

std::optional<Eigen::Vector3d> Camera::backProject(const Eigen::Vector2d& pixel,
                                                   double distance) const {
  const std::optional<Eigen::Vector3d> direction = ray(pixel);
  if (!direction) return std::nullopt;
  return Eigen::Vector3d(center() + distance * *direction);
}

}  // namespace storey
