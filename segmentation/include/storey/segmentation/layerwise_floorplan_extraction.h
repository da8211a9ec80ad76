// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/slice_stages.h>

#include <string>
#include <vector>

namespace storey {

/// The first room of the house: the floorplans of all slices of a building [Sui et al. 2016,
/// section 3]. Cuts the cloud along gravity and takes each slice through the steps of
/// `slice_stages.h`. Slices are independent and run in parallel; the result does not depend on the
/// number of threads.
///
/// Needs an upright cloud (+z is up) with outward normals; only the indexed points are used.
/// A slice without points gives a layer without outline. Without an input, with an index outside
/// the cloud or a bad parameter there are no layers, after a PCL_ERROR.
///
/// \tparam PointT needs x, y, z and normal_x, normal_y, normal_z
///
/// \par Complexity O(n (k + log n)) and O(s^3) a slice for s segments; a copy of the points of the
/// slices that are worked on.
///
/// \par In pcl_viewer
/// As `SliceFloorplanExtraction`; `storey_reconstruct --method paper --intermediate` leaves the
/// cloud of each step.
template <typename PointT>
class LayerwiseFloorplanExtraction : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<LayerwiseFloorplanExtraction<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LayerwiseFloorplanExtraction<PointT>>;
  using LinkingMethod = detail::LinkingMethod;

  /// Dominant directions; none (default): `DominantDirectionClustering` finds them in the input.
  void setDirections(const std::vector<Eigen::Vector3d>& directions) { directions_ = directions; }
  /// The directions set; if none are, those found by the last `extract`.
  const std::vector<Eigen::Vector3d>& getDirections() const {
    return directions_.empty() ? used_directions_ : directions_;
  }

  /// Standard deviation of the points across their walls; 0 (default): estimated from the input.
  void setNoise(double noise) { noise_ = noise; }
  double getNoise() const { return noise_; }

  /// Thickness of a slice; 0 (default): see `GravitySlicing`.
  void setSliceThickness(double thickness) { thickness_ = thickness; }
  /// The thickness set, or used by the last `extract`.
  double getSliceThickness() const { return used_thickness_ > 0.0 ? used_thickness_ : thickness_; }

  /// Neighbours of a point within its slice, for the normals and the positions; default 30.
  void setKSearch(int k) { k_ = k; }
  int getKSearch() const { return k_; }

  void setLinkingMethod(LinkingMethod method) { method_ = method; }
  LinkingMethod getLinkingMethod() const { return method_; }

  /// Whether the clouds of all stages are kept for `getStages`; default no: they take several
  /// times the memory of the input. Floorplans, segments and failures are kept in any case.
  void setKeepStages(bool keep) { keep_stages_ = keep; }
  bool getKeepStages() const { return keep_stages_; }

  /// 0 (default) = all cores.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /// One layer a slice, bottom to top; the floorplan of a slice that gives none is empty.
  /// \return false, after a PCL_ERROR, for no input, a bad parameter, an index outside the cloud or
  /// no wall points
  bool extract(std::vector<FloorplanLayer>& layers);

  /// What became of each slice in the last `extract`, parallel to its layers.
  const std::vector<SliceStages<PointT>>& getStages() const { return stages_; }

 protected:
  const char* getClassName() const { return "LayerwiseFloorplanExtraction"; }

 private:
  bool parametersValid() const;
  bool prepare(std::vector<pcl::PointIndices>& slices);
  void processSlice(const pcl::PointIndices& slice, SliceStages<PointT>& stages) const;

  std::vector<Eigen::Vector3d> directions_;
  std::vector<Eigen::Vector3d> used_directions_;
  double noise_ = 0.0;
  double used_noise_ = 0.0;
  double thickness_ = 0.0;
  double used_thickness_ = 0.0;
  int k_ = 30;  // points, as for the planar confidence
  LinkingMethod method_ = LinkingMethod::Optimal;
  bool keep_stages_ = false;
  unsigned int threads_ = 0;
  std::vector<SliceStages<PointT>> stages_;
};

}  // namespace storey

#include <storey/segmentation/impl/layerwise_floorplan_extraction.hpp>

#ifndef PCL_NO_PRECOMPILE
extern template class storey::LayerwiseFloorplanExtraction<pcl::PointNormal>;
extern template class storey::LayerwiseFloorplanExtraction<pcl::PointXYZINormal>;
#endif
