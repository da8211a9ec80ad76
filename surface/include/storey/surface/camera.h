// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>

namespace storey {

/// How a lens bends rays: a ray of the camera's frame (x right, y down, z ahead) to a point of the
/// image plane at focal length 1, and back. Default: a pinhole, (x / z, y / z).
///
/// The ray's ideal point q is (x, y) / z, or for fisheyes (x, y) times angle to the axis over
/// |(x, y)|. It is moved to, with s = |q|^2 = x^2 + y^2 of q from here on,
///
///     q g(s) + (2 p1 x y + p2 (s + 2 x^2) + s1 s,  2 p2 x y + p1 (s + 2 y^2) + s2 s)
///     g(s) = (1 + a1 s + a2 s^2 + a3 s^3 + a4 s^4) / (1 + b1 s + b2 s^2 + b3 s^3),
///     or, for the field-of-view model,  g(s) = atan(2 |q| tan(w / 2)) / (|q| w).
///
/// That covers all closed-form models of COLMAP and OpenCV. Rays further out than where |q| g(s)
/// stops growing have no image: beyond, a polynomial would fold them back into the picture.
class Lens {
 public:
  Lens() = default;

  /// \param numerator   a1, a2, a3 (k1, k2, k3 of OpenCV)
  /// \param denominator b1, b2, b3 (k4, k5, k6)
  /// \param tangential  p1, p2
  static Lens perspective(const std::array<double, 3>& numerator,
                          const std::array<double, 3>& denominator = {},
                          const Eigen::Vector2d& tangential = Eigen::Vector2d::Zero());

  /// \param radial a1 .. a4 (k1 .. k4)
  /// \param prism  s1, s2
  static Lens fisheye(const std::array<double, 4>& radial,
                      const Eigen::Vector2d& tangential = Eigen::Vector2d::Zero(),
                      const Eigen::Vector2d& prism = Eigen::Vector2d::Zero());

  /// \param omega w, in radians within (0, pi); 0 is a pinhole
  static Lens fieldOfView(double omega);

  /// Image of a ray; nothing behind the camera (a fisheye sees up to 180 degrees off its axis) or
  /// beyond what the lens can show.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector3d& ray) const;

  /// Unit ray of a point of the image plane; nothing if the lens shows nothing there. Newton's
  /// method, kept between bounds along the radius and by shorter steps in the plane; exact to
  /// rounding.
  std::optional<Eigen::Vector3d> undistort(const Eigen::Vector2d& point) const;

 private:
  enum class Kind { Perspective, Fisheye, FieldOfView };

  double radialFactor(double s) const;
  double radialSlope(double s) const;  // d g / d s
  Eigen::Vector2d distortPlane(const Eigen::Vector2d& q) const;
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& q) const;
  std::optional<double> undistortRadius(double distorted) const;
  bool undistortPlane(const Eigen::Vector2d& point, Eigen::Vector2d& q) const;
  void findLimit();

  Kind kind_ = Kind::Perspective;
  std::array<double, 4> numerator_{};
  std::array<double, 3> denominator_{};
  Eigen::Vector2d tangential_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d prism_ = Eigen::Vector2d::Zero();
  double omega_ = 0.0;
  double max_radius_ = std::numeric_limits<double>::infinity();  // of q: the lens shows no more
};

/// A photo's geometry: pixel = K lens(world_to_camera * point). Pixels are counted from the upper
/// left corner of the image, x to the right and y down; the centre of the first pixel is at
/// (0.5, 0.5), and the image is [0, width] x [0, height].
struct Camera {
  int width = 0;                                    ///< pixels
  int height = 0;                                   ///< pixels
  Eigen::Vector2d focal = Eigen::Vector2d::Ones();  ///< pixels, > 0
  double skew = 0.0;                                ///< pixels: K(0, 1)
  Eigen::Vector2d principal = Eigen::Vector2d::Zero();
  Lens lens;
  /// The camera's frame: origin in the centre of projection, x right, y down, z ahead.
  Eigen::Isometry3d world_to_camera = Eigen::Isometry3d::Identity();

  Eigen::Vector3d center() const { return world_to_camera.inverse().translation(); }
  /// Distance ahead of the camera, along its axis.
  double depth(const Eigen::Vector3d& point) const { return (world_to_camera * point).z(); }
  bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= width && pixel.y() <= height;
  }

  /// Where the point appears, inside the image or not; nothing if it cannot appear at all.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// Unit direction, in the world, of the ray from `center()` through a pixel.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;

  /// The point at `distance` from the centre that appears at `pixel`.
  std::optional<Eigen::Vector3d> backProject(const Eigen::Vector2d& pixel, double distance) const;
};

}  // namespace storey
