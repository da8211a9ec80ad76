// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/planar_confidence_filter.h>

template class storey::PlanarConfidenceFilter<pcl::PointNormal>;
template class storey::PlanarConfidenceFilter<pcl::PointXYZRGBNormal>;
template class storey::PlanarConfidenceFilter<pcl::PointXYZINormal>;
template class storey::PlanarConfidenceFilter<pcl::PointXYZLNormal>;
