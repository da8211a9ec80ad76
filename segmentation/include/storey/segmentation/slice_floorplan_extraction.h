// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/segment_linking.h>
#include <storey/segmentation/floorplan.h>

#include <string>
#include <vector>

namespace storey {

/// Extracts the floorplan of one slice: Algorithm 1 of [Sui et al. 2016] and its refinements.
///
/// One least-squares line segment for each edge region; segments are linked end to start into
/// closed paths; each path is completed where points are missing (a hypothetical segment, turned
/// about its centre to the nearest dominant direction), adjacent segments are snapped to their
/// intersection, vertices nearer than the tolerance merge, collinear vertices go.
///
/// Segments are oriented by their outward normals, so outer rings come out counter-clockwise,
/// courtyards clockwise, and the two faces of a thin wall never link.
/// \note Deviation: by default the links are the *optimal* cycle cover (the least length of missing
/// wall over all ways to close all segments, a segment being left out at twice its length) instead
/// of the greedy path of Algorithm 1, which goes astray at the first gap; `setLinkingMethod` has
/// both. The result is always valid: rings that cross are resolved by their winding number.
///
/// Needs normals (those of the cloud itself, or `setInputNormals`) and uses x and y only. Points
/// that are not finite are ignored, as all are that are not among the indices. Regions come from
/// `EdgeRegionGrowing`; without `setRegions` the class labels the points with the directions and
/// grows the regions itself, and without `setDirections` it clusters the directions as well.
///
/// \par Complexity O(points + s^3) for s segments. Deterministic.
/// \par In pcl_viewer
/// `09_floorplans.vtk` of `storey_reconstruct --method paper --intermediate` has the outlines of
/// all slices as lines: a stack of rings, of which single ones may be wrong where walls are
/// missing.
///
/// \image html tutorial_floorplans.png
template <typename PointT, typename NormalT = PointT>
class SliceFloorplanExtraction : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<SliceFloorplanExtraction<PointT, NormalT>>;
  using ConstPtr = pcl::shared_ptr<const SliceFloorplanExtraction<PointT, NormalT>>;
  using PointCloudN = pcl::PointCloud<NormalT>;
  using LinkingMethod = detail::LinkingMethod;

  SliceFloorplanExtraction() = default;

  /// Normals of all points of the input cloud (not of the indices). Default: the input itself.
  void setInputNormals(const typename PointCloudN::ConstPtr& normals) { normals_ = normals; }
  typename PointCloudN::ConstPtr getInputNormals() const { return normals_; }

  /// Edge regions and, parallel to them, the index of their direction; -1 if it has none.
  /// Indices refer to the input cloud; the regions take the place of `setIndices`.
  void setRegions(const std::vector<pcl::PointIndices>& regions, const std::vector<int>& labels) {
    regions_ = regions;
    region_labels_ = labels;
    has_regions_ = true;
  }

  /// Dominant directions, horizontal unit vectors (x, y, z with z = 0), outwards.
  void setDirections(const std::vector<Eigen::Vector3d>& directions) { directions_ = directions; }
  const std::vector<Eigen::Vector3d>& getDirections() const { return directions_; }

  /// Standard deviation of the points across their walls; 0 (default): that of the points about the
  /// segments fitted to their regions.
  void setNoise(double noise) { noise_ = noise; }
  double getNoise() const { return noise_; }

  /// Vertices nearer than this merge, and parallel neighbours closer than this are one wall; 0
  /// (default): 2.5 noise deviations.
  void setTolerance(double length) { tolerance_ = length; }
  double getTolerance() const { return tolerance_; }

  /// Threshold t of Algorithm 1: the greedy path goes on to a segment nearer than t, and what it
  /// has gathered is then closed, however wide the last gap. The optimal cover charges a link
  /// across more than t with both its segments' length, so that it is made only where leaving
  /// walls out would cost more. 0 (default): no limit.
  void setMaxGap(double length) { max_gap_ = length; }
  double getMaxGap() const { return max_gap_; }

  /// Components and courtyards with less area are dropped; 0 (default): (10 noise)^2.
  void setMinArea(double square_length) { min_area_ = square_length; }
  double getMinArea() const { return min_area_; }

  void setLinkingMethod(LinkingMethod method) { method_ = method; }
  LinkingMethod getLinkingMethod() const { return method_; }

  /// Extracts the floorplan of the slice. False, with an empty floorplan and the reason in
  /// `getFailure`, if no closed component was found; with a PCL_ERROR as well for no input, a bad
  /// parameter, an index outside the cloud, or normals or labels that are not parallel to what
  /// they belong to.
  bool extract(Floorplan& floorplan);

  /// Why the last `extract` failed; empty if it did not.
  const std::string& getFailure() const { return failure_; }

  /// The line segments of the last `extract`.
  const std::vector<detail::LineSegment>& getSegments() const { return segments_; }

 protected:
  const char* getClassName() const { return "SliceFloorplanExtraction"; }

 private:
  bool fail(const std::string& reason);
  bool parametersValid() const;
  bool growRegions();
  void fitSegments();
  double noiseOfSegments() const;
  void keepLines(double noise);
  bool linkAndClose(double noise, Floorplan& floorplan);

  typename PointCloudN::ConstPtr normals_;
  std::vector<pcl::PointIndices> regions_;
  std::vector<int> region_labels_;
  bool has_regions_ = false;
  std::vector<Eigen::Vector3d> directions_;
  double noise_ = 0.0;
  double tolerance_ = 0.0;
  double max_gap_ = 0.0;
  double min_area_ = 0.0;
  LinkingMethod method_ = LinkingMethod::Optimal;
  std::vector<detail::LineSegment> segments_;
  std::string failure_;
};

}  // namespace storey

#include <storey/segmentation/impl/slice_floorplan_extraction.hpp>

#ifndef PCL_NO_PRECOMPILE
extern template class storey::SliceFloorplanExtraction<pcl::PointNormal>;
extern template class storey::SliceFloorplanExtraction<pcl::PointXYZINormal>;
#endif
