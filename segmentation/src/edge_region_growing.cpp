// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/edge_region_growing.h>

template class storey::EdgeRegionGrowing<pcl::PointNormal>;
template class storey::EdgeRegionGrowing<pcl::PointXYZRGBNormal>;
template class storey::EdgeRegionGrowing<pcl::PointXYZINormal>;
template class storey::EdgeRegionGrowing<pcl::PointXYZLNormal>;
