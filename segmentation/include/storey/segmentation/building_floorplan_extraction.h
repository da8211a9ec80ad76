// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/building_floorplans.h>
#include <storey/segmentation/floorplan.h>

#include <vector>

namespace storey {

/// The dominant floorplans of a building from the walls of all of it at once.
///
/// 1. The wall lines of the whole building are found once, over all heights: an oriented Hough vote
///    of the unsmoothed normals, with the dominant directions taken from the lines.
/// 2. The plan is cut by them into convex cells; where a wall ends in nothing, lines of the other
///    directions are added for walls that were not seen.
/// 3. Heights are cut into layers at change points that all walls share.
/// 4. Inside or outside is decided for all cells by minimum cuts, whose evidence is the signed flux
///    of the oriented points through the cells' sides; which layers form one block is decided with
///    it, as a global optimum (dynamic programming over all partitions).
///
/// So gaps of many kinds close by themselves, and several components, courtyards and overhangs are
/// nothing special. The result has wall ids shared by all blocks, and edges that few points confirm
/// are hypothetical. Heights are good to a few noise deviations: `fitWalls` and `fitHeights` do the
/// rest, as in `LayerwiseMRFReconstruction`.
/// \note Deviation: this replaces stages 4 to 10 of [Sui et al. 2016], which work slice by slice;
/// `LayerwiseFloorplanExtraction` has them [doc/method.md, deviation 14].
///
/// Needs an upright cloud (+z is up) with outward normals; only the indexed points are used, those
/// with a non-finite position or normal are left out. Horizontal points (roofs, ground) count as
/// evidence of what is below and above them.
///
/// \par Complexity O(n lines + layers^2 cuts).
/// Deterministic.
/// \par In pcl_viewer
/// `09_floorplans.vtk` of `storey_reconstruct --intermediate` has the outline of each block at its
/// mid-height, as lines; given `01_upright.pcd` as well they run along the walls' points.
///
/// \image html tutorial_floorplans.png
template <typename PointT>
class BuildingFloorplanExtraction : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<BuildingFloorplanExtraction<PointT>>;
  using ConstPtr = pcl::shared_ptr<const BuildingFloorplanExtraction<PointT>>;

  /// Standard deviation of the points across their walls; 0 (default): estimated from the input.
  void setNoise(double noise) { noise_ = noise; }
  double getNoise() const { return noise_; }

  /// Points per unit of wall area; 0 (default): estimated from the input.
  void setDensity(double density) { density_ = density; }
  double getDensity() const { return density_; }

  /// Least supported area of a wall; 0 (default): the larger of (20 noise)^2 and (extent / 40)^2,
  /// the extent being that of the indexed points of walls, without outliers.
  void setMinWallArea(double square_length) { min_wall_area_ = square_length; }
  double getMinWallArea() const { return min_wall_area_; }

  /// K: the wall area that one more block must explain; 0 (default): the least wall area. Blocks
  /// that do not earn their faces are merged afterwards (`detail::pruneOutlines`).
  void setBlockCost(double square_length) { block_cost_ = square_length; }
  double getBlockCost() const { return block_cost_; }

  /// Limits of the model's size: its faces (as many as the polygons of the solid) and its different
  /// floorplans; 0 (default): none. Where they are exceeded, what a face must explain rises until
  /// they are kept.
  void setMaxFaces(std::size_t max_faces) { limits_.max_faces = max_faces; }
  std::size_t getMaxFaces() const { return limits_.max_faces; }
  void setMaxTypes(std::size_t max_types) { limits_.max_types = max_types; }
  std::size_t getMaxTypes() const { return limits_.max_types; }

  /// Whether the whole trade-off between what is explained and the number of faces is computed
  /// (`getResult().trade_off`), down to the simplest model; default false.
  void setWholeTradeOff(bool whole) { limits_.whole_front = whole; }
  bool getWholeTradeOff() const { return limits_.whole_front; }

  /// 0 (default): all cores. The result is the same for any number.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }

  /// Steps to do without, for experiments; default: none.
  void setSteps(const detail::MethodSteps& steps) { steps_ = steps; }

  /// \param blocks bottom to top, each with its outline
  /// \return false, after a PCL_ERROR, for no input or a bad parameter; false without one if the
  /// points show no building
  bool extract(std::vector<FloorplanLayer>& blocks);

  /// Walls, cells, levels and labels of the last `extract`.
  const detail::BuildingFloorplans& getResult() const { return result_; }

 private:
  bool parametersValid() const;

  double noise_ = 0.0;
  double density_ = 0.0;
  double min_wall_area_ = 0.0;
  double block_cost_ = 0.0;
  detail::SimplicityLimits limits_;
  unsigned int threads_ = 0;
  detail::MethodSteps steps_;
  detail::BuildingFloorplans result_;
};

}  // namespace storey

#include <storey/segmentation/impl/building_floorplan_extraction.hpp>

#ifndef PCL_NO_PRECOMPILE
extern template class storey::BuildingFloorplanExtraction<pcl::PointNormal>;
extern template class storey::BuildingFloorplanExtraction<pcl::PointXYZINormal>;
#endif
