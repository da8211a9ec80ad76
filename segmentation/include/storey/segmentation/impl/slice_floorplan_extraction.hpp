// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/segmentation/dominant_direction_clustering.h>
#include <storey/segmentation/dominant_direction_labeling.h>
#include <storey/segmentation/edge_region_growing.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pcl/impl/pcl_base.hpp>
#include <utility>
#include <vector>

namespace storey {
namespace detail {

constexpr double kSliceToleranceInNoise = 2.5;  // vertices nearer than this are one
constexpr double kSliceMinAreaInNoise = 10.0;   // side of the smallest component
constexpr double kSliceMaxResidual = 3.0;       // noise deviations: more is not a line
constexpr double kSlicePriorAngle = 0.02;       // rad: short segments take their label's direction
constexpr double kSliceLeastNoise = 1e-5;       // of the longest wall, where a cloud has none
constexpr std::size_t kSliceMinPoints = 5;

}  // namespace detail

template <typename PointT, typename NormalT>
bool SliceFloorplanExtraction<PointT, NormalT>::fail(const std::string& reason) {
  failure_ = reason;
  return false;
}

template <typename PointT, typename NormalT>
bool SliceFloorplanExtraction<PointT, NormalT>::parametersValid() const {
  for (const double value : {noise_, tolerance_, max_gap_, min_area_}) {
    if (!(value >= 0.0) || std::isinf(value)) {
      PCL_ERROR("[storey::%s] a length or area is %g, expected finite and >= 0.\n", getClassName(),
                value);
      return false;
    }
  }
  if (normals_ && normals_->size() != this->input_->size()) {
    PCL_ERROR("[storey::%s] %zu normals for %zu points.\n", getClassName(), normals_->size(),
              this->input_->size());
    return false;
  }
  if (has_regions_ && region_labels_.size() != regions_.size()) {
    PCL_ERROR("[storey::%s] %zu labels for %zu regions.\n", getClassName(), region_labels_.size(),
              regions_.size());
    return false;
  }
  const std::size_t size = this->input_->size();
  return detail::indicesInside(*this->indices_, size, getClassName()) &&
         std::all_of(regions_.begin(), regions_.end(), [&](const pcl::PointIndices& region) {
           return detail::indicesInside(region.indices, size, getClassName());
         });
}

template <typename PointT, typename NormalT>
bool SliceFloorplanExtraction<PointT, NormalT>::growRegions() {
  regions_.clear();
  region_labels_.clear();
  if (directions_.empty()) {
    DominantDirectionClustering<PointT, NormalT> clustering;
    clustering.setInputCloud(this->input_);
    clustering.setIndices(this->indices_);
    if (normals_) clustering.setInputNormals(normals_);
    std::vector<pcl::PointIndices> clusters;
    clustering.extract(clusters);
    directions_ = clustering.getDirections();
  }
  DominantDirectionLabeling<PointT, NormalT> labeling;
  labeling.setInputCloud(this->input_);
  labeling.setIndices(this->indices_);
  if (normals_) labeling.setInputNormals(normals_);
  labeling.setDirections(directions_);
  auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
  labeling.segment(*labels);
  EdgeRegionGrowing<PointT> growing;
  growing.setInputCloud(this->input_);
  growing.setIndices(this->indices_);
  growing.setLabels(labels);
  growing.extract(regions_);
  for (const std::uint32_t label : growing.getRegionLabels()) {
    region_labels_.push_back(static_cast<int>(label));
  }
  return !regions_.empty();
}

template <typename PointT, typename NormalT>
void SliceFloorplanExtraction<PointT, NormalT>::fitSegments() {
  segments_.clear();
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    std::vector<Eigen::Vector2d> points;
    Eigen::Vector2d outward = Eigen::Vector2d::Zero();
    for (const pcl::index_t i : regions_[r].indices) {
      const auto index = static_cast<std::size_t>(i);
      const PointT& p = (*this->input_)[index];
      if (!pcl::isXYZFinite(p)) continue;
      points.emplace_back(p.x, p.y);
      const auto add = [&](const auto& n) {
        if (pcl::isNormalFinite(n)) outward += Eigen::Vector2d(n.normal_x, n.normal_y);
      };
      if (normals_) {
        add((*normals_)[index]);
      } else if constexpr (pcl::traits::has_normal_v<PointT>) {
        add(p);
      }
    }
    const int label = region_labels_[r];
    if (label >= 0 && static_cast<std::size_t>(label) < directions_.size()) {
      outward = directions_[static_cast<std::size_t>(label)].template head<2>();
    }
    if (points.size() < detail::kSliceMinPoints || !(outward.norm() > 0.0)) continue;
    const detail::LineSegment segment =
        detail::fitTrimmedSegment(points, outward.normalized(), detail::kSlicePriorAngle, noise_);
    segments_.push_back(segment);
  }
}

