// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <pcl/search/search.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/circular_clustering.h>
#include <storey/segmentation/detail/oriented_points.h>

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace storey {

/// Finds the dominant directions of a building's walls by hierarchical clustering of the normals
/// [Sui et al. 2016, Sec. 3.1]: every point starts as a cluster with its normal as centre, the two
/// closest centres merge at their weighted mean, until the closest pair is further apart than the
/// merge angle. Directions are oriented: n and -n are two, a box has four. Up is +z; the attitude
/// is adjusted before.
///
/// Normals may be as noisy as those of multi-view stereo (15 degrees): they are averaged over
/// neighbours first, over those within 60 degrees of the point's own normal, so that the two faces
/// of a thin wall do not cancel. Each centre ends at a robust mean of the averaged normals
/// around it: at corners averages lie between two directions, and would pull a plain mean.
///
/// \note Deviation: horizontal normals only, on a histogram of bins of 0.1 degree: the same
/// clusters up to the width of a bin in O(n) instead of O(n^2).
/// \note Deviation: given the directions, a point belongs to the nearest of them (within 30
/// degrees), not to the cluster whose merging it took part in.
///
/// Only the points of `setIndices` are seen, as a set. Points with a non-finite position, a normal
/// that is zero or not finite, or one further from the horizontal than the largest tilt, are in no
/// cluster. Copies of one position count as one neighbour, with their mean normal.
///
/// \tparam PointT needs x, y, z
/// \tparam NormalT needs normal_x, normal_y, normal_z (of any length > 0)
/// \par Complexity O(n) and O(min(n, max samples)) searches of neighbours. Deterministic; the
/// order of the input does not matter.
/// \par In pcl_viewer
/// `storey_dominant_directions` writes the direction as `label`, 0 = none: a wall is of one colour,
/// its opposite of another.
///
/// \image html tutorial_directions.png
template <typename PointT, typename NormalT = PointT>
class DominantDirectionClustering : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<DominantDirectionClustering<PointT, NormalT>>;
  using ConstPtr = pcl::shared_ptr<const DominantDirectionClustering<PointT, NormalT>>;
  using NormalsConstPtr = typename pcl::PointCloud<NormalT>::ConstPtr;
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  static constexpr int kDefaultNeighbors = 30;  // 15 degrees of noise become 2
  static constexpr std::size_t kDefaultMaxSamples = 20000;

  /// Normals, one for each point of the input cloud (not of the indices). Null (default): the
  /// fields of the input cloud, if PointT is NormalT.
  void setInputNormals(const NormalsConstPtr& normals) { normals_ = normals; }
  NormalsConstPtr getInputNormals() const { return normals_; }

  /// The search of neighbours; its input cloud is replaced. Null (default): a k-d tree.
  void setSearchMethod(const SearchPtr& tree) { tree_ = tree; }
  SearchPtr getSearchMethod() const { return tree_; }

  /// Threads for the averaging; 0 (default) = all cores. The result does not depend on it.
  void setNumberOfThreads(unsigned int nr = 0) { threads_ = nr; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /// Neighbours, the point included, that a normal is averaged over; >= 1, default 30; 1 leaves the
  /// normals as they are. Noise falls with the square root: 30 separate directions 36 degrees
  /// apart, 60-120 such 10-15 degrees apart, at 15 degrees of noise.
  void setSmoothingNeighbors(int k) { smoothing_neighbors_ = k; }
  int getSmoothingNeighbors() const { return smoothing_neighbors_; }

  /// Points whose normals are averaged and clustered; 0 = all, default 20,000: then the least
  /// direction, 2 % of them, is the mean of 400 averages good to 3 degrees each. They are chosen
  /// evenly at random (by a hash of position and normal), their neighbours come from the whole
  /// cloud. All other points are assigned to the directions by the normal given.
  void setMaxSamples(std::size_t num_points) { max_samples_ = num_points; }
  std::size_t getMaxSamples() const { return max_samples_; }

  /// Merging stops when the closest centres are further apart than this: radians within (0, pi), or
  /// 0 (default): 4 standard deviations of the normals of one wall (measured at the highest
  /// mode of the histogram) within [5, 25] degrees. What is cut off a normally distributed wall
  /// with its centre 4 deviations away is 1e-4 of it.
  void setMergeAngle(double radians) { merge_angle_ = radians; }
  double getMergeAngle() const { return merge_angle_; }
  /// The merge angle of the last run, given or derived; 0 if there was none.
  double getUsedMergeAngle() const { return used_merge_angle_; }

  /// Largest angle between a wall's normal and the horizontal, radians within (0, pi/2]; default 35
  /// degrees, as in `GravitySlicing`.
  void setMaxTilt(double radians) { max_tilt_ = radians; }
  double getMaxTilt() const { return max_tilt_; }

  /// Least share of the clustered wall points that makes a direction; within [0, 1], default 0.02.
  /// With 12 directions the mean share is 0.08, and the shortest wall may be a quarter of the mean;
  /// the points at corners, 0.08 in all, are spread over as many corners as there are directions.
  void setMinClusterShare(double share) { min_cluster_share_ = share; }
  double getMinClusterShare() const { return min_cluster_share_; }

  /// Least and greatest number of points of a cluster; default 1 and no limit. Directions of other
  /// clusters are dropped, and their points are in no cluster.
  void setMinClusterSize(std::size_t num_points) { min_cluster_size_ = num_points; }
  std::size_t getMinClusterSize() const { return min_cluster_size_; }
  void setMaxClusterSize(std::size_t num_points) { max_cluster_size_ = num_points; }
  std::size_t getMaxClusterSize() const { return max_cluster_size_; }

  /// \param clusters for each direction the indices of its points, ascending, with the header
  /// of the input; the largest cluster first, of equal ones that with the smaller first index. A
  /// bad parameter, an index outside the cloud, missing normals or no input: a PCL_ERROR and no
  /// clusters.
  void extract(std::vector<pcl::PointIndices>& clusters);

  /// The directions of the last run, parallel to its clusters: horizontal unit vectors that point
  /// out of the walls, as the normals do.
  const std::vector<Eigen::Vector3d>& getDirections() const { return directions_; }

 protected:
  const char* getClassName() const { return "DominantDirectionClustering"; }

 private:
  bool parametersValid() const;
  void clusterPoints(const pcl::PointCloud<NormalT>& normals,
                     std::vector<pcl::PointIndices>& clusters);
  std::vector<std::size_t> chooseSample(const detail::LabelPoints<Eigen::Vector3f>& points) const;
  void averageNormals(const std::vector<std::size_t>& sample,
                      detail::LabelPoints<Eigen::Vector3f>& points) const;
  std::vector<Eigen::Vector3d> findDirections(const detail::AngleHistogram& histogram);
  std::vector<pcl::PointIndices> assignPoints(const detail::LabelPoints<Eigen::Vector3f>& points,
                                              const std::vector<Eigen::Vector3d>& directions) const;
  void keepClusters(const std::vector<Eigen::Vector3d>& directions,
                    std::vector<pcl::PointIndices>& found,
                    std::vector<pcl::PointIndices>& clusters);

  NormalsConstPtr normals_;
  SearchPtr tree_;
  unsigned int threads_ = 0;
  int smoothing_neighbors_ = kDefaultNeighbors;
  std::size_t max_samples_ = kDefaultMaxSamples;
  double merge_angle_ = 0.0;      // rad
  double max_tilt_ = 0.61086524;  // rad
  double min_cluster_share_ = 0.02;
  std::size_t min_cluster_size_ = 1;
  std::size_t max_cluster_size_ = std::numeric_limits<std::size_t>::max();
  double used_merge_angle_ = 0.0;  // rad
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace storey

#include <storey/segmentation/impl/dominant_direction_clustering.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::DominantDirectionClustering<pcl::PointNormal>;
extern template class storey::DominantDirectionClustering<pcl::PointXYZRGBNormal>;
extern template class storey::DominantDirectionClustering<pcl::PointXYZINormal>;
extern template class storey::DominantDirectionClustering<pcl::PointXYZLNormal>;
#endif
