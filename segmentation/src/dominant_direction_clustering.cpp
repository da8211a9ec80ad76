// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/dominant_direction_clustering.h>

template class storey::DominantDirectionClustering<pcl::PointNormal>;
template class storey::DominantDirectionClustering<pcl::PointXYZRGBNormal>;
template class storey::DominantDirectionClustering<pcl::PointXYZINormal>;
template class storey::DominantDirectionClustering<pcl::PointXYZLNormal>;
