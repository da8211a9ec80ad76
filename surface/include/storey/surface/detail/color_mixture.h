// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// A mixture of up to 5 normal distributions of colours, fitted by expectation maximisation from
/// groups of equal size in the order of brightness: no random start.
class ColorMixture {
 public:
  /// \param colors at least one; grey levels
  explicit ColorMixture(const std::vector<Eigen::Array3f>& colors);

  float logDensity(const Eigen::Array3f& color) const;

 private:
  struct Component {
    Eigen::Vector3f mean;
    Eigen::Matrix3f whitening;  // |whitening (c - mean)|^2: squared Mahalanobis distance
    float log_weight;           // with the factor of the density
  };

  Component fit(const std::vector<Eigen::Array3f>& colors, const Eigen::VectorXf& shares) const;

  std::vector<Component> components_;
};

}  // namespace storey::detail
