// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

/// A point type that PCL has never heard of: every class must compile and link with it.
struct EIGEN_ALIGN16 ForeignPoint {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  float curvature = 0.0f;
  float reflectance = 0.0f;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(ForeignPoint,
    (float, x, x)(float, y, y)(float, z, z)
    (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)
    (float, curvature, curvature)(float, reflectance, reflectance))
// clang-format on
