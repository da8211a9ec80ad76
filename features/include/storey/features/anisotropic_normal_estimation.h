// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/features/feature.h>
#include <pcl/point_types.h>
#include <storey/features/detail/anisotropic_smoothing.h>
#include <storey/filters/eigen_alignment.h>

#include <string>
#include <vector>

namespace storey {

constexpr double kDefaultSigmaN = 0.34906585;  // rad, 20 degrees [Sui et al. 2016, 3.2.1]
constexpr double kDefaultNormalAlpha = 0.1;    // [Sui et al. 2016, 3.2.1]

/// Smooths given normals and keeps the creases [Sui et al. 2016, (1)-(3)]:
///
///     E_n = sum_i [ sum_{j in N_i} |n_i - n_j|^2 phi(|x_i - x_j|) psi(n_i, n_j)
///                   + alpha |n_i - n_i0|^2 ]
///     phi(d) = exp(-(d / sigma_p)^2)
///     psi(a, b) = exp(-((1 - a.b) / (1 - cos sigma_n))^2)
///     n_i <- normalise(sum_j phi psi n_j + alpha n_i0)
///
/// all points at once, from the normals of the round before. The point itself is not in N_i.
/// \note An update never raises (1) with psi held at the normals before it; no damping is needed.
/// With psi as a function of the normals, each pair's term has its maximum at 1 - a.b =
/// (1 - cos sigma_n) / sqrt 2 (17 degrees), and (1) may rise a little while pairs further apart
/// than that, at corners, are drawn together.
///
/// \note Deviation: sigma_p is by default derived from the cloud instead of 0.1 of its units
/// [doc/method.md, deviation 8].
///
/// The prior normals come through `setInputNormals`, parallel to the surface (default: the input);
/// they need not be unit. `setKSearch` (counting the point itself; the paper has 30) or
/// `setRadiusSearch` gives N_i. All points of the surface take part in the smoothing; the result is
/// given at the indexed points. A point of the input that is not on a different search surface
/// takes the prior of the surface point nearest to it.
///
/// The output has the indexed points with all their fields, unit normals with n_i . n_i0 >= 0, and
/// the curvature of the prior. Where position or prior is not finite, the prior has no length, or
/// there is no other point within reach, normal and curvature are NaN and `is_dense` is false.
/// The output must be another cloud than input, surface and normals. The result does not depend on
/// the number of threads.
/// \par Complexity O(n log n + iterations * n * k) time, 8 (k + 6) bytes a point.
/// \par In pcl_viewer
/// `pcl_viewer 05_normals.pcd -normals 10 -normals_scale 0.5`: sticks of a wall are parallel up to
/// the corner, and turn there from one point to the next.
///
/// \image html tutorial_normals.png
template <typename PointInT, typename PointNT = PointInT, typename PointOutT = PointNT>
class AnisotropicNormalEstimation : public pcl::FeatureFromNormals<PointInT, PointNT, PointOutT> {
 public:
  using Ptr = pcl::shared_ptr<AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>>;
  using ConstPtr = pcl::shared_ptr<const AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>>;
  using PointCloudOut = pcl::PointCloud<PointOutT>;

  /// Neighbours of a radius search beyond this number, the farthest ones, are left out, so that no
  /// radius is too large for the memory.
  static constexpr unsigned int kMaxNeighbors = 200;

  AnisotropicNormalEstimation() { this->feature_name_ = "AnisotropicNormalEstimation"; }

  /// Reach of phi in the cloud's unit, >= 0. 0 (default): the median distance to the farthest
  /// neighbour, so that phi falls to 1/e at the border of N_i.
  void setSigmaP(double sigma_p) { sigma_p_ = sigma_p; }
  double getSigmaP() const { return sigma_p_; }

  /// The sigma_p of the last `compute`, be it set or derived.
  double getUsedSigmaP() const { return used_sigma_p_; }

  /// Reach of psi in radians within (0, pi]; default 20 degrees.
  void setSigmaN(double radians) { sigma_n_ = radians; }
  double getSigmaN() const { return sigma_n_; }

  /// Weight of the prior normal, >= 0; default 0.1.
  void setAlpha(double alpha) { alpha_ = alpha; }
  double getAlpha() const { return alpha_; }

  /// Number of updates, >= 0. 0 (default): until the normals turn by less than 0.1 degree (root
  /// mean square), at most 50.
  void setIterations(int iterations) { iterations_ = iterations; }
  int getIterations() const { return iterations_; }

  /// The number of updates that the last `compute` did.
  int getUsedIterations() const { return used_iterations_; }

  /// 0 (default) = all cores.
  void setNumberOfThreads(unsigned int nr = 0) { threads_ = nr; }
  unsigned int getNumberOfThreads() const { return threads_; }

 protected:
  bool initCompute() override;
  bool deinitCompute() override;
  void computeFeature(PointCloudOut& output) override;

 private:
  bool parametersValid() const;
  bool isInput(const PointCloudOut& output) const;
  detail::PaddedNormals priors() const;
  int searchAt(const pcl::PointCloud<PointInT>& cloud, pcl::index_t i, pcl::Indices& neighbors,
               std::vector<float>& squared_distances) const;
  detail::Neighborhoods findNeighborhoods() const;
  detail::PaddedNormals normalsAtIndices(const detail::PaddedNormals& priors,
                                         const detail::PaddedNormals& solved,
                                         const detail::Neighborhoods& hoods,
                                         const detail::SmoothingParameters& parameters) const;
  Eigen::Vector4f normalOffSurface(pcl::index_t i, const detail::PaddedNormals& priors,
                                   const detail::PaddedNormals& solved,
                                   const detail::SmoothingParameters& parameters) const;
  void write(const detail::PaddedNormals& normals, PointCloudOut& output) const;

  double sigma_p_ = 0.0;
  double sigma_n_ = kDefaultSigmaN;  // rad
  double alpha_ = kDefaultNormalAlpha;
  int iterations_ = 0;
  unsigned int threads_ = 0;
  bool own_tree_ = false;
  double used_sigma_p_ = 0.0;
  int used_iterations_ = 0;
};

}  // namespace storey

#include <storey/features/impl/anisotropic_normal_estimation.hpp>

#ifndef PCL_NO_PRECOMPILE  // compiled once, in the library; every other type compiles on use
extern template class storey::AnisotropicNormalEstimation<pcl::PointNormal>;
extern template class storey::AnisotropicNormalEstimation<pcl::PointXYZRGBNormal>;
extern template class storey::AnisotropicNormalEstimation<pcl::PointXYZINormal>;
extern template class storey::AnisotropicNormalEstimation<pcl::PointXYZLNormal>;
#endif
