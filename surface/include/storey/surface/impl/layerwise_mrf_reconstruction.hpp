// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/indices.h>
#include <storey/segmentation/building_floorplan_extraction.h>
#include <storey/segmentation/detail/indexed_scale.h>
#include <storey/segmentation/detail/place_order.h>
#include <storey/surface/mesh_export.h>
#include <storey/surface/model_refinement.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>
// The base class searches: without these a point type unknown to PCL does not link.
#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/organized.hpp>
#include <pcl/search/impl/search.hpp>

namespace storey {
namespace detail {

constexpr double kModelLeastNoise = 1e-5;  // of the extent, where a cloud has none
// Lines of slices scatter by less than this about their wall, and walls further apart differ.
constexpr double kLetterToleranceInNoise = 1.5;
// Two bins of the levels of `BuildingFloorplanExtraction`.
constexpr double kLevelErrorInNoise = 6.0;
constexpr double kLevelErrorInHeight = 1.0 / 150.0;

/// How far the heights of `BuildingFloorplanExtraction` may be off: it sees planar points alone.
inline double levelError(const std::vector<FloorplanLayer>& blocks, const CloudScale& scale) {
  const double height = blocks.back().z_max - blocks.front().z_min;
  const double bins = std::max(kLevelErrorInNoise * scale.noise, kLevelErrorInHeight * height);
  return scale.density > 0.0 ? std::max(bins, cornerGap(scale.density)) : bins;
}

/// Whether every layer has a height, and none begins below the end of the one before it (but for
/// rounding).
inline bool layersAscend(const std::vector<FloorplanLayer>& layers) {
  constexpr double kRounding = 1e-6;  // of a layer's height
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double height = layers[i].z_max - layers[i].z_min;
    if (!(height > 0.0) || std::isinf(height)) return false;
    if (i > 0 && layers[i].z_min < layers[i - 1].z_max - kRounding * height) return false;
  }
  return true;
}

/// Leaves out the points that are not finite.
inline void keepFinite(FitPoints& points) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    if (!points.positions[i].allFinite()) continue;
    points.positions[kept] = points.positions[i];
    points.normals[kept] = points.normals[i];
    ++kept;
  }
  points.positions.resize(kept);
  points.normals.resize(kept);
}

/// The finite points with their normals, neighbours near each other; a normal that is not finite
/// becomes zero (unknown).
template <typename PointT>
FitPoints toFitPoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                      unsigned int threads) {
  pcl::Indices sorted;
  const bool is_sorted = areByPlace(cloud, indices);
  if (!is_sorted) sorted = orderByPlace(cloud, indices, threads);
  const pcl::Indices& order = is_sorted ? indices : sorted;
  FitPoints points;
  points.positions.resize(order.size());
  points.normals.resize(order.size());
  std::atomic<bool> all_finite = true;
  forEachChunk(order.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    bool finite = true;
    for (std::size_t k = begin; k < end; ++k) {
      const PointT& p = cloud[static_cast<std::size_t>(order[k])];
      points.positions[k] = {p.x, p.y, p.z};
      points.normals[k] = pcl::isNormalFinite(p)
                              ? Eigen::Vector3f(p.normal_x, p.normal_y, p.normal_z)
                              : Eigen::Vector3f(Eigen::Vector3f::Zero());
      finite = finite && pcl::isXYZFinite(p);
    }
    if (!finite) all_finite = false;
  });
  if (!all_finite) keepFinite(points);
  return points;
}

}  // namespace detail

template <typename PointT>
bool LayerwiseMRFReconstruction<PointT>::parametersValid() const {
  for (const double value : {noise_, density_, grid_, options_.smoothness, options_.label_cost}) {
    if (!(value >= 0.0) || std::isinf(value)) {
      PCL_ERROR("[storey::%s] a parameter is %g, expected finite and >= 0.\n",
                getClassName().c_str(), value);
      return false;
    }
  }
  if (!detail::layersAscend(floorplans_) || !detail::layersAscend(blocks_)) {
    PCL_ERROR(
        "[storey::%s] a floorplan has no height, or begins below the end of the one before.\n",
        getClassName().c_str());
    return false;
  }
  return detail::indicesInside(*this->indices_, this->input_->size(), getClassName().c_str());
}

