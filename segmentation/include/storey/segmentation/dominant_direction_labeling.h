// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <pcl/search/search.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/detail/alpha_expansion.h>
#include <storey/segmentation/detail/oriented_points.h>
#include <storey/segmentation/detail/unlabeled.h>

#include <Eigen/Core>
#include <vector>

namespace storey {

/// Gives every point of a slice one of the dominant directions C, smoothly over neighbours: the
/// labels l_i in C that minimise [Sui et al. 2016, (4)-(6)]
///
///     E = sum_i |l_i - n_i|^2  +  lambda sum_i sum_{j in N_i} [ l_i != l_j ]
///
/// n_i is taken as a unit vector, N_i are the k nearest points of the slice; a pair that is mutual
/// pays twice. Minimised by iterated conditional modes and alpha-expansion.
///
/// \note Deviation: a graph cut over points would cost more than all other stages. Points of one
/// cell that are nearest to the same direction (so that the two faces of a thin wall stay apart)
/// are one node of the cut, with summed costs and weights; the result is then improved point by
/// point. `setPerPoint(true)` cuts the graph of the points.
///
/// Only the points of `setIndices` are seen; a slice is such a subset. Points with a non-finite
/// position, or a normal that is zero or not finite, get the label `storey::kUnlabeled` and are
/// nobody's neighbours. Copies of one position are linked to the first of them.
///
/// \tparam PointT needs x, y, z
/// \tparam NormalT needs normal_x, normal_y, normal_z (of any length > 0)
/// \par Complexity O(n k) and n searches of neighbours. One thread; objects in different threads
/// do not disturb each other, so that slices can be labelled in parallel. Deterministic.
/// \par In pcl_viewer
/// `06_labels.pcd` is coloured by `label`: like the dominant directions, but without single points
/// of another colour within a wall.
template <typename PointT, typename NormalT = PointT>
class DominantDirectionLabeling : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<DominantDirectionLabeling<PointT, NormalT>>;
  using ConstPtr = pcl::shared_ptr<const DominantDirectionLabeling<PointT, NormalT>>;
  using NormalsConstPtr = typename pcl::PointCloud<NormalT>::ConstPtr;
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Normals, one for each point of the input cloud (not of the indices). Null (default): the
  /// fields of the input cloud, if PointT is NormalT.
  void setInputNormals(const NormalsConstPtr& normals) { normals_ = normals; }
  NormalsConstPtr getInputNormals() const { return normals_; }

  /// The search of neighbours; its input cloud is replaced. Null (default): a k-d tree.
  void setSearchMethod(const SearchPtr& tree) { tree_ = tree; }
  SearchPtr getSearchMethod() const { return tree_; }

  /// C: the directions, finite vectors of length > 0 (made unit vectors), at least one.
  void setDirections(const std::vector<Eigen::Vector3d>& directions) { directions_ = directions; }
  const std::vector<Eigen::Vector3d>& getDirections() const { return directions_; }

  /// Weight of a pair of neighbours with different labels, >= 0, without unit; default 1.
  void setLambda(double lambda) { lambda_ = lambda; }
  double getLambda() const { return lambda_; }

  /// Number of neighbours of a point, >= 1; default 8.
  void setKSearch(int k) { k_ = k; }
  int getKSearch() const { return k_; }

  /// Side of the cells in the cloud's unit, >= 0; 0 (default) derives it from the distance to
  /// the k-th neighbour, for about 20 points a cell.
  void setCellSize(double side) { cell_size_ = side; }
  double getCellSize() const { return cell_size_; }
  /// The side used in the last run, given or derived; 0 without cells.
  double getUsedCellSize() const { return used_cell_size_; }

  /// Whether every point is a node of the graph cut; default no (cells are).
  void setPerPoint(bool per_point) { per_point_ = per_point; }
  bool getPerPoint() const { return per_point_; }

  /// \param labels for each of the indices, in their order, the number of its direction, or
  /// `kUnlabeled`. A bad parameter, an index outside the cloud, missing normals or no input: a
  /// PCL_ERROR and no labels.
  void segment(pcl::PointCloud<pcl::Label>& labels);

  /// E of the labels of the last run, on the graph of the points; 0 if there was none.
  double getEnergy() const { return energy_; }

 protected:
  const char* getClassName() const { return "DominantDirectionLabeling"; }

 private:
  bool parametersValid() const;
  void labelPoints(const detail::LabelPoints<Eigen::Vector3d>& points,
                   pcl::PointCloud<pcl::Label>& labels);
  detail::PottsProblem makeProblem(const detail::LabelPoints<Eigen::Vector3d>& points,
                                   double& spacing) const;
  std::vector<std::size_t> minimizeOverCells(const detail::LabelPoints<Eigen::Vector3d>& points,
                                             const detail::PottsProblem& problem) const;

  NormalsConstPtr normals_;
  SearchPtr tree_;
  std::vector<Eigen::Vector3d> directions_;
  double lambda_ = 1.0;
  int k_ = 8;
  double cell_size_ = 0.0;
  bool per_point_ = false;
  double used_cell_size_ = 0.0;
  double energy_ = 0.0;
};

}  // namespace storey

#include <storey/segmentation/impl/dominant_direction_labeling.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::DominantDirectionLabeling<pcl::PointNormal>;
extern template class storey::DominantDirectionLabeling<pcl::PointXYZRGBNormal>;
extern template class storey::DominantDirectionLabeling<pcl::PointXYZINormal>;
extern template class storey::DominantDirectionLabeling<pcl::PointXYZLNormal>;
#endif
