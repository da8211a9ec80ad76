// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/features/detail/oriented_points.h>
#include <storey/features/detail/vertical_kernels.h>
#include <storey/features/vertical_direction_estimation.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link
#include <type_traits>

namespace storey {

namespace detail {
constexpr double kColumnNoise = 12.0;   // noises in the side of a column: it must look flat
constexpr double kColumnSpacing = 6.0;  // spacings in the side of a column
constexpr double kColumnExtent = 0.02;  // of a cloud whose noise and spacing cannot be told
}  // namespace detail

template <typename PointT, typename NormalT>
bool VerticalDirectionEstimation<PointT, NormalT>::compute(Eigen::Vector3d& up) {
  const bool given = initial_up_.allFinite() && initial_up_.norm() > 0.0;
  const Eigen::Vector3d guess = given ? initial_up_.normalized() : Eigen::Vector3d::UnitZ();
  up_ = up = guess;
  quality_ = VerticalQuality();
  if (!this->initCompute()) {
    return false;
  }
  if (!inputValid()) {
    this->deinitCompute();
    return false;
  }
  const double column = columnSize();  // before the points take memory
  const detail::OrientedPoints points = [this] {
    if constexpr (std::is_same_v<PointT, NormalT>) {
      return detail::gatherOrientedPoints(*this->input_, normals_ ? *normals_ : *this->input_,
                                          *this->indices_);
    } else {
      return detail::gatherOrientedPoints(*this->input_, *normals_, *this->indices_);
    }
  }();
  this->deinitCompute();
  if (points.size() < 3) {
    PCL_ERROR("[storey::%s] %zu points have a finite position and normal, expected 3 or more.\n",
              getClassName().c_str(), points.size());
    return false;
  }
  const int threads = detail::threadsFor(threads_);
  const auto start = detail::findVerticalStart(points.normals, guess, given, threads);
  up_ = detail::refineByNormals(points.normals, start.up, threads);
  const detail::VerticalFit fit =
      detail::refineByPositions(points.positions, points.normals, up_, column, threads);
  up_ = fit.up;
  if (fit.one_direction) {
    PCL_WARN(
        "[storey::%s] all walls face one way; the tilt along them is taken from level points "
        "or the start.\n",
        getClassName().c_str());
    up_ = detail::refineByHorizontals(points.normals, up_, fit.loose);
  }
  quality_ = {start.score, start.second_score, fit.deviation, fit.patches, fit.one_direction};
  up = up_;
  return true;
}

template <typename PointT, typename NormalT>
double VerticalDirectionEstimation<PointT, NormalT>::getConfidence() const {
  const double sum = quality_.wall_share + quality_.second_score;
  return sum > 0.0 ? quality_.wall_share / sum : 0.0;
}

template <typename PointT, typename NormalT>
bool VerticalDirectionEstimation<PointT, NormalT>::inputValid() {
  const char* name = "VerticalDirectionEstimation";
  if (!initial_up_.allFinite()) {
    PCL_ERROR("[storey::%s] the initial up vector is not finite.\n", name);
  } else if (!(column_size_ >= 0.0) || !std::isfinite(column_size_)) {
    PCL_ERROR("[storey::%s] column_size is %g, expected >= 0.\n", name, column_size_);
  } else if (!normals_ && !std::is_same_v<PointT, NormalT>) {
    PCL_ERROR("[storey::%s] no normals were given.\n", name);
  } else if (normals_ && normals_->size() != this->input_->size()) {
    PCL_ERROR("[storey::%s] %zu normals for %zu points.\n", name, normals_->size(),
              this->input_->size());
  } else if (!detail::indicesInRange(*this->indices_, this->input_->size())) {
    PCL_ERROR("[storey::%s] an index lies outside the cloud of %zu points.\n", name,
              this->input_->size());
  } else {
    return true;
  }
  return false;
}

template <typename PointT, typename NormalT>
double VerticalDirectionEstimation<PointT, NormalT>::columnSize() const {
  if (column_size_ > 0.0) {
    return column_size_;
  }
  const CloudScale scale =
      detail::estimateCloudScale(detail::positionsOf(*this->input_), kDefaultScaleSeed, threads_);
  const double size =
      std::max(detail::kColumnNoise * scale.noise, detail::kColumnSpacing * scale.spacing);
  return size > 0.0 ? size : detail::kColumnExtent * scale.extent;
}

}  // namespace storey
