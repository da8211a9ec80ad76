// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/indices.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <pcl/filters/impl/filter.hpp>  // lets point types unknown to PCL link
#include <pcl/impl/pcl_base.hpp>

namespace storey {

template <typename PointT>
AnisotropicPositionRefinement<PointT>::AnisotropicPositionRefinement() {
  this->filter_name_ = "AnisotropicPositionRefinement";
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::setRegions(
    const std::vector<pcl::PointIndices>& regions) {
  regions_ = regions;
  has_regions_ = true;
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::clearRegions() {
  regions_.clear();
  has_regions_ = false;
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::applyFilter(PointCloud& output) {
  output.clear();
  has_run_ = true;
  used_sigma_p_ = sigma_p_;
  if (!parametersValid() || !regionsValid()) {
    return;
  }
  const std::vector<pcl::Indices> regions = usablePointsByRegion();
  used_sigma_p_ = chooseSigmaP(regions);
  PointCloud all = *this->input_;
  if (used_sigma_p_ > 0.0) {  // else there are no two points to compare
    moveAll(regions, all);
  }
  copyIndexed(all, output);
}

template <typename PointT>
bool AnisotropicPositionRefinement<PointT>::parametersValid() const {
  const char* name = this->getClassName().c_str();
  const auto check = [name](const char* what, double value, bool valid, const char* expected) {
    if (!valid) {
      PCL_ERROR("[storey::%s] %s is %g, expected %s.\n", name, what, value, expected);
    }
    return valid;
  };
  const auto finite_from_0 = [](double v) { return v >= 0.0 && std::isfinite(v); };
  return check("k", k_, k_ >= 0, ">= 0") &&
         check("radius", radius_, finite_from_0(radius_), ">= 0") &&
         check("radius", radius_, (k_ > 0) != (radius_ > 0.0),
               "exactly one of k and radius to be positive") &&
         check("sigma_p", sigma_p_, finite_from_0(sigma_p_), ">= 0") &&
         check("sigma_n", sigma_n_, sigma_n_ > 0.0 && sigma_n_ <= M_PI, "(0, pi]") &&
         check("beta", beta_, finite_from_0(beta_), ">= 0") &&
         check("iterations", iterations_, iterations_ >= 0, ">= 0") &&
         detail::indicesInside(*this->indices_, this->input_->size(), name);
}

template <typename PointT>
bool AnisotropicPositionRefinement<PointT>::regionsValid() const {
  const char* name = this->getClassName().c_str();
  std::vector<char> taken(this->input_->size(), 0);
  for (const pcl::PointIndices& region : regions_) {
    if (!detail::indicesInside(region.indices, this->input_->size(), name)) {
      return false;
    }
    for (const pcl::index_t i : region.indices) {
      if (taken[static_cast<std::size_t>(i)]++) {
        PCL_ERROR("[storey::%s] point %d is more than once in the regions.\n", name,
                  static_cast<int>(i));
        return false;
      }
    }
  }
  return true;
}

template <typename PointT>
std::vector<pcl::Indices> AnisotropicPositionRefinement<PointT>::usablePointsByRegion() const {
  std::vector<pcl::Indices> regions;
  if (has_regions_) {
    for (const pcl::PointIndices& region : regions_) {
      regions.push_back(region.indices);
    }
  } else {
    regions.emplace_back(this->input_->size());
    std::iota(regions.back().begin(), regions.back().end(), 0);
  }
  for (pcl::Indices& region : regions) {
    const auto unusable = [this](pcl::index_t i) {
      const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
      const float length = p.getNormalVector3fMap().stableNorm();
      return !detail::isSearchable({p.x, p.y, p.z}) || !(length > 0.0f) || !std::isfinite(length);
    };
    region.erase(std::remove_if(region.begin(), region.end(), unusable), region.end());
  }
  return regions;
}

template <typename PointT>
detail::OrientedPositions AnisotropicPositionRefinement<PointT>::orientedPositions(
    const pcl::Indices& indices) const {
  detail::OrientedPositions points;
  points.positions.reserve(indices.size());
  points.normals.reserve(indices.size());
  for (const pcl::index_t i : indices) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    points.positions.emplace_back(p.x, p.y, p.z);
    points.normals.push_back(p.getNormalVector3fMap().stableNormalized());
  }
  return points;
}

template <typename PointT>
double AnisotropicPositionRefinement<PointT>::chooseSigmaP(
    const std::vector<pcl::Indices>& regions) const {
  if (sigma_p_ > 0.0) {
    return sigma_p_;
  }
  pcl::Indices all;
  for (const pcl::Indices& region : regions) {
    all.insert(all.end(), region.begin(), region.end());
  }
  return detail::deriveSigmaP(orientedPositions(all));
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::moveAll(const std::vector<pcl::Indices>& regions,
                                                    PointCloud& all) const {
  for (const pcl::Indices& region : regions) {
    if (region.size() >= detail::kLargeRegion) {
      move(region, threads_, all);
    }
  }
  const auto num_regions = static_cast<std::ptrdiff_t>(regions.size());
#pragma omp parallel for num_threads(detail::threadsFor(threads_)) schedule(dynamic, 1)
  for (std::ptrdiff_t r = 0; r < num_regions; ++r) {  // regions are disjoint, so are the writes
    const pcl::Indices& region = regions[static_cast<std::size_t>(r)];
    if (region.size() < detail::kLargeRegion) {
      move(region, 1, all);
    }
  }
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::move(const pcl::Indices& region, unsigned int threads,
                                                 PointCloud& all) const {
  const detail::OrientedPositions points = orientedPositions(region);
  detail::RefinementParameters parameters;
  parameters.k = k_;
  parameters.radius = radius_;
  parameters.sigma_p = used_sigma_p_;
  parameters.sigma_n = sigma_n_;
  parameters.beta = beta_;
  parameters.iterations = iterations_;
  parameters.threads = threads;
  const std::vector<double> t = detail::refineAlongNormals(points, parameters);
  for (std::size_t m = 0; m < region.size(); ++m) {
    const Eigen::Vector3d moved =
        points.positions[m].cast<double>() + t[m] * points.normals[m].cast<double>();
    all[static_cast<std::size_t>(region[m])].getVector3fMap() = moved.cast<float>();
  }
}

template <typename PointT>
void AnisotropicPositionRefinement<PointT>::copyIndexed(const PointCloud& all,
                                                        PointCloud& output) const {
  bool identity = this->indices_->size() == all.size();
  for (std::size_t i = 0; identity && i < all.size(); ++i) {
    identity = (*this->indices_)[i] == static_cast<pcl::index_t>(i);
  }
  if (identity) {
    output = all;  // keeps width and height
  } else {
    pcl::copyPointCloud(all, *this->indices_, output);
  }
}

}  // namespace storey
