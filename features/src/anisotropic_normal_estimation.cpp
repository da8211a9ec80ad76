// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/anisotropic_normal_estimation.h>

template class storey::AnisotropicNormalEstimation<pcl::PointNormal>;
template class storey::AnisotropicNormalEstimation<pcl::PointXYZRGBNormal>;
template class storey::AnisotropicNormalEstimation<pcl::PointXYZINormal>;
template class storey::AnisotropicNormalEstimation<pcl::PointXYZLNormal>;