// Half of the points lie in segments that scatter less. The slice itself tells no noise to a fit of
// planes: all its points may have one height.
template <typename PointT, typename NormalT>
double SliceFloorplanExtraction<PointT, NormalT>::noiseOfSegments() const {
  std::vector<std::pair<double, std::size_t>> residuals;
  std::size_t points = 0;
  double longest = 0.0;
  for (const detail::LineSegment& segment : segments_) {
    residuals.emplace_back(segment.residual, segment.support);
    points += segment.support;
    longest = std::max(longest, segment.length());
  }
  std::sort(residuals.begin(), residuals.end());
  double noise = 0.0;
  std::size_t below = 0;
  for (const auto& [residual, support] : residuals) {
    noise = residual;
    below += support;
    if (2 * below >= points) break;
  }
  return std::max(noise, detail::kSliceLeastNoise * longest);
}

template <typename PointT, typename NormalT>
void SliceFloorplanExtraction<PointT, NormalT>::keepLines(double noise) {
  const auto isBlob = [&](const detail::LineSegment& segment) {
    return segment.length() < detail::kSliceToleranceInNoise * noise ||
           segment.residual > detail::kSliceMaxResidual * noise;
  };
  segments_.erase(std::remove_if(segments_.begin(), segments_.end(), isBlob), segments_.end());
}

template <typename PointT, typename NormalT>
bool SliceFloorplanExtraction<PointT, NormalT>::linkAndClose(double noise, Floorplan& floorplan) {
  detail::LinkingOptions options;
  options.method = method_;
  options.tolerance = tolerance_ > 0.0 ? tolerance_ : detail::kSliceToleranceInNoise * noise;
  if (max_gap_ > 0.0) options.max_gap = max_gap_;
  for (const Eigen::Vector3d& direction : directions_) {
    options.directions.push_back(direction.template head<2>().normalized());
  }
  const std::vector<int> next = detail::linkSegments(segments_, options);
  std::vector<FloorplanRing> rings;
  std::vector<char> seen(next.size(), 0);
  for (std::size_t first = 0; first < next.size(); ++first) {
    std::vector<detail::LineSegment> cycle;
    for (std::size_t i = first; seen[i] == 0 && next[i] >= 0;
         i = static_cast<std::size_t>(next[i])) {
      seen[i] = 1;
      cycle.push_back(segments_[i]);
    }
    if (cycle.size() < 2) continue;
    FloorplanRing ring = detail::closeRing(cycle, options);
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  const double side = detail::kSliceMinAreaInNoise * noise;
  floorplan = detail::assembleFloorplan(rings, min_area_ > 0.0 ? min_area_ : side * side);
  return !floorplan.empty();
}

template <typename PointT, typename NormalT>
bool SliceFloorplanExtraction<PointT, NormalT>::extract(Floorplan& floorplan) {
  floorplan = {};
  segments_.clear();
  failure_.clear();
  if (!this->initCompute()) return fail("no input");
  if (!parametersValid()) {
    this->deinitCompute();
    return fail("bad parameter");
  }
  const bool own_regions = !has_regions_;
  const bool own_directions = directions_.empty();
  bool found = false;
  if (own_regions && !growRegions()) {
    fail("no edge regions");
  } else {
    fitSegments();
    const double noise = noise_ > 0.0 ? noise_ : noiseOfSegments();
    keepLines(noise);
    if (segments_.size() < 2) {
      fail("fewer than two line segments");
    } else {
      found = linkAndClose(noise, floorplan) || fail("the segments enclose no area");
    }
  }
  if (own_regions) regions_.clear(), region_labels_.clear();
  if (own_regions && own_directions) directions_.clear();
  this->deinitCompute();
  return found;
}

}  // namespace storey
