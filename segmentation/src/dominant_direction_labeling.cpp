// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/dominant_direction_labeling.h>

template class storey::DominantDirectionLabeling<pcl::PointNormal>;
template class storey::DominantDirectionLabeling<pcl::PointXYZRGBNormal>;
template class storey::DominantDirectionLabeling<pcl::PointXYZINormal>;
template class storey::DominantDirectionLabeling<pcl::PointXYZLNormal>;