template <typename PointT>
bool LayerwiseMRFReconstruction<PointT>::build() {
  result_ = {};
  if (!this->initCompute()) return false;
  if (!parametersValid()) {
    this->deinitCompute();
    return false;
  }
  CloudScale scale{noise_, density_};
  if (noise_ == 0.0 || density_ == 0.0) {
    scale = detail::scaleOfIndexed(*this->input_, *this->indices_);
    scale.noise =
        noise_ > 0.0 ? noise_ : std::max(scale.noise, detail::kModelLeastNoise * scale.extent);
    if (density_ > 0.0) scale.density = density_;
  }
  LayerwiseModelOptions options;
  options.noise = scale.noise;
  options.dominant = options_;
  options.dominant.length_tolerance = detail::kLetterToleranceInNoise * options.noise;
  options.grid = grid_;
  options.max_faces = max_faces_;
  options.steps = steps_;
  options.threads = threads_;
  FitPoints points = detail::toFitPoints(*this->input_, *this->indices_, threads_);
  if (!floorplans_.empty()) {
    options.slice_thickness = floorplans_.front().z_max - floorplans_.front().z_min;
    result_ = buildLayerwiseModel(floorplans_, points, options);
  } else {
    std::vector<FloorplanLayer> blocks = blocks_;
    if (blocks.empty()) {
      BuildingFloorplanExtraction<PointT> extraction;
      extraction.setInputCloud(this->input_);
      extraction.setIndices(this->indices_);
      extraction.setNoise(noise_);
      extraction.setDensity(density_);
      extraction.setNumberOfThreads(threads_);
      extraction.extract(blocks);
    }
    if (!blocks.empty()) {
      options.slice_thickness = detail::levelError(blocks, scale);
      result_ = buildModelOfBlocks(blocks, std::move(points), options);
    }
  }
  if (source_ && !result_.model.empty()) refine(options);
  this->deinitCompute();
  if (!result_.model.empty()) return true;
  PCL_ERROR("[storey::%s] no outline was found.\n", getClassName().c_str());
  return false;
}

template <typename PointT>
void LayerwiseMRFReconstruction<PointT>::refine(const LayerwiseModelOptions& options) {
  ModelRefinement refinement(detail::toFitPoints(*this->input_, *this->indices_, threads_), options,
                             result_);
  source_([&](const pcl::PointCloud<PointT>& part) {
    pcl::Indices all(part.size());
    std::iota(all.begin(), all.end(), 0);
    refinement.add(detail::toFitPoints(part, all, threads_));
  });
  refinement.finish();
}

template <typename PointT>
void LayerwiseMRFReconstruction<PointT>::performReconstruction(pcl::PolygonMesh& output) {
  output = toPolygonMesh(result_.model, result_.upright.inverse());
  output.header = this->input_->header;
  output.cloud.header = this->input_->header;
}

template <typename PointT>
void LayerwiseMRFReconstruction<PointT>::performReconstruction(
    pcl::PointCloud<PointT>& points, std::vector<pcl::Vertices>& polygons) {
  const pcl::PolygonMesh mesh = toPolygonMesh(result_.model, result_.upright.inverse());
  pcl::PointCloud<pcl::PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  pcl::copyPointCloud(vertices, points);
  points.header = this->input_->header;
  polygons = mesh.polygons;
}

// The base class reads the header of the input before it tests for one, and copies the input.
template <typename PointT>
void LayerwiseMRFReconstruction<PointT>::reconstruct(pcl::PolygonMesh& output) {
  output = {};
  if (build()) performReconstruction(output);
}

template <typename PointT>
void LayerwiseMRFReconstruction<PointT>::reconstruct(pcl::PointCloud<PointT>& points,
                                                     std::vector<pcl::Vertices>& polygons) {
  points.clear();
  polygons.clear();
  if (build()) performReconstruction(points, polygons);
}

}  // namespace storey
