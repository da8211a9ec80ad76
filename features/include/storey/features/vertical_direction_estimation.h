// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>

#include <Eigen/Geometry>
#include <string>

namespace storey {

/// How well the vertical is known.
struct VerticalQuality {
  double wall_share = 0.0;    ///< share of the normals within 6 degrees of horizontal
  double second_score = 0.0;  ///< the largest such share for a direction 30 degrees or more away
  double deviation = 0.0;     ///< standard deviation of the tilt, rad; 0: not known
  int patches = 0;            ///< pieces of wall that the positions were fitted to
  bool one_wall_direction = false;  ///< all walls are parallel: only one angle comes from them
};

/// Finds the vertical of a building from its walls [Sui et al. 2016, 3.1; doc/method.md, stage 1]:
/// 1. Start: `setInitialUp`; without it +z, unless fewer than 0.8 times as many normals agree with
///    it (within 12 degrees of horizontal or 26 of vertical) as lie within 6 degrees across the
///    best of 4000 evenly spread directions; then that direction.
/// 2. The up vector across which the wall normals lie best, iterated with Tukey's weights.
/// 3. The up vector that lies best in planes fitted to upright columns of wall points. Noise of
///    normals leaves 0.04 to 0.1 degrees in step 2, this step about 0.002.
///
/// If all walls face one way, as a single facade does, they determine one of the two angles; the
/// other comes from level points (within 25 degrees of up), without those from the start, with a
/// PCL_WARN.
/// \note Walls cannot tell up from down: of the two ends of the axis, the result is the one nearer
/// to the initial up, or to +z.
/// \note From the air, roofs and ground outnumber the walls, and many horizontal directions have
/// more normals across them than the vertical has. Such a cloud whose up is far from +z needs
/// `setInitialUp`.
///
/// Needs finite normals of any sign; other points are left out. Only the indexed points are used.
/// The result does not depend on the number of threads.
/// \par Complexity O(n log n) time (sorting into columns), about 64 bytes a point.
/// \par In pcl_viewer
/// `ALT+2` shows the normals as points of a sphere: after `storey_vertical` those of walls lie on
/// its equator.
template <typename PointT, typename NormalT = PointT>
class VerticalDirectionEstimation : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<VerticalDirectionEstimation<PointT, NormalT>>;
  using ConstPtr = pcl::shared_ptr<const VerticalDirectionEstimation<PointT, NormalT>>;
  using PointCloudN = pcl::PointCloud<NormalT>;
  using PointCloudNConstPtr = typename PointCloudN::ConstPtr;

  /// Normals parallel to the input cloud. Default: those of the input cloud itself.
  void setInputNormals(const PointCloudNConstPtr& normals) { normals_ = normals; }
  PointCloudNConstPtr getInputNormals() const { return normals_; }

  /// A direction within about 15 degrees of up, of any length. Zero (default): see step 1.
  void setInitialUp(const Eigen::Vector3d& up) { initial_up_ = up; }
  Eigen::Vector3d getInitialUp() const { return initial_up_; }

  /// Side of the columns of step 3 in the cloud's unit, >= 0. 0 (default): the larger of 12 times
  /// the noise and 6 times the spacing of the points.
  void setColumnSize(double size) { column_size_ = size; }
  double getColumnSize() const { return column_size_; }

  /// 0 (default) = all cores.
  void setNumberOfThreads(unsigned int nr = 0) { threads_ = nr; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /// \param[out] up unit; on failure the initial up or +z
  /// \return false, after a PCL_ERROR, if there are fewer than 3 usable points, no normals, or a
  /// parameter is out of range
  bool compute(Eigen::Vector3d& up);

  /// The up vector of the last `compute`.
  Eigen::Vector3d getUp() const { return up_; }

  /// The smallest rotation that brings the up vector of the last `compute` to +z.
  Eigen::Quaterniond getRotation() const {
    return Eigen::Quaterniond::FromTwoVectors(up_, Eigen::Vector3d::UnitZ());
  }

  VerticalQuality getQuality() const { return quality_; }

  /// In [0, 1]: wall share over the sum of it and the second score, so 1/2 where another direction
  /// is as good. 0 before the first `compute`.
  double getConfidence() const;

 protected:
  std::string getClassName() const { return "VerticalDirectionEstimation"; }

 private:
  bool inputValid();
  double columnSize() const;

  PointCloudNConstPtr normals_;
  Eigen::Vector3d initial_up_ = Eigen::Vector3d::Zero();
  double column_size_ = 0.0;
  unsigned int threads_ = 0;
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
  VerticalQuality quality_;
};

}  // namespace storey

#include <storey/features/impl/vertical_direction_estimation.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::VerticalDirectionEstimation<pcl::PointNormal>;
extern template class storey::VerticalDirectionEstimation<pcl::PointXYZRGBNormal>;
extern template class storey::VerticalDirectionEstimation<pcl::PointXYZINormal>;
extern template class storey::VerticalDirectionEstimation<pcl::PointXYZLNormal>;
extern template class storey::VerticalDirectionEstimation<pcl::PointXYZ, pcl::Normal>;
#endif
