// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/layerwise_floorplan_extraction.h>

template class storey::LayerwiseFloorplanExtraction<pcl::PointNormal>;
template class storey::LayerwiseFloorplanExtraction<pcl::PointXYZINormal>;
