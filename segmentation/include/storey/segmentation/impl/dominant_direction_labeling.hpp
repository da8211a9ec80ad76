// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/segmentation/detail/cell_partition.h>
#include <storey/segmentation/detail/position_search.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link

namespace storey {

template <typename PointT, typename NormalT>
void DominantDirectionLabeling<PointT, NormalT>::segment(pcl::PointCloud<pcl::Label>& labels) {
  labels.clear();
  energy_ = 0.0;
  used_cell_size_ = 0.0;
  if (!this->initCompute()) {
    return;
  }
  if (parametersValid() &&
      detail::indicesInside(*this->indices_, this->input_->size(), getClassName())) {
    const pcl::PointCloud<NormalT>* normals =
        detail::chooseNormals<PointT, NormalT>(*this->input_, normals_, getClassName());
    if (normals != nullptr) {
      labelPoints(
          detail::collectOrientedPoints<Eigen::Vector3d>(*this->input_, *normals, *this->indices_),
          labels);
    }
  }
  this->deinitCompute();
}

template <typename PointT, typename NormalT>
bool DominantDirectionLabeling<PointT, NormalT>::parametersValid() const {
  if (directions_.empty()) {
    PCL_ERROR("[storey::%s] no directions: call setDirections.\n", getClassName());
    return false;
  }
  for (const Eigen::Vector3d& direction : directions_) {
    const double length = direction.norm();
    if (!(length > 0.0 && std::isfinite(length))) {
      PCL_ERROR("[storey::%s] direction (%g, %g, %g) has no finite length > 0.\n", getClassName(),
                direction.x(), direction.y(), direction.z());
      return false;
    }
  }
  if (!(lambda_ >= 0.0 && lambda_ <= FLT_MAX)) {
    PCL_ERROR("[storey::%s] lambda is %g, expected >= 0.\n", getClassName(), lambda_);
    return false;
  }
  if (k_ < 1) {
    PCL_ERROR("[storey::%s] %d neighbours, expected >= 1.\n", getClassName(), k_);
    return false;
  }
  if (cell_size_ != 0.0 && !(cell_size_ >= FLT_MIN && cell_size_ <= FLT_MAX)) {
    PCL_ERROR("[storey::%s] cell size is %g, expected 0 or more.\n", getClassName(), cell_size_);
    return false;
  }
  return true;
}

template <typename PointT, typename NormalT>
void DominantDirectionLabeling<PointT, NormalT>::labelPoints(
    const detail::LabelPoints<Eigen::Vector3d>& points, pcl::PointCloud<pcl::Label>& labels) {
  double spacing = 0.0;
  const detail::PottsProblem problem = makeProblem(points, spacing);
  std::vector<std::size_t> label_of_point;
  if (per_point_) {
    label_of_point = detail::minimizePotts(problem);
  } else {
    constexpr double kPointsPerCell = 20.0;  // side^2 k / (pi spacing^2) on a wall
    used_cell_size_ =
        cell_size_ > 0.0 ? cell_size_ : spacing * std::sqrt(kPointsPerCell * M_PI / k_);
    label_of_point = minimizeOverCells(points, problem);
  }
  energy_ = detail::pottsEnergy(problem, label_of_point);

  labels.header = this->input_->header;
  labels.resize(this->indices_->size());
  for (pcl::Label& label : labels) {
    label.label = kUnlabeled;
  }
  for (std::size_t j = 0; j < points.size(); ++j) {
    labels[points.places[j]].label = static_cast<std::uint32_t>(label_of_point[j]);
  }
}

// The energy on the graph of the points. Spacing: the median distance to the k-th neighbour.
template <typename PointT, typename NormalT>
detail::PottsProblem DominantDirectionLabeling<PointT, NormalT>::makeProblem(
    const detail::LabelPoints<Eigen::Vector3d>& points, double& spacing) const {
  detail::PottsProblem problem;
  problem.num_labels = directions_.size();
  problem.data_costs.reserve(points.size() * directions_.size());
  for (const Eigen::Vector3d& normal : points.normals) {
    for (const Eigen::Vector3d& direction : directions_) {
      problem.data_costs.push_back((direction.normalized() - normal).squaredNorm());
    }
  }
  const detail::PositionSearch<PointT> search(*this->input_, points.indices, tree_);
  std::vector<std::size_t> first_at_site(search.numSites(), points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    std::size_t& first = first_at_site[search.siteOf(j)];
    if (first < points.size()) {
      problem.edges.push_back({first, j, lambda_});
    } else {
      first = j;
    }
  }
  pcl::Indices sites;
  std::vector<float> squared;
  std::vector<float> farthest;
  for (std::size_t site = 0; site < search.numSites(); ++site) {
    search.nearest(site, k_ + 1, sites, squared);
    for (const pcl::index_t other : sites) {
      if (static_cast<std::size_t>(other) != site) {
        const std::size_t neighbor = first_at_site[static_cast<std::size_t>(other)];
        problem.edges.push_back({first_at_site[site], neighbor, lambda_});
      }
    }
    farthest.push_back(squared.empty() ? 0.0F : *std::max_element(squared.begin(), squared.end()));
  }
  spacing = std::sqrt(detail::medianOf(farthest));
  return problem;
}

template <typename PointT, typename NormalT>
std::vector<std::size_t> DominantDirectionLabeling<PointT, NormalT>::minimizeOverCells(
    const detail::LabelPoints<Eigen::Vector3d>& points, const detail::PottsProblem& problem) const {
  constexpr std::size_t kLinksAcrossCell = 4;  // a cell is 2.8 times as long as the longest link
  std::vector<Eigen::Vector3d> positions;
  for (const pcl::index_t i : points.indices) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    positions.emplace_back(p.x, p.y, p.z);
  }
  const std::vector<std::size_t> cheapest = detail::cheapestLabels(problem);
  const std::vector<std::uint32_t> nearest(cheapest.begin(), cheapest.end());
  const double side = used_cell_size_ > 0.0 ? used_cell_size_ : 1.0;  // a single position: any
  const detail::CellPartition partition = detail::partitionIntoCells(positions, nearest, side);
  std::vector<std::size_t> cell_of_point(points.size());
  for (std::size_t c = 0; c < partition.cells.size(); ++c) {
    for (std::size_t place = partition.begin[c]; place < partition.begin[c + 1]; ++place) {
      cell_of_point[partition.order[place]] = c;
    }
  }
  const std::vector<std::size_t> label_of_cell =
      detail::minimizePotts(detail::aggregatePotts(problem, cell_of_point, partition.cells.size()));
  std::vector<std::size_t> labels;
  for (const std::size_t cell : cell_of_point) {
    labels.push_back(label_of_cell[cell]);
  }
  detail::moveBoundaries(problem, kLinksAcrossCell, labels);
  return labels;
}

}  // namespace storey
