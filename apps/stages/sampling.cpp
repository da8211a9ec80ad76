// SPDX-License-Identifier: BSD-3-Clause
#include "stages/sampling.h"

#include <pcl/common/io.h>
#include <storey/filters/noise_limited_sampling.h>

namespace storey::stages {

std::string findSampleSize(StageCloud& cloud, const SamplingOptions& options,
                           unsigned int threads) {
  NoiseLimitedSampling<Point> sampling;
  sampling.setInputCloud(cloud.points);
  sampling.setNoise(options.noise);
  sampling.setSampleSize(static_cast<std::size_t>(options.structure_points));
  sampling.setNumberOfThreads(threads);
  sampling.filter(cloud.sample);
  cloud.state.sample_size = cloud.sample.size();
  return format("%zu of %zu points show all that the noise lets tell apart", cloud.sample.size(),
                cloud.points->size());
}

bool isSampled(const StageCloud& cloud) {
  return cloud.state.sample_size > 0 && cloud.state.sample_size < cloud.points->size();
}

Cloud::Ptr samplePoints(const StageCloud& cloud) {
  if (!isSampled(cloud)) return cloud.points;
  const auto sample = pcl::make_shared<Cloud>();
  if (cloud.sample.size() == cloud.state.sample_size) {
    pcl::copyPointCloud(*cloud.points, cloud.sample, *sample);
    return sample;
  }
  NoiseLimitedSampling<Point> sampling;
  sampling.setInputCloud(cloud.points);
  sampling.setSampleSize(cloud.state.sample_size);
  sampling.filter(*sample);
  return sample;
}

StageCloud sampleOf(const StageCloud& cloud) {
  StageCloud sample = cloud;
  sample.points = samplePoints(cloud);
  sample.sample = {};
  sample.state.density *= static_cast<double>(sample.points->size()) /
                          static_cast<double>(std::max<std::size_t>(cloud.points->size(), 1));
  return sample;
}

}  // namespace storey::stages
