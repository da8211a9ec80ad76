// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/indices.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/position_hash.h>
#include <storey/segmentation/detail/position_search.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link
#include <utility>

namespace storey {

namespace detail {

/// Whether a unit normal is no further from the horizontal than an angle with this sine.
inline bool isLevelNormal(const Eigen::Vector3d& normal, double greatest_sine) {
  return normal.head<2>().squaredNorm() > 0.0 && std::abs(normal.z()) <= greatest_sine;
}

}  // namespace detail

template <typename PointT, typename NormalT>
void DominantDirectionClustering<PointT, NormalT>::extract(
    std::vector<pcl::PointIndices>& clusters) {
  clusters.clear();
  directions_.clear();
  used_merge_angle_ = 0.0;
  if (!this->initCompute()) {
    return;
  }
  if (parametersValid() &&
      detail::indicesInside(*this->indices_, this->input_->size(), getClassName())) {
    const pcl::PointCloud<NormalT>* normals =
        detail::chooseNormals<PointT, NormalT>(*this->input_, normals_, getClassName());
    if (normals != nullptr) {
      clusterPoints(*normals, clusters);
    }
  }
  this->deinitCompute();
}

template <typename PointT, typename NormalT>
bool DominantDirectionClustering<PointT, NormalT>::parametersValid() const {
  if (smoothing_neighbors_ < 1) {
    PCL_ERROR("[storey::%s] %d smoothing neighbours, expected >= 1.\n", getClassName(),
              smoothing_neighbors_);
    return false;
  }
  if (!(merge_angle_ >= 0.0 && merge_angle_ < M_PI)) {
    PCL_ERROR("[storey::%s] merge angle is %g rad, expected [0, pi).\n", getClassName(),
              merge_angle_);
    return false;
  }
  if (!(max_tilt_ > 0.0 && max_tilt_ <= M_PI_2)) {
    PCL_ERROR("[storey::%s] max_tilt is %g rad, expected (0, pi/2].\n", getClassName(), max_tilt_);
    return false;
  }
  if (!(min_cluster_share_ >= 0.0 && min_cluster_share_ <= 1.0)) {
    PCL_ERROR("[storey::%s] least share of a cluster is %g, expected [0, 1].\n", getClassName(),
              min_cluster_share_);
    return false;
  }
  if (min_cluster_size_ > max_cluster_size_) {
    PCL_ERROR("[storey::%s] cluster size at least %zu and at most %zu.\n", getClassName(),
              min_cluster_size_, max_cluster_size_);
    return false;
  }
  return true;
}

template <typename PointT, typename NormalT>
void DominantDirectionClustering<PointT, NormalT>::clusterPoints(
    const pcl::PointCloud<NormalT>& normals, std::vector<pcl::PointIndices>& clusters) {
  detail::LabelPoints<Eigen::Vector3f> points = [&] {
    pcl::Indices indices = *this->indices_;
    if (!std::is_sorted(indices.begin(), indices.end())) {
      std::sort(indices.begin(), indices.end());
    }
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return detail::collectOrientedPoints<Eigen::Vector3f>(*this->input_, normals, indices);
  }();
  points.places = {};  // of no interest here

  const std::vector<std::size_t> sample = chooseSample(points);
  if (smoothing_neighbors_ > 1) {
    averageNormals(sample, points);
  }
  detail::AngleHistogram histogram;
  for (const std::size_t j : sample) {
    const Eigen::Vector3d normal = points.normals[j].cast<double>();
    if (detail::isLevelNormal(normal, std::sin(max_tilt_))) {
      histogram.add(std::atan2(normal.y(), normal.x()));
    }
  }
  const std::vector<Eigen::Vector3d> directions = findDirections(histogram);
  std::vector<pcl::PointIndices> found = assignPoints(points, directions);
  keepClusters(directions, found, clusters);
}

template <typename PointT, typename NormalT>
std::vector<std::size_t> DominantDirectionClustering<PointT, NormalT>::chooseSample(
    const detail::LabelPoints<Eigen::Vector3f>& points) const {
  constexpr std::uint64_t kAllHashes = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::size_t> sample;
  if (max_samples_ == 0 || points.size() <= max_samples_) {
    sample.resize(points.size());
    std::iota(sample.begin(), sample.end(), std::size_t{0});
    return sample;
  }
  // The least hashes; only those of about half as many again are kept and sorted.
  using Candidate = std::pair<std::uint64_t, std::size_t>;
  const double share = 1.5 * static_cast<double>(max_samples_) / static_cast<double>(points.size());
  std::uint64_t limit =
      share < 1.0 ? static_cast<std::uint64_t>(std::ldexp(share, 64)) : kAllHashes;
  std::vector<Candidate> candidates;
  while (candidates.size() < max_samples_) {
    std::vector<std::vector<Candidate>> of_chunk(detail::Chunks(points.size()).count());
    detail::forEachChunk(
        points.size(), threads_, [&](std::size_t c, std::size_t begin, std::size_t end) {
          for (std::size_t j = begin; j < end; ++j) {
            const PointT& p = (*this->input_)[static_cast<std::size_t>(points.indices[j])];
            const std::uint64_t hash = detail::hashOfPoint(
                Eigen::Vector3d(p.x, p.y, p.z), points.normals[j].template cast<double>());
            if (hash <= limit) {
              of_chunk[c].emplace_back(hash, j);
            }
          }
        });
    candidates.clear();
    for (const std::vector<Candidate>& some : of_chunk) {
      candidates.insert(candidates.end(), some.begin(), some.end());
    }
    limit = limit < kAllHashes / 2 ? 2 * limit : kAllHashes;
  }
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(max_samples_);
  std::nth_element(candidates.begin(), end, candidates.end());
  for (auto candidate = candidates.begin(); candidate != end; ++candidate) {
    sample.push_back(candidate->second);
  }
  return sample;
}

template <typename PointT, typename NormalT>
void DominantDirectionClustering<PointT, NormalT>::averageNormals(
    const std::vector<std::size_t>& sample, detail::LabelPoints<Eigen::Vector3f>& points) const {
  constexpr double kSameFace = 0.5;  // cos 60 degrees: 4 deviations of 15 degrees
  const detail::PositionSearch<PointT> search(*this->input_, points.indices, tree_, threads_);
  std::vector<Eigen::Vector3f> site_normals(search.numSites(), Eigen::Vector3f::Zero());
  for (std::size_t j = 0; j < points.size(); ++j) {
    site_normals[search.siteOf(j)] += points.normals[j];
  }
  if (search.numSites() < points.size()) {
    for (Eigen::Vector3f& normal : site_normals) {
      normal.normalize();  // leaves zero alone
    }
  }
  std::vector<std::size_t> queries = sample;  // in the order of sites: fast in the tree
  std::sort(queries.begin(), queries.end(), [&search](std::size_t i, std::size_t j) {
    return std::make_pair(search.siteOf(i), i) < std::make_pair(search.siteOf(j), j);
  });
  std::vector<Eigen::Vector3f> averages(queries.size());
#pragma omp parallel num_threads(detail::threadsFor(threads_))
  {
    pcl::Indices sites;
    std::vector<float> squared;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t q = 0; q < static_cast<std::ptrdiff_t>(queries.size()); ++q) {
      const std::size_t j = queries[static_cast<std::size_t>(q)];
      search.nearest(search.siteOf(j), smoothing_neighbors_, sites, squared);
      const Eigen::Vector3d own = points.normals[j].template cast<double>();
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const pcl::index_t site : sites) {
        const Eigen::Vector3d normal =
            site_normals[static_cast<std::size_t>(site)].template cast<double>();
        sum += normal.dot(own) >= kSameFace ? normal : Eigen::Vector3d(Eigen::Vector3d::Zero());
      }
      averages[static_cast<std::size_t>(q)] =
          (sum.squaredNorm() > 0.0 ? sum.normalized() : own).template cast<float>();
    }
  }
  for (std::size_t q = 0; q < queries.size(); ++q) {
    points.normals[queries[q]] = averages[q];
  }
}

