// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/vertical_direction_estimation.h>

template class storey::VerticalDirectionEstimation<pcl::PointNormal>;
template class storey::VerticalDirectionEstimation<pcl::PointXYZRGBNormal>;
template class storey::VerticalDirectionEstimation<pcl::PointXYZINormal>;
template class storey::VerticalDirectionEstimation<pcl::PointXYZLNormal>;
template class storey::VerticalDirectionEstimation<pcl::PointXYZ, pcl::Normal>;
