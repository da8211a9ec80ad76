// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/anisotropic_position_refinement.h>

template class storey::AnisotropicPositionRefinement<pcl::PointNormal>;
template class storey::AnisotropicPositionRefinement<pcl::PointXYZRGBNormal>;
template class storey::AnisotropicPositionRefinement<pcl::PointXYZINormal>;
template class storey::AnisotropicPositionRefinement<pcl::PointXYZLNormal>;
