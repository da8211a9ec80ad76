// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/threads.h>
#include <storey/segmentation/floorplan.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// A wall's plane as it was when its points were gathered: that of its longest edge.
struct WallFrame {
  int id = -1;
  Eigen::Vector2d reference;  // the edge's middle
  Eigen::Vector2d normal;     // unit, outwards

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
};

/// A point in the frame of its wall. Heights count from the middle of the building.
struct WallPlace {
  float along;
  float across;
  float height;
};

/// The points of each wall of a stack of floorplans, side by side, so that a round of fitting is a
/// pass over them and no search. A point is of the nearest wall in the layer at its height, within
/// four noise deviations and clear of the wall's ends, where the points of two walls mix; points of
/// walls without an id are left out.
class PointsByWall {
 public:
  /// Gathers the points, unless that was done for layers whose corners and heights differ by less
  /// than a quarter of the noise: what is gained or lost there is clear of any wall's middle.
  /// \return whether it was done
  bool gather(const std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
              unsigned int threads);

  /// By ascending id.
  const std::vector<WallFrame>& frames() const { return frames_; }

  /// What `work(k, begin, end, sum)` adds for runs of points of the wall in frame k, parallel to
  /// the frames.
  template <typename Sum, typename Work>
  std::vector<Sum> sum(unsigned int threads, const Work& work) const;

 private:
  /// Points that are neighbours in the cloud, wall by wall.
  struct Chunk {
    std::vector<WallPlace> places;
    std::vector<std::size_t> first;  // of each wall, and the end
  };

  std::vector<FloorplanLayer> layers_;
  std::vector<WallFrame> frames_;
  std::vector<Chunk> chunks_;
};

template <typename Sum, typename Work>
std::vector<Sum> PointsByWall::sum(unsigned int threads, const Work& work) const {
  const std::vector<Sum> zero(frames_.size());
  std::vector<std::vector<Sum>> parts(chunks_.size(), zero);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(chunks_.size()); ++i) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(i)];
    std::vector<Sum>& sums = parts[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      const WallPlace* places = chunk.places.data();
      work(k, places + chunk.first[k], places + chunk.first[k + 1], sums[k]);
    }
  }
  std::vector<Sum> sums = zero;
  for (const std::vector<Sum>& part : parts) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += part[k];
  }
  return sums;
}

/// `fitWalls` and `fitUpright` with points that may be gathered already.
std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options, PointsByWall& by_wall);
Eigen::Isometry3d fitUpright(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                             double noise, unsigned int threads, PointsByWall& by_wall);

}  // namespace storey::detail
