// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/building_floorplan_extraction.h>

template class storey::BuildingFloorplanExtraction<pcl::PointNormal>;
template class storey::BuildingFloorplanExtraction<pcl::PointXYZINormal>;
