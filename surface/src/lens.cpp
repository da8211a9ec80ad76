// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/camera.h>

#include <Eigen/LU>
#include <cmath>

namespace storey {
namespace {

// Below this |q| the field-of-view factor is its series: the next term is below rounding.
constexpr double kSmallRadius = 1e-4;
constexpr int kMaxIterations = 100;  // of Newton's method, which takes 3 to 6

}  // namespace

Lens Lens::perspective(const std::array<double, 3>& numerator,
                       const std::array<double, 3>& denominator,
                       const Eigen::Vector2d& tangential) {
  Lens lens;
  lens.numerator_ = {numerator[0], numerator[1], numerator[2], 0.0};
  lens.denominator_ = denominator;
  lens.tangential_ = tangential;
  lens.findLimit();
  return lens;
}

Lens Lens::fisheye(const std::array<double, 4>& radial, const Eigen::Vector2d& tangential,
                   const Eigen::Vector2d& prism) {
  Lens lens;
  lens.kind_ = Kind::Fisheye;
  lens.numerator_ = radial;
  lens.tangential_ = tangential;
  lens.prism_ = prism;
  lens.findLimit();
  return lens;
}

Lens Lens::fieldOfView(double omega) {
  Lens lens;
  if (!(omega > 0.0)) return lens;
  lens.kind_ = Kind::FieldOfView;
  lens.omega_ = omega;
  return lens;
}

double Lens::radialFactor(double s) const {
  if (kind_ == Kind::FieldOfView) {
    const double a = 2.0 * std::tan(0.5 * omega_);
    const double r = std::sqrt(s);
    return r < kSmallRadius ? a / omega_ * (1.0 - a * a * s / 3.0)
                            : std::atan(a * r) / (r * omega_);
  }
  const auto& a = numerator_;
  const auto& b = denominator_;
  return (1.0 + s * (a[0] + s * (a[1] + s * (a[2] + s * a[3])))) /
         (1.0 + s * (b[0] + s * (b[1] + s * b[2])));
}

double Lens::radialSlope(double s) const {
  if (kind_ == Kind::FieldOfView) {
    const double a = 2.0 * std::tan(0.5 * omega_);
    const double r = std::sqrt(s);
    if (r < kSmallRadius) return -a * a * a / (3.0 * omega_);
    return (a * r / (1.0 + a * a * s) - std::atan(a * r)) / (2.0 * r * s * omega_);
  }
  const auto& a = numerator_;
  const auto& b = denominator_;
  const double above = 1.0 + s * (a[0] + s * (a[1] + s * (a[2] + s * a[3])));
  const double below = 1.0 + s * (b[0] + s * (b[1] + s * b[2]));
  const double above_slope = a[0] + s * (2.0 * a[1] + s * (3.0 * a[2] + s * 4.0 * a[3]));
  const double below_slope = b[0] + s * (2.0 * b[1] + s * 3.0 * b[2]);
  return (above_slope - above / below * below_slope) / below;
}

void Lens::findLimit() {
  // Steps of a tenth of a degree up to the largest angle; a lens that folds its picture does so
  // over more than that.
  constexpr int kStepsPerRightAngle = 900;
  const int num_steps = kind_ == Kind::Fisheye ? 2 * kStepsPerRightAngle : kStepsPerRightAngle - 1;
  max_radius_ = kind_ == Kind::Fisheye ? M_PI : std::numeric_limits<double>::infinity();
  double last = 0.0;
  for (int i = 1; i <= num_steps; ++i) {
    const double angle = M_PI_2 * i / kStepsPerRightAngle;
    const double r = kind_ == Kind::Fisheye ? angle : std::tan(angle);
    const double s = r * r;
    const bool grows = radialFactor(s) + 2.0 * s * radialSlope(s) > 0.0;  // d (r g) / d r
    if (!grows || !(radialFactor(s) > 0.0)) {
      max_radius_ = last;
      return;
    }
    last = r;
  }
}

Eigen::Vector2d Lens::distortPlane(const Eigen::Vector2d& q) const {
  const double s = q.squaredNorm();
  return radialFactor(s) * q + 2.0 * q.x() * q.y() * tangential_ +
         tangential_.reverse().cwiseProduct((2.0 * q.cwiseAbs2().array() + s).matrix()) +
         s * prism_;
}

Eigen::Matrix2d Lens::jacobian(const Eigen::Vector2d& q) const {
  const double s = q.squaredNorm();
  Eigen::Matrix2d j = radialFactor(s) * Eigen::Matrix2d::Identity() +
                      2.0 * radialSlope(s) * q * q.transpose() + 2.0 * prism_ * q.transpose() +
                      2.0 * tangential_ * q.reverse().transpose() +
                      2.0 * tangential_.reverse() * q.transpose();
  j(0, 0) += 4.0 * tangential_.y() * q.x();
  j(1, 1) += 4.0 * tangential_.x() * q.y();
  return j;
}

std::optional<Eigen::Vector2d> Lens::distort(const Eigen::Vector3d& ray) const {
  const double across = ray.head<2>().norm();
  Eigen::Vector2d q;
  if (kind_ == Kind::Fisheye) {
    if (across == 0.0 && !(ray.z() > 0.0)) return std::nullopt;
    q = across > 0.0 ? Eigen::Vector2d(std::atan2(across, ray.z()) / across * ray.head<2>())
                     : Eigen::Vector2d::Zero();
  } else {
    if (!(ray.z() > 0.0)) return std::nullopt;
    q = ray.head<2>() / ray.z();
  }
  if (!(q.norm() <= max_radius_) || !q.allFinite()) return std::nullopt;
  return distortPlane(q);
}

std::optional<double> Lens::undistortRadius(double distorted) const {
  const auto image = [this](double r) { return r * radialFactor(r * r); };
  double low = 0.0;
  double high = std::min(max_radius_, 1e6);  // 1e6: within 1e-6 rad of a right angle
  if (!(image(high) >= distorted)) return std::nullopt;
  double r = std::min(distorted, high);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double excess = image(r) - distorted;
    (excess > 0.0 ? high : low) = r;
    const double slope = radialFactor(r * r) + 2.0 * r * r * radialSlope(r * r);
    double next = r - excess / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - r) <= std::numeric_limits<double>::epsilon() * r) return next;
    r = next;
  }
  return r;
}

