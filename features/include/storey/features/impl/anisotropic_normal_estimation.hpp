// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/search/kdtree.h>
#include <storey/features/anisotropic_normal_estimation.h>
#include <storey/features/detail/oriented_points.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link
#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/organized.hpp>
#include <pcl/search/impl/search.hpp>
#include <utility>

namespace storey {

template <typename PointInT, typename PointNT, typename PointOutT>
bool AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::initCompute() {
  if (!parametersValid()) {
    return false;
  }
  // An unstructured tree even for an organised cloud: PCL's own choice wants a perspective image.
  // Made anew for each run: a cloud changed in place would keep its old tree.
  if (!this->tree_) {
    this->tree_ = pcl::make_shared<pcl::search::KdTree<PointInT>>(false);
    own_tree_ = true;
  }
  using Base = pcl::FeatureFromNormals<PointInT, PointNT, PointOutT>;
  if (!Base::initCompute()) {
    deinitCompute();
    return false;
  }
  if (!detail::indicesInRange(*this->indices_, this->input_->size())) {
    PCL_ERROR("[storey::%s] an index lies outside the cloud of %zu points.\n",
              this->getClassName().c_str(), this->input_->size());
    deinitCompute();
    return false;
  }
  return true;
}

template <typename PointInT, typename PointNT, typename PointOutT>
bool AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::deinitCompute() {
  if (own_tree_) {
    this->tree_.reset();
    own_tree_ = false;
  }
  return pcl::FeatureFromNormals<PointInT, PointNT, PointOutT>::deinitCompute();
}

template <typename PointInT, typename PointNT, typename PointOutT>
bool AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::parametersValid() const {
  const char* name = this->getClassName().c_str();
  if (!(sigma_p_ >= 0.0) || !std::isfinite(sigma_p_)) {
    PCL_ERROR("[storey::%s] sigma_p is %g, expected >= 0.\n", name, sigma_p_);
  } else if (!(sigma_n_ > 0.0 && sigma_n_ <= M_PI)) {
    PCL_ERROR("[storey::%s] sigma_n is %g rad, expected (0, pi].\n", name, sigma_n_);
  } else if (!(alpha_ >= 0.0) || !std::isfinite(alpha_)) {
    PCL_ERROR("[storey::%s] alpha is %g, expected >= 0.\n", name, alpha_);
  } else if (iterations_ < 0) {
    PCL_ERROR("[storey::%s] iterations is %d, expected >= 0.\n", name, iterations_);
  } else if (this->k_ < 0 || !(this->search_radius_ >= 0.0)) {
    PCL_ERROR("[storey::%s] k is %d and the radius %g, expected >= 0.\n", name, this->k_,
              this->search_radius_);
  } else {
    return true;
  }
  return false;
}

template <typename PointInT, typename PointNT, typename PointOutT>
void AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::computeFeature(
    PointCloudOut& output) {
  if (isInput(output)) {
    PCL_ERROR("[storey::%s] the output must not be one of the inputs.\n",
              this->getClassName().c_str());
    output.clear();
    return;
  }
  try {
    const detail::PaddedNormals prior = priors();
    const detail::Neighborhoods hoods = findNeighborhoods();
    used_sigma_p_ = sigma_p_ > 0.0 ? sigma_p_ : detail::medianReach(hoods);
    const detail::SmoothingParameters parameters{used_sigma_p_, sigma_n_, alpha_, iterations_,
                                                 detail::threadsFor(threads_)};
    const auto solved = detail::smoothNormals(prior, hoods, parameters, &used_iterations_);
    write(normalsAtIndices(prior, solved, hoods, parameters), output);
  } catch (const std::bad_alloc&) {
    PCL_ERROR("[storey::%s] not enough memory for the neighbours of %zu points.\n",
              this->getClassName().c_str(), this->surface_->size());
    output.clear();
  }
}

template <typename PointInT, typename PointNT, typename PointOutT>
bool AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::isInput(
    const PointCloudOut& output) const {
  const void* out = &output;
  return out == this->input_.get() || out == this->surface_.get() || out == this->normals_.get();
}

template <typename PointInT, typename PointNT, typename PointOutT>
detail::PaddedNormals AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::priors() const {
  detail::PaddedNormals result(this->normals_->size(), Eigen::Vector4f::Zero());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& p = (*this->surface_)[i];
    if (detail::isSearchable({p.x, p.y, p.z})) {
      result[i].template head<3>() =
          detail::unitNormal((*this->normals_)[i]).template cast<float>();
    }
  }
  return result;
}

template <typename PointInT, typename PointNT, typename PointOutT>
int AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::searchAt(
    const pcl::PointCloud<PointInT>& cloud, pcl::index_t i, pcl::Indices& neighbors,
    std::vector<float>& squared_distances) const {
  if (this->k_ > 0) {
    return this->tree_->nearestKSearch(cloud, i, this->k_, neighbors, squared_distances);
  }
  return this->tree_->radiusSearch(cloud, i, this->search_radius_, neighbors, squared_distances,
                                   kMaxNeighbors + 1);
}

