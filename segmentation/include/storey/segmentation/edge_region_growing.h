// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/unlabeled.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey {

/// Groups the points of a slice into edge regions, the pieces of walls that become one line segment
/// each [Sui et al. 2016, Sec. 3.3]: the connected components of the graph that links points of
/// equal label (direction) whose distance in space is at most the radius. Exact.
///
/// Only the points of `setIndices` are seen. Points with a non-finite position or the label
/// `storey::kUnlabeled` are in no region.
///
/// \tparam PointT needs x, y, z
/// \par Complexity O(n log n) whatever the density. One thread; objects in different threads do not
/// disturb each other. Deterministic; the order of the input does not matter.
/// \par In pcl_viewer
/// `07_regions.pcd` is coloured by `label`: each piece of wall of each slice has a colour, which
/// changes at corners and gaps.
template <typename PointT>
class EdgeRegionGrowing : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<EdgeRegionGrowing<PointT>>;
  using ConstPtr = pcl::shared_ptr<const EdgeRegionGrowing<PointT>>;
  using LabelsConstPtr = pcl::PointCloud<pcl::Label>::ConstPtr;

  /// One label for each of the indices, in their order, as `DominantDirectionLabeling` gives them.
  void setLabels(const LabelsConstPtr& labels) { labels_ = labels; }
  LabelsConstPtr getLabels() const { return labels_; }

  /// Greatest distance of linked points in the cloud's unit, >= 0; 0 (default) derives it: 3 times
  /// the median distance to the 8th neighbour. Points in a row have 4 of the 8 on each side, so
  /// that this is 12 times their mean distance, and a gap as long is e^-12 unlikely at each of
  /// them.
  void setRadius(double radius) { radius_ = radius; }
  double getRadius() const { return radius_; }
  /// The radius of the last run, given or derived; 0 if there was none.
  double getUsedRadius() const { return used_radius_; }

  /// Least number of points of a region; default 10, a third of the 30 that a slice is made to
  /// have on the shortest wall (`GravitySlicing`), the rest may be hidden.
  void setMinRegionSize(std::size_t num_points) { min_region_size_ = num_points; }
  std::size_t getMinRegionSize() const { return min_region_size_; }

  /// \param regions their indices ascending, with the header of the input; the largest region
  /// first, of equal ones that with the smaller first index. A bad parameter, an index outside the
  /// cloud, labels that are missing or not as many as the indices, or no input: a PCL_ERROR and no
  /// regions.
  void extract(std::vector<pcl::PointIndices>& regions);

  /// The label of each region of the last run.
  const std::vector<std::uint32_t>& getRegionLabels() const { return region_labels_; }

 protected:
  const char* getClassName() const { return "EdgeRegionGrowing"; }

 private:
  bool parametersValid() const;
  void growRegions(std::vector<pcl::PointIndices>& regions);
  double deriveRadius(const pcl::Indices& points) const;
  void keepRegions(std::vector<pcl::PointIndices>& found, const std::vector<std::uint32_t>& labels,
                   std::vector<pcl::PointIndices>& regions);

  LabelsConstPtr labels_;
  double radius_ = 0.0;
  double used_radius_ = 0.0;
  std::size_t min_region_size_ = 10;
  std::vector<std::uint32_t> region_labels_;
};

}  // namespace storey

#include <storey/segmentation/impl/edge_region_growing.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::EdgeRegionGrowing<pcl::PointNormal>;
extern template class storey::EdgeRegionGrowing<pcl::PointXYZRGBNormal>;
extern template class storey::EdgeRegionGrowing<pcl::PointXYZINormal>;
extern template class storey::EdgeRegionGrowing<pcl::PointXYZLNormal>;
#endif
