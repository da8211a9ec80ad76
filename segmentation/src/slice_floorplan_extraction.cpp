// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/slice_floorplan_extraction.h>

template class storey::SliceFloorplanExtraction<pcl::PointNormal>;
template class storey::SliceFloorplanExtraction<pcl::PointXYZINormal>;
