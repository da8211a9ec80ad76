// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/cloud_scale.h>
#include <storey/filters/noise_limited_sampling.h>

#include <algorithm>

namespace storey::detail {
namespace {

// A part smaller than what it asks for by no more than this shows the noise of it well enough.
constexpr double kCloseEnough = 1.5;
constexpr std::size_t kFirstPoints = 200000;

}  // namespace

std::size_t noiseLimitedSize(std::size_t size, const DrawPositions& draw, double noise,
                             double points_per_noise_area, std::size_t least,
                             unsigned int threads) {
  const auto all = static_cast<double>(size);
  std::size_t count = std::max(least, kFirstPoints);
  while (count < size) {
    const CloudScale scale = estimateCloudScale(draw(count), kDefaultScaleSeed, threads);
    const double deviation = noise > 0.0 ? noise : scale.noise;
    const double share_per_noise_area =
        scale.density * deviation * deviation / static_cast<double>(count);
    if (!(share_per_noise_area > 0.0)) break;
    const double wanted = points_per_noise_area / share_per_noise_area;
    if (wanted >= all) break;
    if (wanted <= kCloseEnough * static_cast<double>(count)) {
      return std::max(least, static_cast<std::size_t>(wanted));
    }
    count = static_cast<std::size_t>(wanted);
  }
  return size;
}

}  // namespace storey::detail

template class storey::NoiseLimitedSampling<pcl::PointNormal>;
template class storey::NoiseLimitedSampling<pcl::PointXYZRGBNormal>;
template class storey::NoiseLimitedSampling<pcl::PointXYZINormal>;
template class storey::NoiseLimitedSampling<pcl::PointXYZLNormal>;
