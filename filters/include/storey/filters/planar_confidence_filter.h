// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/filters/filter_indices.h>
#include <pcl/point_types.h>
#include <pcl/search/search.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/eigen_alignment.h>

#include <limits>
#include <vector>

namespace storey {

/// Removes non-planar regions (trees, railings, noise): keeps the points whose planar confidence
///
///     k = 1 - exp(-0.02 (l1 + l2 + l3) / l3)        [Sui et al. 2016, Sec. 3.1]
///
/// reaches a threshold T_k. l1 >= l2 >= l3 are the eigenvalues of the covariance of the K = 30
/// nearest positions, the point's own among them; k lies in (0, 1], 1 = planar. By default T_k is
/// the value that 85 % of the points reach; it measures the quality of the data (about 0.1 for
/// noise as large as the spacing, above 0.9 for good clouds).
///
/// Points of `setIndices` are judged, their neighbours are sought in the whole input.
/// - k = 1 where l3 = 0: points exactly on a plane or line.
/// - Points at the same position count once as neighbours: copies say nothing about the shape, and
///   a million of them cost no more than others.
/// - k = 0 where the whole input has fewer than 4 distinct positions.
/// - Points with a non-finite coordinate, or one beyond 1e18, have no confidence (NaN) and are
///   always removed, also under `setNegative(true)`. Normals are not looked at.
/// - The output of `filter(cloud)` is dense, except under `setKeepOrganized(true)`.
///
/// A bad parameter or an index outside the cloud gives a PCL_ERROR and an empty result.
/// \tparam PointT needs x, y, z
/// \par Complexity O(n log n) time, about 80 bytes a point. The result has the same bytes for any
/// number of threads; the order of the indices is kept.
/// \par In pcl_viewer
/// `storey_planar_confidence IN OUT.pcd` keeps all points, with k as `intensity`: press a number
/// key until it is shown, `u` for the scale. Walls are even; edges of the building, trees and
/// railings stand out as low values.
///
/// \image html tutorial_confidence.png
template <typename PointT>
class PlanarConfidenceFilter : public pcl::FilterIndices<PointT> {
 public:
  using Ptr = pcl::shared_ptr<PlanarConfidenceFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const PlanarConfidenceFilter<PointT>>;
  using PointCloud = typename pcl::FilterIndices<PointT>::PointCloud;
  using Search = pcl::search::Search<PointT>;
  using SearchPtr = typename Search::Ptr;

  /// \param extract_removed_indices true if `getRemovedIndices` will be asked for
  explicit PlanarConfidenceFilter(bool extract_removed_indices = false);

  /// Number of nearest positions K, at least 4; default 30 [Sui et al. 2016, Sec. 3.1]. Where the
  /// cloud has fewer, all are taken.
  void setKSearch(int k) { k_ = k; }
  int getKSearch() const { return k_; }

  /// Share of the points to keep, within (0, 1]; default 0.85. Undoes `setThreshold`.
  void setKeptShare(double share);
  double getKeptShare() const { return kept_share_; }

  /// Keeps the points with k >= threshold, within [0, 1], in place of a share.
  void setThreshold(double threshold);

  /// The threshold that was set, else the T_k of the last run; NaN before, or without points.
  double getThreshold() const { return threshold_; }

  /// A search to use in place of our own (`detail/neighbor_search.h`, ten times as fast as a k-d
  /// tree). It is given the input unless it has it. Not used where the input has duplicates or
  /// non-finite points, which it might not stand; an exact search gives the same result, except
  /// where it decides otherwise between positions equally far.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  SearchPtr getSearchMethod() const { return search_; }

  /// Number of threads, 0 = all cores (default).
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /// Confidences of the last run, parallel to `getIndices()`; NaN for non-finite points.
  const std::vector<double>& getConfidences() const { return confidences_; }

 protected:
  using pcl::FilterIndices<PointT>::applyFilter;
  void applyFilter(PointCloud& output) override;
  void applyFilter(pcl::Indices& kept) override;

 private:
  bool inputsValid() const;
  void computeConfidences();
  std::vector<double> confidencesOf(const detail::DistinctPositions& distinct);
  void chooseThreshold();

  int k_ = 30;  // points, [Sui et al. 2016, Sec. 3.1]
  double kept_share_ = 0.85;
  bool threshold_is_fixed_ = false;
  double threshold_ = std::numeric_limits<double>::quiet_NaN();
  unsigned int threads_ = 0;
  SearchPtr search_;
  std::vector<double> confidences_;
  bool failed_ = false;
};

}  // namespace storey

#include <storey/filters/impl/planar_confidence_filter.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::PlanarConfidenceFilter<pcl::PointNormal>;
extern template class storey::PlanarConfidenceFilter<pcl::PointXYZRGBNormal>;
extern template class storey::PlanarConfidenceFilter<pcl::PointXYZINormal>;
extern template class storey::PlanarConfidenceFilter<pcl::PointXYZLNormal>;
#endif
