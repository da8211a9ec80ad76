// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/wall_input.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey {

/// Extracts the walls of a building: the vertical planes that its oriented points lie on, each with
/// the points that are of it. Lines in plan are found over all heights at once by an oriented Hough
/// vote of the unsmoothed normals, with the dominant directions taken from the lines, and fitted
/// robustly (`detail::findWallLines`). Parallel walls are told apart down to 2.5 noise deviations
/// where they lie at different places or heights; trees and other clutter give no walls. The two
/// faces of a free-standing wall are two walls.
///
/// Needs an upright cloud (+z is up) with outward normals; only the indexed points are used, those
/// with a non-finite position or normal are of no wall. `BuildingFloorplanExtraction` makes
/// floorplans of the same lines.
/// \tparam PointT needs x, y, z, normal_x, normal_y, normal_z
/// \par Complexity O(n walls). Deterministic.
/// \par In pcl_viewer
/// `storey_walls IN OUT.pcd` writes the wall as `label`, 0 = none: each plane has a colour of its
/// own, also where windows interrupt it; `storey_view` draws the walls as `09_walls.geojson` has
/// them.
template <typename PointT>
class WallExtraction : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<WallExtraction<PointT>>;
  using ConstPtr = pcl::shared_ptr<const WallExtraction<PointT>>;

  /// Standard deviation of the points across their walls, in the cloud's unit; 0 (default):
  /// estimated from the input.
  void setNoise(double noise) { parameters_.noise = noise; }
  double getNoise() const { return parameters_.noise; }

  /// Points per unit of wall area; 0 (default): estimated from the input.
  void setDensity(double density) { parameters_.density = density; }
  double getDensity() const { return parameters_.density; }

  /// Least area of a wall that has points; 0 (default): the larger of (20 noise)^2 and
  /// (extent / 40)^2, the extent being that of the indexed points of walls, without outliers.
  void setMinWallArea(double square_length) { parameters_.min_wall_area = square_length; }
  double getMinWallArea() const { return parameters_.min_wall_area; }

  /// 0 (default): all cores. The result is the same for any number.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }

  /// \param walls points of each wall, ascending and disjoint, with the header of the input; the
  /// wall with most points first. Empty for no input, a bad parameter or an index outside the
  /// cloud, each after a PCL_ERROR, and where there are no walls.
  void extract(std::vector<pcl::PointIndices>& walls);

  /// The lines of the walls of the last `extract`, parallel to its clusters: the plane is
  /// normal . (x, y) = offset, the normal outwards.
  const std::vector<detail::WallLine>& getLines() const { return lines_; }

 protected:
  const char* getClassName() const { return "WallExtraction"; }

 private:
  bool parametersValid() const;

  detail::WallParameters parameters_;
  unsigned int threads_ = 0;
  std::vector<detail::WallLine> lines_;
};

}  // namespace storey

#include <storey/segmentation/impl/wall_extraction.hpp>

#ifndef PCL_NO_PRECOMPILE
extern template class storey::WallExtraction<pcl::PointNormal>;
extern template class storey::WallExtraction<pcl::PointXYZRGBNormal>;
extern template class storey::WallExtraction<pcl::PointXYZINormal>;
extern template class storey::WallExtraction<pcl::PointXYZLNormal>;
#endif
