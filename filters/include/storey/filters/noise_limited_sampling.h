// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/filters/filter_indices.h>
#include <pcl/point_types.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/eigen_alignment.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace storey {

namespace detail {

/// So many of some positions, evenly drawn.
using DrawPositions = std::function<std::vector<Eigen::Vector3f>(std::size_t count)>;

/// How many of the positions show all the shape that the noise lets tell apart: see
/// `NoiseLimitedSampling`. \param size how many there are \param draw called for fewer than that
/// \param noise of the points about their surfaces; 0: measured \param points_per_noise_area > 0
/// \param least of the result, but never more than there are
std::size_t noiseLimitedSize(std::size_t size, const DrawPositions& draw, double noise,
                             double points_per_noise_area, std::size_t least, unsigned int threads);

}  // namespace detail

/// Thins a cloud whose points lie closer together than their noise.
///
/// Such points say no more about where one surface ends and the next begins: all they add is that
/// places are averaged over more of them. So what a building is made of can be found in a part of
/// the points, and fitted to all of them afterwards: the same model in a fraction of the time.
///
/// A part is drawn evenly that leaves q = 0.5 points on each noise^2 of surface: 200 of them on the
/// smallest wall that the later stages take for one, whose side is 20 noise deviations. Noise and
/// density are measured by `estimateCloudScale` on the part itself, which grows until it holds
/// enough: in too small a part, curves and corners would be taken for noise.
///
/// Every n-th of the points is drawn, n any number, so the part is even where points that follow
/// each other are neighbours, as the programs' reader orders them. The order is kept. Clouds that
/// are not so dense, and clouds of no more than 200,000 points, are left as they are.
/// - Points with a non-finite coordinate are always removed, also under `setNegative(true)`.
/// - The output of `filter(cloud)` is dense, except under `setKeepOrganized(true)`.
///
/// A bad parameter or an index outside the cloud gives a PCL_ERROR and an empty result.
/// \tparam PointT needs x, y, z
/// \par Complexity O(n) time for the draw, and `estimateCloudScale` of the part.
/// \par In pcl_viewer
/// `storey_sampling IN OUT.pcd`: the same surfaces with fewer points.
template <typename PointT>
class NoiseLimitedSampling : public pcl::FilterIndices<PointT> {
 public:
  using Ptr = pcl::shared_ptr<NoiseLimitedSampling<PointT>>;
  using ConstPtr = pcl::shared_ptr<const NoiseLimitedSampling<PointT>>;
  using PointCloud = typename pcl::FilterIndices<PointT>::PointCloud;

  /// \param extract_removed_indices true if `getRemovedIndices` will be asked for
  explicit NoiseLimitedSampling(bool extract_removed_indices = false)
      : pcl::FilterIndices<PointT>(extract_removed_indices) {
    this->filter_name_ = "NoiseLimitedSampling";
  }

  /// Standard deviation of the points about their surfaces, length; 0 (default): measured.
  void setNoise(double noise) { noise_ = noise; }
  double getNoise() const { return noise_; }

  /// Points left on a square of the noise's side, q > 0; default 0.5.
  void setPointsPerNoiseArea(double points) { points_per_noise_area_ = points; }
  double getPointsPerNoiseArea() const { return points_per_noise_area_; }

  /// Clouds are never thinned to fewer; default 200,000.
  void setLeastPoints(std::size_t points) { least_points_ = points; }
  std::size_t getLeastPoints() const { return least_points_; }

  /// Takes so many, whatever the noise; 0 (default): derived.
  void setSampleSize(std::size_t points) { sample_size_ = points; }
  std::size_t getSampleSize() const { return sample_size_; }

  /// Number of threads, 0 = all cores (default).
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

 protected:
  using pcl::FilterIndices<PointT>::applyFilter;
  void applyFilter(PointCloud& output) override;
  void applyFilter(pcl::Indices& kept) override;

 private:
  bool inputsValid() const;
  std::size_t sizeFor(const pcl::Indices& finite) const;

  double noise_ = 0.0;
  double points_per_noise_area_ = 0.5;
  std::size_t least_points_ = 200000;
  std::size_t sample_size_ = 0;
  unsigned int threads_ = 0;
  bool failed_ = false;
};

}  // namespace storey

#include <storey/filters/impl/noise_limited_sampling.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::NoiseLimitedSampling<pcl::PointNormal>;
extern template class storey::NoiseLimitedSampling<pcl::PointXYZRGBNormal>;
extern template class storey::NoiseLimitedSampling<pcl::PointXYZINormal>;
extern template class storey::NoiseLimitedSampling<pcl::PointXYZLNormal>;
#endif
