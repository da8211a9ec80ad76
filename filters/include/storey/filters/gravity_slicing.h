// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace storey {

/// Cuts a building into horizontal slices of equal thickness [Sui et al. 2016, Sec. 3.1]. Up is +z:
/// the attitude is adjusted before.
///
/// \note Deviation: points of roofs, terraces and ground are left out by their normals, for on the
/// horizontal plane they would fill the building's inside [doc/method.md, deviation 10].
///
/// Only the points of `setIndices` are seen. The slices lie between the 0.1 % and the 99.9 %
/// quantile of z of the wall points, widened by 5 % of their distance on both sides (but not beyond
/// the lowest and highest of them): so a few ghost points far below or above add no slices. Points
/// beyond belong to no slice, nor do those with a non-finite coordinate. Slices without points stay
/// in the list, so that slice i always is at height i.
///
/// \tparam PointT needs x, y, z and normal_x, normal_y, normal_z (of any length > 0)
/// \par Complexity O(n), and O(n log n) where the thickness is derived. Deterministic.
/// \par In pcl_viewer
/// `storey_slices` writes the slice as `label`: bands of one thickness, each in a colour; roofs and
/// ground have none.
///
/// \image html tutorial_slices.png
template <typename PointT>
class GravitySlicing : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<GravitySlicing<PointT>>;
  using ConstPtr = pcl::shared_ptr<const GravitySlicing<PointT>>;
  using Range = std::pair<double, double>;  ///< z_min <= z < z_max; the topmost holds z_max too

  static constexpr std::size_t kMaxSlices = 10000;

  /// Thickness in the cloud's unit, >= 0; 0 (default) derives it from the wall points:
  /// max(10 noise, 30 / (density x shortest wall)), so that a slice is thick against the noise and
  /// holds 30 points of a wall of extent / 50, our guess of the shortest that counts. (`CloudScale`
  /// defines the three.) The derived value is then stretched to fit a whole number of slices, 1000
  /// at most. A given one is kept, the last slice may reach above the highest point. More than
  /// kMaxSlices slices are an error.
  void setSliceThickness(double thickness) { thickness_ = thickness; }

  /// The thickness used in the last run; before it, the one set. 0 after a run whose points all
  /// have one height, or that had none.
  double getSliceThickness() const { return has_run_ ? used_thickness_ : thickness_; }

  /// Largest angle between a wall point's normal and the horizontal, in radians within (0, pi/2];
  /// default 35 degrees. With noise of 15 degrees on normals this keeps 98 % of a vertical wall's
  /// points and lets 0.1 % of a flat roof's through (exp(-55^2 / (2 x 15^2))). At 45 degrees it
  /// would be 99.7 % and 1.1 %, and a roof has many points: those few then outnumber the 2 %
  /// gained.
  void setMaxTilt(double radians) { max_tilt_ = radians; }
  double getMaxTilt() const { return max_tilt_; }

  /// Whether points whose normal is zero or not finite are taken for wall points; default no.
  void setKeepPointsWithoutNormals(bool keep) { keep_points_without_normals_ = keep; }
  bool getKeepPointsWithoutNormals() const { return keep_points_without_normals_; }

  /// Indices of the points of each slice, bottom to top, ascending, referring to the input cloud.
  /// A bad parameter, an index outside the cloud, or no input gives a PCL_ERROR and no slices; a
  /// cloud without wall points gives no slices.
  void extract(std::vector<pcl::PointIndices>& slices);

  /// Heights of the slices of the last run, parallel to them.
  const std::vector<Range>& getSliceRanges() const { return ranges_; }

 private:
  const char* getClassName() const { return "GravitySlicing"; }
  bool inputsValid() const;
  bool isWallPoint(const PointT& p) const;
  pcl::Indices findWallPoints() const;
  bool layOutSlices(const pcl::Indices& wall_points);
  void distribute(const pcl::Indices& wall_points, std::vector<pcl::PointIndices>& slices) const;

  double thickness_ = 0.0;
  double max_tilt_ = 0.61086524;  // rad
  bool keep_points_without_normals_ = false;
  bool has_run_ = false;
  double used_thickness_ = 0.0;
  std::vector<Range> ranges_;
};

/// Projects a slice onto the horizontal plane at height `z` [Sui et al. 2016, Sec. 3.1]: copies its
/// points in order, sets their z, and turns their normals into horizontal unit vectors. A normal
/// without horizontal part becomes NaN. The header is copied. An index outside the cloud gives a
/// PCL_ERROR and an empty result.
/// \tparam PointT needs x, y, z and normal_x, normal_y, normal_z
template <typename PointT>
void projectSlice(const pcl::PointCloud<PointT>& cloud, const pcl::PointIndices& slice, double z,
                  pcl::PointCloud<PointT>& flat);

}  // namespace storey

#include <storey/filters/impl/gravity_slicing.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::GravitySlicing<pcl::PointNormal>;
extern template class storey::GravitySlicing<pcl::PointXYZRGBNormal>;
extern template class storey::GravitySlicing<pcl::PointXYZINormal>;
extern template class storey::GravitySlicing<pcl::PointXYZLNormal>;
#endif
