// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/gravity_slicing.h>

template class storey::GravitySlicing<pcl::PointNormal>;
template class storey::GravitySlicing<pcl::PointXYZRGBNormal>;
template class storey::GravitySlicing<pcl::PointXYZINormal>;
template class storey::GravitySlicing<pcl::PointXYZLNormal>;
