// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <cmath>

#include "io/cameras/camera_formats.h"
#include "io/scan.h"

namespace storey::io {

void parseNumbers(const InputFile& file, std::string_view line, std::size_t count,
                  double* numbers) {
  NumberScanner scanner(line);
  for (std::size_t i = 0; i < count; ++i) {
    if (scanner.next(numbers[i]) != NumberScanner::Result::Number || !std::isfinite(numbers[i])) {
      file.failAtLine("has no " + std::to_string(count) + " finite numbers");
    }
  }
  double rest = 0.0;
  if (scanner.next(rest) != NumberScanner::Result::End) {
    file.failAtLine("has more than " + std::to_string(count) + " numbers");
  }
}

bool setPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation, Camera& camera) {
  constexpr double kRounding = 1e-3;
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error < kRounding) || !(rotation.determinant() > 0.0)) return false;
  camera.world_to_camera.linear() = Eigen::Quaterniond(rotation).normalized().matrix();
  camera.world_to_camera.translation() = translation;
  return true;
}

// With P = lambda K [R | t], the rows of R come off by Gram-Schmidt from the last one up.
bool setProjection(const Eigen::Matrix<double, 3, 4>& projection, Camera& camera) {
  const Eigen::Matrix3d left = projection.leftCols<3>();
  const double scale = left.row(2).norm() * (left.determinant() > 0.0 ? 1.0 : -1.0);
  if (!(scale != 0.0) || !std::isfinite(scale)) return false;
  const Eigen::Vector3d x = left.row(0).transpose() / scale;
  const Eigen::Vector3d y = left.row(1).transpose() / scale;
  Eigen::Matrix3d rotation;
  const Eigen::Vector3d ahead = left.row(2).transpose() / scale;
  camera.principal = {x.dot(ahead), y.dot(ahead)};
  const Eigen::Vector3d down = y - camera.principal.y() * ahead;
  camera.focal.y() = down.norm();
  camera.skew = x.dot(down.normalized());
  const Eigen::Vector3d right = x - camera.principal.x() * ahead - camera.skew * down.normalized();
  camera.focal.x() = right.norm();
  rotation << right.normalized().transpose(), down.normalized().transpose(), ahead.transpose();

  Eigen::Matrix3d k;
  k << camera.focal.x(), camera.skew, camera.principal.x(),  //
      0.0, camera.focal.y(), camera.principal.y(),           //
      0.0, 0.0, 1.0;
  const Eigen::Vector3d translation = k.inverse() * projection.col(3) / scale;
  constexpr double kFlattest = 1e-9;  // of one focal length to the other: the matrix is singular
  const bool singular = !(camera.focal.minCoeff() > kFlattest * camera.focal.maxCoeff());
  if (singular || !translation.allFinite() || !setPose(rotation, translation, camera)) return false;
  camera.principal += Eigen::Vector2d::Constant(0.5);
  return true;
}

}  // namespace storey::io
