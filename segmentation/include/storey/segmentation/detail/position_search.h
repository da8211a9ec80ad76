// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/search/search.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/neighbor_search.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace storey::detail {

/// The median of the values (the upper of two); 0 if there are none.
inline double medianOf(std::vector<float>& values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// Nearest neighbours among the different positions ("sites") of some points of a cloud. Copies of
/// one position share a site, so that no number of them slows a query down. Sites are numbered
/// along a Morton curve: queries in that order are fast, and the numbers do not depend on the order
/// of the points.
template <typename PointT>
class PositionSearch {
 public:
  using Tree = pcl::search::Search<PointT>;

  /// \param points indices into `cloud`, all with searchable positions
  /// \param tree is given the sites as its input cloud; null: a search of our own
  /// \param threads that order the sites, 0: all cores
  PositionSearch(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& points,
                 const typename Tree::Ptr& tree, unsigned int threads = 1)
      : given_tree_(tree) {
    std::vector<Eigen::Vector3f> positions;
    positions.reserve(points.size());
    for (const pcl::index_t i : points) {
      const PointT& p = cloud[static_cast<std::size_t>(i)];
      positions.emplace_back(p.x, p.y, p.z);
    }
    DistinctPositions distinct = findDistinctPositions(std::move(positions), threads);
    distinct.multiplicity = {};  // its memory is wanted
    const pcl::PointCloud<pcl::PointXYZ>::ConstPtr sites = distinct.cloud;
    site_of_point_ = std::move(distinct.id_of_input);
    num_sites_ = sites->size();
    if (sites->empty()) {
      return;
    }
    if (given_tree_) {
      auto given_sites = pcl::make_shared<pcl::PointCloud<PointT>>();
      for (const pcl::PointXYZ& site : *sites) {
        given_sites->emplace_back();
        given_sites->back().getVector3fMap() = site.getVector3fMap();
      }
      given_sites_ = given_sites;
      given_tree_->setInputCloud(given_sites_);
    } else {
      search_ = std::make_unique<NeighborSearch>(sites);
    }
  }

  std::size_t numSites() const { return num_sites_; }

  /// The site of the j-th of the points.
  std::size_t siteOf(std::size_t j) const { return static_cast<std::size_t>(site_of_point_[j]); }

  /// The k sites nearest to a site (itself one of them) with their squared distances; fewer if
  /// there are no more. Safe in several threads at once.
  void nearest(std::size_t site, int k, pcl::Indices& sites, std::vector<float>& squared) const {
    if (given_tree_) {
      given_tree_->nearestKSearch((*given_sites_)[site], k, sites, squared);
    } else {
      thread_local NeighborSearch::Workspace workspace;
      const Neighborhood found =
          search_->nearest(static_cast<pcl::index_t>(site), static_cast<std::size_t>(k), workspace);
      sites.assign(found.ids, found.ids + found.count);
      squared.resize(found.count);
      for (std::size_t i = 0; i < found.count; ++i) squared[i] = found.squaredDistance(i);
    }
  }

  /// Distance to the k-th nearest other site, the median over at most about `max_queries` sites; 0
  /// if there is one site only.
  double medianSpacing(int k, std::size_t max_queries) const {
    const std::size_t stride = std::max<std::size_t>(1, numSites() / max_queries);
    std::vector<float> farthest;
    pcl::Indices sites;
    std::vector<float> squared;
    for (std::size_t site = 0; site < numSites(); site += stride) {
      nearest(site, k + 1, sites, squared);
      if (!squared.empty()) {
        farthest.push_back(*std::max_element(squared.begin(), squared.end()));
      }
    }
    return std::sqrt(medianOf(farthest));
  }

 private:
  typename Tree::Ptr given_tree_;
  typename pcl::PointCloud<PointT>::ConstPtr given_sites_;
  std::unique_ptr<NeighborSearch> search_;
  std::size_t num_sites_ = 0;
  pcl::Indices site_of_point_;
};

}  // namespace storey::detail
