// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/layerwise_mrf_reconstruction.h>

template class storey::LayerwiseMRFReconstruction<pcl::PointNormal>;
template class storey::LayerwiseMRFReconstruction<pcl::PointXYZINormal>;
