// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/outward_normal_orientation.h>

template class storey::OutwardNormalOrientation<pcl::PointNormal>;
template class storey::OutwardNormalOrientation<pcl::PointXYZRGBNormal>;
template class storey::OutwardNormalOrientation<pcl::PointXYZINormal>;
template class storey::OutwardNormalOrientation<pcl::PointXYZLNormal>;
