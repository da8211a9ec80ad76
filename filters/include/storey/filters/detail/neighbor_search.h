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

/// The k nearest of a position, itself among them, by ascending id. The arrays are padded with the
/// first to a multiple of `kLanes`, and belong to the workspace: they live until its next search.
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
  /// About the first, so that equal neighbourhoods have equal moments.
  Moments moments() const;
};

/// Exact nearest neighbours of all positions of a cloud, several times faster than one by one in a
/// k-d tree: positions that follow each other on the Morton curve share their candidates, which lie
/// in plain arrays; the distance to the k-th is found by counting, without a heap. Where it is not
/// proven that all neighbours are among the candidates, the search is repeated in a box that holds
/// the ball.
///
/// Of equally far positions those with lower ids are taken, so that the result depends on the
/// positions alone.
class NeighborSearch {
 public:
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  using Visit = std::function<void(const Neighborhood&)>;

  /// Positions in plain arrays, padded with infinity to a multiple of `kLanes`. The arrays only
  /// grow: the first `padded()` entries count.
  struct Candidates {
    std::vector<float> x, y, z;
    std::vector<pcl::index_t> ids;
    std::size_t count = 0;

    void resize(std::size_t size);
    std::size_t padded() const;
  };

  /// Memory for searches, one for each thread. What it remembers makes the next search faster, but
  /// does not change what it finds.
  struct Workspace {
    float squared_reach = 0.0f;  ///< of the neighbourhoods lately found; 0: none yet
    std::vector<std::uint32_t> leaves, places;
    Candidates in_leaves, candidates, nearest;
    std::vector<float> squared, sorted;  ///< squared distances of the candidates
  };

  /// O(n). \param positions distinct and searchable, in Morton order
  explicit NeighborSearch(const Cloud::ConstPtr& positions);

  /// The k nearest of position `id`, or all positions if there are fewer.
  Neighborhood nearest(pcl::index_t id, std::size_t k, Workspace& workspace) const;

  /// Visits the neighbourhoods of all positions marked in `wanted` (parallel to the positions),
  /// from several threads at once.
  void forEach(std::size_t k, const std::vector<char>& wanted, unsigned int threads,
               const Visit& visit) const;

 private:
  // Positions that share their candidates.
  struct Group {
    std::array<std::uint32_t, 64> ids;
    std::size_t count = 0;
    Box box;
    float squared_reach = 0.0f;  // within which the neighbours of those that are left lie
  };

  std::size_t nextGroup(std::size_t id, std::size_t end, const std::vector<char>& wanted,
                        const Workspace& workspace, Group& group) const;
  void visitGroup(Group& group, std::size_t k, Workspace& workspace, const Visit& visit) const;
  void divideGroup(const Group& group, std::size_t k, Workspace& workspace,
                   const Visit& visit) const;
  bool visitTogether(Group& group, float squared_reach, std::size_t k, Workspace& workspace,
                     const Visit& visit) const;
  Box boxOf(std::size_t begin, std::size_t end) const;
  bool gather(const Box& box, float reach, std::size_t most_leaves, Workspace& workspace) const;
  void fillFromLeaves(Workspace& workspace) const;
  Neighborhood searchAlone(std::size_t id, std::size_t k, Workspace& workspace) const;
  Neighborhood take(std::size_t id, std::size_t k, Workspace& workspace) const;

  Cloud::ConstPtr positions_;
  BoundingBoxTree tree_;
};

}  // namespace storey::detail
