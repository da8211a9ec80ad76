// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace storey::detail {

struct OrientedPoint {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;  ///< unit; +z is up
};

}  // namespace storey::detail
