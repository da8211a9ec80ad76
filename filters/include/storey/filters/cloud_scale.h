// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/eigen_alignment.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace storey {

/// The lengths that every default of the other stages is derived from, in the cloud's own unit.
/// A value that cannot be told is 0, so test before dividing.
struct CloudScale {
  double noise = 0.0;  ///< standard deviation of the points about their local planes; of a perfect
                       ///< cloud about the rounding of its coordinates, down to 0
  double density = 0.0;  ///< points per unit of surface area, duplicates counted
  double spacing = 0.0;  ///< median distance of a position to the nearest other one
  double extent = 0.0;   ///< diagonal of the box between the 1 % and 99 % quantiles of x, y and z
  double noise_deviation = 0.0;  ///< standard deviation of the noise's own error
  double noise_share = 0.0;      ///< of the neighbourhoods that tell it; others hold edges, trees
};

constexpr std::uint32_t kDefaultScaleSeed = 1;

namespace detail {
/// \param threads 0: all cores
CloudScale estimateCloudScale(const std::vector<Eigen::Vector3f>& positions, std::uint32_t seed,
                              unsigned int threads = 1);
}  // namespace detail

/// Measures the scale of a cloud from 1500 neighbourhoods drawn at random.
///
/// A neighbourhood is the k = 200 nearest positions (k = n/100 below 20,000, at least 20).
/// Its plane is that of least squares; the noise's variance v is that of the points within 2.5
/// deviations of it, as the core of a normal distribution (tails and the panes of windows are
/// others), times k / (k - 3) (a plane has three parameters), times 1 + 2 v / r^2 for what the ball
/// of radius r cuts off. Neighbourhoods of edges and trees have a larger v. So the 25th percentile
/// of v is a start, freed of the scatter of chi-square, and the noise is the mean over all that
/// exceed it by no more than 2.5 standard deviations of that scatter. The density is the median of
/// (k - 4/3) / (pi (r^2 - 2 noise^2)) over the flattest 40 %. Where 200 points are too few to see a
/// plane (r < 8 noise), the cloud is thinned by 4 until they do.
///
/// NaN and infinite points and coordinates beyond 1e18 are ignored; duplicates count once except in
/// the density. With no usable point everything is 0, with fewer than 5 distinct positions noise
/// and density are. \param seed of the draw; the same seed and points, in any order, give the same
/// result
///
/// \par Complexity O(n log n) time, about 40 bytes a point.
template <typename PointT>
CloudScale estimateCloudScale(const pcl::PointCloud<PointT>& cloud,
                              std::uint32_t seed = kDefaultScaleSeed) {
  return detail::estimateCloudScale(detail::positionsOf(cloud), seed);
}

}  // namespace storey