template <typename PointInT, typename PointNT, typename PointOutT>
detail::Neighborhoods AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::findNeighborhoods()
    const {
  // One search for each distinct position: a tree visits all copies of a point at a query there.
  const auto distinct = detail::findDistinctPositions(detail::positionsOf(*this->surface_));
  const std::size_t num_rows = distinct.cloud->size();
  detail::Neighborhoods hoods;
  hoods.representative.assign(num_rows, detail::Neighborhoods::kNoRow);
  hoods.row_of_point.assign(distinct.id_of_input.size(), detail::Neighborhoods::kNoRow);
  for (std::size_t i = 0; i < distinct.id_of_input.size(); ++i) {
    if (distinct.id_of_input[i] >= 0) {
      const auto row = static_cast<std::uint32_t>(distinct.id_of_input[i]);
      hoods.row_of_point[i] = row;
      hoods.representative[row] =
          std::min(hoods.representative[row], static_cast<std::uint32_t>(i));
    }
  }
  std::vector<std::vector<std::pair<std::uint32_t, float>>> rows(num_rows);
#pragma omp parallel num_threads(detail::threadsFor(threads_))
  {
    pcl::Indices neighbors;
    std::vector<float> squared;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(num_rows); ++r) {
      auto& row = rows[static_cast<std::size_t>(r)];
      const std::uint32_t self = hoods.representative[static_cast<std::size_t>(r)];
      const int found =
          searchAt(*this->surface_, static_cast<pcl::index_t>(self), neighbors, squared);
      for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
        const auto j = static_cast<std::uint32_t>(neighbors[k]);
        if (j != self) {
          row.emplace_back(j, std::sqrt(squared[k]));
        }
      }
    }
  }
  hoods.first.push_back(0);
  for (const auto& row : rows) {
    for (const auto& [j, d] : row) {
      hoods.neighbor.push_back(j);
      hoods.distance.push_back(d);
    }
    hoods.first.push_back(hoods.neighbor.size());
  }
  return hoods;
}

template <typename PointInT, typename PointNT, typename PointOutT>
detail::PaddedNormals AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::normalsAtIndices(
    const detail::PaddedNormals& priors, const detail::PaddedNormals& solved,
    const detail::Neighborhoods& hoods, const detail::SmoothingParameters& parameters) const {
  const pcl::Indices& indices = *this->indices_;
  detail::PaddedNormals result(indices.size(), Eigen::Vector4f::Zero());
  const bool on_surface = this->surface_ == this->input_;
  if (!on_surface && hoods.numRows() == 0) {
    return result;  // nothing to search in
  }
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const auto i = static_cast<std::size_t>(indices[k]);
    if (!on_surface) {
      result[k] = normalOffSurface(indices[k], priors, solved, parameters);
      continue;
    }
    const std::uint32_t row = hoods.row_of_point[i];
    if (row != detail::Neighborhoods::kNoRow && hoods.first[row] < hoods.first[row + 1]) {
      result[k] = solved[i];
    }
  }
  return result;
}

template <typename PointInT, typename PointNT, typename PointOutT>
Eigen::Vector4f AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::normalOffSurface(
    pcl::index_t i, const detail::PaddedNormals& priors, const detail::PaddedNormals& solved,
    const detail::SmoothingParameters& parameters) const {
  const auto& p = (*this->input_)[static_cast<std::size_t>(i)];
  if (!detail::isSearchable({p.x, p.y, p.z})) {
    return Eigen::Vector4f::Zero();
  }
  pcl::Indices found;
  std::vector<float> squared;
  const int num_found = searchAt(*this->input_, i, found, squared);
  std::vector<std::uint32_t> neighbors;
  std::vector<float> distances;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(num_found); ++k) {
    const auto j = static_cast<std::uint32_t>(found[k]);
    if (!priors[j].isZero()) {
      neighbors.push_back(j);
      distances.push_back(std::sqrt(squared[k]));
      nearest = distances.back() < distances[nearest] ? distances.size() - 1 : nearest;
    }
  }
  if (neighbors.empty()) {
    return Eigen::Vector4f::Zero();
  }
  Eigen::Vector4f normal = solved[neighbors[nearest]];
  if (distances[nearest] > 0.0f) {
    for (int round = 0; round < used_iterations_; ++round) {
      normal = detail::updatedNormal(normal, priors[neighbors[nearest]], neighbors, distances,
                                     solved, parameters);
    }
  }
  return normal;
}

template <typename PointInT, typename PointNT, typename PointOutT>
void AnisotropicNormalEstimation<PointInT, PointNT, PointOutT>::write(
    const detail::PaddedNormals& normals, PointCloudOut& output) const {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const bool on_surface = this->surface_ == this->input_;
  bool dense = this->input_->is_dense;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const auto i = static_cast<std::size_t>((*this->indices_)[k]);
    PointOutT& p = output[k];
    pcl::copyPoint((*this->input_)[i], p);
    const bool valid = !normals[k].isZero();
    p.normal_x = valid ? normals[k].x() : kNaN;
    p.normal_y = valid ? normals[k].y() : kNaN;
    p.normal_z = valid ? normals[k].z() : kNaN;
    dense = dense && valid;
    if constexpr (pcl::traits::has_curvature_v<PointOutT>) {
      if constexpr (pcl::traits::has_curvature_v<PointNT>) {
        p.curvature = on_surface ? (*this->normals_)[i].curvature : p.curvature;
      }
      p.curvature = valid ? p.curvature : kNaN;
    }
  }
  output.is_dense = dense;
  output.sensor_origin_ = this->input_->sensor_origin_;
  output.sensor_orientation_ = this->input_->sensor_orientation_;
}

}  // namespace storey
