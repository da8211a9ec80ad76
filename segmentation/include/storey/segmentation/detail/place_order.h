// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>
#include <storey/filters/detail/chunks.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace storey::detail {

/// The indices of the finite points, neighbours near each other: column by column of the plan, and
/// by height in each. What is done for a point then mostly needs what the one before it needed.
template <typename PointT>
pcl::Indices orderByPlace(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          unsigned int threads) {
  constexpr std::uint32_t kSides = 64;  // cells along each axis
  constexpr std::uint32_t kNowhere = kSides * kSides * kSides;
  constexpr float kLeastExtent = 1e-30f;
  const auto placeOf = [&cloud](pcl::index_t i) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    return Eigen::Array3f(p.x, p.y, p.z);
  };
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::max());
  Eigen::Array3f high = -low;
  for (const pcl::index_t i : indices) {
    const Eigen::Array3f p = placeOf(i);
    if (!p.isFinite().all()) continue;
    low = low.min(p);
    high = high.max(p);
  }
  const Eigen::Array3f per_length =
      static_cast<float>(kSides) * (high - low).max(kLeastExtent).inverse();
  std::vector<std::uint32_t> cell(indices.size());
  forEachChunk(indices.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Array3f p = placeOf(indices[i]);
      cell[i] = kNowhere;
      if (!p.isFinite().all()) continue;
      const Eigen::Array3f at = (p - low) * per_length;
      const auto along = [&](int axis) {
        return std::min(kSides - 1, static_cast<std::uint32_t>(at[axis]));
      };
      cell[i] = (along(0) * kSides + along(1)) * kSides + along(2);
    }
  });
  std::vector<std::uint32_t> place(kNowhere + 1, 0);  // of the next point of each cell
  for (const std::uint32_t c : cell) {
    if (c != kNowhere) ++place[c + 1];
  }
  for (std::uint32_t c = 0; c < kNowhere; ++c) place[c + 1] += place[c];
  pcl::Indices order(place[kNowhere]);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] != kNowhere) order[place[cell[i]]++] = indices[i];
  }
  return order;
}

/// Whether the points come in such an order already, or along another curve: judged by the steps
/// from a thousand of them, evenly drawn, to the next.
template <typename PointT>
bool areByPlace(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  constexpr std::size_t kDrawn = 1000;
  constexpr float kShortStep = 1.0f / 64.0f;  // of the extent: a cell of `orderByPlace`
  if (indices.size() < kDrawn) return false;
  const auto placeOf = [&](std::size_t k) -> Eigen::Vector3f {
    return cloud[static_cast<std::size_t>(indices[k])].getVector3fMap();
  };
  Eigen::AlignedBox3f box;
  float steps = 0.0f;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kDrawn; ++i) {
    const std::size_t k = i * (indices.size() - 1) / kDrawn;
    const Eigen::Vector3f from = placeOf(k);
    const Eigen::Vector3f to = placeOf(k + 1);
    if (!from.allFinite() || !to.allFinite()) continue;
    box.extend(from);
    steps += (to - from).norm();
    ++count;
  }
  return count > 0 && steps < kShortStep * static_cast<float>(count) * box.diagonal().norm();
}

}  // namespace storey::detail
