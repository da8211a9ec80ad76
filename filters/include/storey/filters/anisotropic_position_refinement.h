// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/filters/filter.h>
#include <pcl/point_types.h>
#include <storey/filters/detail/position_refinement.h>
#include <storey/filters/eigen_alignment.h>

#include <cstddef>
#include <vector>

namespace storey {

/// Straightens walls: moves each point along its (smoothed) normal, x_i = x_i0 + t_i n_i, so as to
/// lower, within each edge region [Sui et al. 2016, (7)],
///
///     E_p = sum_i [ sum_{j in N_i} |n_i.(x_i - x_j)|^2 phi(|x_i0 - x_j0|) psi(n_i, n_j)
///                   + beta |x_i - x_i0|^2 ]
///     phi(d) = exp(-(d / sigma_p)^2),  psi(a, b) = exp(-((1 - a.b) / (1 - cos sigma_n))^2)   (2)
///
/// by iterating from t = 0, all points at once,
///
///     t_i <- sum_j n_i.(x_j - x_i0) phi psi / (sum_j phi psi + beta).                        (8)
///
/// Only neighbours of the same region count, so a corner stays sharp. Neighbours and weights are
/// those of the initial positions: points move by about the noise, a fifth of the default sigma_p.
///
/// The output holds the points of `setIndices` in their order, other fields as in the input; all
/// points of the input take part, so the values do not depend on the indices. It keeps width and
/// height where all points are asked for in order. Points of no region, points with a non-finite
/// coordinate or normal, a zero normal, or a coordinate beyond 1e18 are left where they are and are
/// no neighbours. Of points at one position the first is a neighbour, all are moved.
///
/// A bad parameter, an index outside the cloud or a point in two regions gives a PCL_ERROR and an
/// empty result.
/// \tparam PointT needs x, y, z and normal_x, normal_y, normal_z (of any length > 0)
/// \par Complexity O(n log n + n k (iterations)) time, about 8 k bytes a point of the largest
/// region. The result has the same bytes for any number of threads.
/// \par In pcl_viewer
/// `pcl_viewer -multiview 1 05_normals.pcd 08_refined.pcd`, from above: bands as thick as the noise
/// become thin lines, and corners stay sharp.
template <typename PointT>
class AnisotropicPositionRefinement : public pcl::Filter<PointT> {
 public:
  using Ptr = pcl::shared_ptr<AnisotropicPositionRefinement<PointT>>;
  using ConstPtr = pcl::shared_ptr<const AnisotropicPositionRefinement<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  AnisotropicPositionRefinement();

  /// Number of nearest neighbours, >= 0; default 30, as for the confidence. 0 to use a radius.
  void setKSearch(int k) { k_ = k; }
  int getKSearch() const { return k_; }

  /// Radius of the neighbourhood in the cloud's unit, >= 0; default 0 (not used). If it is set, set
  /// k to 0: exactly one of the two must be positive. At most the 256 nearest are taken.
  void setRadiusSearch(double radius) { radius_ = radius; }
  double getRadiusSearch() const { return radius_; }

  /// Edge regions: disjoint sets of indices into the input cloud. Points of none stay. Without this
  /// call (or after `clearRegions`) all points are one region.
  void setRegions(const std::vector<pcl::PointIndices>& regions);
  void clearRegions();
  const std::vector<pcl::PointIndices>& getRegions() const { return regions_; }

  /// Spatial weight in the cloud's unit, >= 0; 0 (default) derives it: 5 standard deviations of the
  /// points along their normals, at least 2 spacings.
  /// \note Deviation: the paper has 0.1, the noise of its own data [doc/method.md, deviation 8]. A
  /// wall shows its direction only over some five deviations.
  void setSigmaP(double sigma_p) { sigma_p_ = sigma_p; }

  /// The one used in the last run; before it, the one set.
  double getSigmaP() const { return has_run_ ? used_sigma_p_ : sigma_p_; }

  /// Normal weight in radians, within (0, pi]; default 20 degrees [Sui et al. 2016].
  void setSigmaN(double radians) { sigma_n_ = radians; }
  double getSigmaN() const { return sigma_n_; }

  /// Weight of the initial position, >= 0; default 0.1. The paper gives none; it stands against
  /// sum phi psi, some ten of good neighbours, exactly as alpha = 0.1 does in (3): too little to
  /// hold back a point that has neighbours, enough to hold one that has none worth the name, and to
  /// keep the region as a whole in place.
  void setBeta(double beta) { beta_ = beta; }
  double getBeta() const { return beta_; }

  /// Iterations of (8), >= 0; default 20.
  void setIterations(int iterations) { iterations_ = iterations; }
  int getIterations() const { return iterations_; }

  /// Number of threads, 0 = all cores (default).
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

 protected:
  void applyFilter(PointCloud& output) override;

 private:
  bool parametersValid() const;
  bool regionsValid() const;
  std::vector<pcl::Indices> usablePointsByRegion() const;
  detail::OrientedPositions orientedPositions(const pcl::Indices& indices) const;
  double chooseSigmaP(const std::vector<pcl::Indices>& regions) const;
  void moveAll(const std::vector<pcl::Indices>& regions, PointCloud& all) const;
  void move(const pcl::Indices& region, unsigned int threads, PointCloud& all) const;
  void copyIndexed(const PointCloud& all, PointCloud& output) const;

  int k_ = 30;  // points, as K in [Sui et al. 2016, Sec. 3.1]
  double radius_ = 0.0;
  double sigma_p_ = 0.0;
  double sigma_n_ = 0.34906585;  // rad
  double beta_ = 0.1;
  int iterations_ = 20;
  unsigned int threads_ = 0;
  bool has_regions_ = false;
  std::vector<pcl::PointIndices> regions_;
  bool has_run_ = false;
  double used_sigma_p_ = 0.0;
};

}  // namespace storey

#include <storey/filters/impl/anisotropic_position_refinement.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::AnisotropicPositionRefinement<pcl::PointNormal>;
extern template class storey::AnisotropicPositionRefinement<pcl::PointXYZRGBNormal>;
extern template class storey::AnisotropicPositionRefinement<pcl::PointXYZINormal>;
extern template class storey::AnisotropicPositionRefinement<pcl::PointXYZLNormal>;
#endif