bool Lens::undistortPlane(const Eigen::Vector2d& point, Eigen::Vector2d& q) const {
  constexpr double kShortest = 1e-6;  // of Newton's step: shorter ones gain nothing
  const double tolerance = 1e-14 * (1.0 + point.norm());
  Eigen::Vector2d error = distortPlane(q) - point;
  for (int i = 0; i < kMaxIterations && error.norm() > tolerance; ++i) {
    const Eigen::Vector2d step = jacobian(q).inverse() * error;
    double share = 1.0;
    Eigen::Vector2d next_error = distortPlane(q - step) - point;
    while (!(next_error.norm() < error.norm()) && share > kShortest) {
      share *= 0.5;
      next_error = distortPlane(q - share * step) - point;
    }
    if (!(next_error.norm() < error.norm())) break;
    q -= share * step;
    error = next_error;
  }
  return error.norm() <= 100.0 * tolerance && q.norm() <= max_radius_;
}

std::optional<Eigen::Vector3d> Lens::undistort(const Eigen::Vector2d& point) const {
  const double distorted = point.norm();
  Eigen::Vector2d q = point;
  if (distorted > 0.0) {
    const std::optional<double> radius = undistortRadius(distorted);
    if (!radius) return std::nullopt;
    q *= *radius / distorted;
  }
  if (!undistortPlane(point, q)) return std::nullopt;
  const double r = q.norm();
  if (kind_ != Kind::Fisheye) return Eigen::Vector3d(q.x(), q.y(), 1.0).normalized();
  const double across = r > 0.0 ? std::sin(r) / r : 1.0;
  return Eigen::Vector3d(across * q.x(), across * q.y(), std::cos(r));
}

}  // namespace storey
