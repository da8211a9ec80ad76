// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace storey {

/// Turns normals of unknown sign so that they point out of the building.
///
/// Walls: the cloud becomes voxels, the wall voxels small flat patches, and each patch sends rays
/// to both of its sides. Rays that get away sideways, that end below a roof, that end at the inner
/// or outer side of another patch, and, as far as the cloud has roofs, those that get away upwards,
/// say which side is outside; all patches are solved for together. So the walls of a courtyard
/// point into it where there are roofs to stop the rays inside the building, or where all its walls
/// were seen. Points in voxels without a common normal (edges, trees) follow the nearest wall of
/// their direction among the 26 voxels around, if there is one. Roofs, slopes and ground, less than
/// 60 degrees from level, point up.
///
/// Only signs change. Only the indexed points are used and turned; those with a non-finite
/// position or normal stay as they are. The result does not depend on the number of threads.
/// \par Complexity O(n) plus about 1000 rays a patch, 72 bytes a point and at most 64 MB of voxels.
/// \par In pcl_viewer
/// `pcl_viewer 01_upright.pcd -normals 10 -normals_scale 0.5`: sticks point away from the building,
/// in a courtyard into it.
template <typename PointT>
class OutwardNormalOrientation : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<OutwardNormalOrientation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const OutwardNormalOrientation<PointT>>;

  /// The up direction, of any length but not zero; default +z.
  void setUp(const Eigen::Vector3d& up) { up_ = up; }
  Eigen::Vector3d getUp() const { return up_; }

  /// Side of a voxel in the cloud's unit, >= 0: walls must be closed at this size, and rooms wider.
  /// 0 (default): the largest of 3 / sqrt(density), 4 noises and extent / 256.
  void setVoxelSize(double size) { voxel_size_ = size; }
  double getVoxelSize() const { return voxel_size_; }

  /// 0 (default) = all cores.
  void setNumberOfThreads(unsigned int nr = 0) { threads_ = nr; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /// \param[out] output a copy of the whole input with the normals turned; empty after a PCL_ERROR
  /// (no input, parameter or index out of range). It may be the input cloud itself.
  void orient(pcl::PointCloud<PointT>& output);

  /// Per input point of the last `orient`: 0 (sign was not decided) to 1.
  const std::vector<float>& getConfidences() const { return confidences_; }

  /// Mean confidence of the points of walls (normal within 30 degrees of level), 0 without any.
  double getConfidence() const { return confidence_; }

 protected:
  std::string getClassName() const { return "OutwardNormalOrientation"; }

 private:
  bool parametersValid() const;
  double voxelSize() const;
  void turn(pcl::PointCloud<PointT>& output);

  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
  double voxel_size_ = 0.0;
  unsigned int threads_ = 0;
  std::vector<float> confidences_;
  double confidence_ = 0.0;
};

}  // namespace storey

#include <storey/features/impl/outward_normal_orientation.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::OutwardNormalOrientation<pcl::PointNormal>;
extern template class storey::OutwardNormalOrientation<pcl::PointXYZRGBNormal>;
extern template class storey::OutwardNormalOrientation<pcl::PointXYZINormal>;
extern template class storey::OutwardNormalOrientation<pcl::PointXYZLNormal>;
#endif