template <typename PointT, typename NormalT>
std::vector<Eigen::Vector3d> DominantDirectionClustering<PointT, NormalT>::findDirections(
    const detail::AngleHistogram& histogram) {
  if (histogram.total() == 0) {
    return {};
  }
  const std::vector<detail::AngleCluster> bins = histogram.clusters();
  used_merge_angle_ =
      merge_angle_ > 0.0 ? merge_angle_ : detail::mergeAngleFor(detail::modeSpread(histogram));
  const double least = min_cluster_share_ * static_cast<double>(histogram.total());
  std::vector<detail::AngleCluster> kept;
  for (const detail::AngleCluster& cluster : detail::mergeOnCircle(bins, used_merge_angle_)) {
    if (cluster.weight >= least) {
      kept.push_back(cluster);
    }
  }
  std::vector<Eigen::Vector3d> directions;
  for (const double angle : detail::refineCenters(bins, kept)) {
    directions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return directions;
}

template <typename PointT, typename NormalT>
std::vector<pcl::PointIndices> DominantDirectionClustering<PointT, NormalT>::assignPoints(
    const detail::LabelPoints<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3d>& directions) const {
  const double least_cosine = std::cos(30.0 * M_PI / 180.0);  // 2.8 deviations of raw normals
  const double greatest_sine = std::sin(max_tilt_);
  std::vector<pcl::PointIndices> found(directions.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Eigen::Vector3d normal = points.normals[j].template cast<double>();
    if (!detail::isLevelNormal(normal, greatest_sine)) {
      continue;
    }
    std::size_t nearest = directions.size();
    double best = least_cosine * normal.head<2>().norm();
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const double along = directions[d].dot(normal);
      if (along > best || (along == best && nearest == directions.size())) {
        best = along;
        nearest = d;
      }
    }
    if (nearest < directions.size()) {
      found[nearest].indices.push_back(points.indices[j]);
    }
  }
  return found;
}

template <typename PointT, typename NormalT>
void DominantDirectionClustering<PointT, NormalT>::keepClusters(
    const std::vector<Eigen::Vector3d>& directions, std::vector<pcl::PointIndices>& found,
    std::vector<pcl::PointIndices>& clusters) {
  std::vector<std::size_t> order;
  for (std::size_t d = 0; d < found.size(); ++d) {
    const std::size_t size = found[d].indices.size();
    if (size > 0 && size >= min_cluster_size_ && size <= max_cluster_size_) {
      order.push_back(d);
    }
  }
  std::sort(order.begin(), order.end(), [&found](std::size_t a, std::size_t b) {
    const pcl::Indices& p = found[a].indices;
    const pcl::Indices& q = found[b].indices;
    return p.size() != q.size() ? p.size() > q.size() : p.front() < q.front();
  });
  for (const std::size_t d : order) {
    directions_.push_back(directions[d]);
    clusters.push_back(std::move(found[d]));
    clusters.back().header = this->input_->header;
  }
}

}  // namespace storey
