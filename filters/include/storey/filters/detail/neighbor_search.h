// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>
#include <storey/filters/detail/bounding_box_tree.h>
#include <storey/filters/detail/distance_kernels.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace storey::detail {

/// The k nearest of a position, itself among them, by ascending id. The arrays belong to the
/// workspace: they live until its next search.
struct Neighborhood {
  pcl::index_t id = 0;
  std::array<float, 3> position{};
  std::size_t count = 0;
  const pcl::index_t* ids = nullptr;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;

  float squaredDistance(std::size_t i) const {
    const float dx = x[i] - position[0];
    const float dy = y[i] - position[1];
    const float dz = z[i] - position[2];
    return dx * dx + dy * dy + dz * dz;
  }
  /// Squared distance to the farthest.
  float squaredRadius() const;
};

/// The moments of up to `kLanes` neighbourhoods, a lane each.
struct MomentBatch {
  std::array<pcl::index_t, kLanes> ids;  ///< of the positions; -1: nothing in this lane
  std::size_t count = 0;                 ///< positions of a neighbourhood
  MomentLanes moments;
};

/// Exact nearest neighbours of the positions of a cloud, which stand in blocks along the Morton
/// curve under a tree of their bounding boxes. Where it is not proven that all neighbours lie
/// within the reach of a search, it is repeated with a reach that holds them.
///
/// Of equally far positions those with lower ids are taken, so that the result depends on the
/// positions alone.
class NeighborSearch {
 public:
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  using VisitMoments = std::function<void(const MomentBatch&)>;

  /// Memory for searches, one for each thread. What it remembers makes the next search faster, but
  /// does not change what it finds.
  struct Workspace {
    float squared_reach = 0.0f;               ///< of the neighbourhoods lately found; 0: none yet
    std::vector<std::uint32_t> leaves;        ///< within reach
    std::array<std::vector<float>, 6> boxes;  ///< their sides, padded
    std::vector<std::uint32_t> blocks;        ///< of the leaves, those near some position
    std::size_t num_blocks = 0;
    std::vector<float> squared, sorted;  ///< distances of their positions
    std::vector<Lanes> distances;        ///< squared, of the candidates of a batch
    std::vector<std::uint32_t> places;
    std::vector<pcl::index_t> ids;          ///< of the nearest
    std::array<std::vector<float>, 3> xyz;  ///< and where they are
  };

  /// O(n). \param positions distinct and searchable, in Morton order
  explicit NeighborSearch(const Cloud::ConstPtr& positions);

  std::size_t size() const { return size_; }

  /// The k nearest of position `id`, or all positions if there are fewer.
  Neighborhood nearest(pcl::index_t id, std::size_t k, Workspace& workspace) const;

  /// Visits the moments of the neighbourhoods of all positions marked in `wanted` (parallel to the
  /// positions), from several threads at once; many times faster than searches one by one. Moments
  /// are about the position itself, or about the first where the neighbours are all positions.
  void forEachMoments(std::size_t k, const std::vector<char>& wanted, unsigned int threads,
                      const VisitMoments& visit) const;

 private:
  friend class MomentVisits;

  Box boxOf(std::size_t id) const;
  bool gather(const Box& box, float reach, std::size_t most_leaves, Workspace& workspace) const;
  void chooseBlocks(const Box& box, float squared_reach, std::size_t k, Workspace& workspace) const;
  float searchAlone(std::size_t id, std::size_t k, Workspace& workspace) const;
  float take(std::size_t id, std::size_t k, float squared_reach, Workspace& workspace) const;
  std::size_t sizeOf(const std::uint32_t* blocks, std::size_t num_blocks) const;
  Coordinates coordinates() const { return {xyz_[0].data(), xyz_[1].data(), xyz_[2].data()}; }

  std::size_t size_;
  std::array<std::vector<float>, 3> xyz_;  // padded with infinity
  BoundingBoxTree tree_;
};

/// Moments of one neighbourhood in the first lane, added as `forEachMoments` does.
/// \param origin about which
MomentBatch momentsOf(const Neighborhood& neighborhood, const std::array<float, 3>& origin);

}  // namespace storey::detail
