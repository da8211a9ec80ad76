// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/detail/points_by_wall.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGate = 4.0;  // noise deviations: points further off are of another wall
// Noise deviations: at corners points mix. Each wall loses about what it gets: at a right angle,
// all points beyond m sigma from the corner move a wall of length L by 0.25 sigma^2 / L for m = 0
// and 0.011 for 1.5.
constexpr double kEndMargin = 1.5;
constexpr double kSettled = 0.25;  // noise deviations

std::vector<WallFrame> framesOf(const std::vector<FloorplanLayer>& layers) {
  std::map<int, WallStretch> longest;
  for (const FloorplanLayer& layer : layers) {
    for (const WallStretch& stretch : stretchesOf(layer.plan)) {
      if (stretch.wall < 0) continue;
      const auto [known, added] = longest.emplace(stretch.wall, stretch);
      if (!added && stretch.length > known->second.length) known->second = stretch;
    }
  }
  std::vector<WallFrame> frames;
  for (const auto& [id, stretch] : longest) {
    frames.push_back({id, stretch.start + 0.5 * stretch.length * stretch.tangent,  //
                      stretch.normal()});
  }
  return frames;
}

// Whether the same walls meet at nearly the same corners, between nearly the same heights.
bool areAlike(const std::vector<FloorplanLayer>& before, const std::vector<FloorplanLayer>& now,
              double apart) {
  const auto likeLayer = [apart](const FloorplanLayer& a, const FloorplanLayer& b) {
    const auto likeStretch = [apart](const WallStretch& c, const WallStretch& d) {
      return c.wall == d.wall && (c.start - d.start).norm() < apart;
    };
    const std::vector<WallStretch> old = stretchesOf(a.plan);
    const std::vector<WallStretch> own = stretchesOf(b.plan);
    return std::abs(a.z_min - b.z_min) < apart && std::abs(a.z_max - b.z_max) < apart &&
           std::equal(old.begin(), old.end(), own.begin(), own.end(), likeStretch);
  };
  return std::equal(before.begin(), before.end(), now.begin(), now.end(), likeLayer);
}

// Finds the wall of a point, as the number of its frame.
class WallFinder {
 public:
  WallFinder(const std::vector<FloorplanLayer>& layers, const std::vector<WallFrame>& frames,
             double noise)
      : layers_(layers), margin_(kEndMargin * noise) {
    for (const FloorplanLayer& layer : layers) {
      std::vector<WallStretch> stretches = stretchesOf(layer.plan);
      for (WallStretch& stretch : stretches) {
        if (stretch.wall < 0) continue;
        const auto frame = std::lower_bound(frames.begin(), frames.end(), stretch.wall,
                                            [](const WallFrame& f, int id) { return f.id < id; });
        stretch.wall = static_cast<int>(frame - frames.begin());
      }
      indices_.emplace_back(std::move(stretches), kGate * noise);
    }
  }

  // -1 if the point is of none, or of one without an id.
  int wallOf(const Eigen::Vector3d& p, const Eigen::Vector3f& normal) const {
    if (!isWallNormal(normal)) return -1;
    const auto layer = std::upper_bound(
        layers_.begin(), layers_.end(), p.z(),
        [](double z, const FloorplanLayer& candidate) { return z < candidate.z_max; });
    if (layer == layers_.end() || p.z() < layer->z_min) return -1;
    const EdgeIndex& index = indices_[static_cast<std::size_t>(layer - layers_.begin())];
    const int edge = index.nearest(p.head<2>(), normal.head<2>().cast<double>(), margin_);
    return edge < 0 ? -1 : index[static_cast<std::size_t>(edge)].wall;
  }

 private:
  const std::vector<FloorplanLayer>& layers_;
  double margin_;
  std::vector<EdgeIndex> indices_;  // by layer
};

}  // namespace

bool PointsByWall::gather(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                          double noise, unsigned int threads) {
  if (!chunks_.empty() && areAlike(layers_, layers, kSettled * noise)) return false;
  layers_ = layers;
  frames_ = framesOf(layers);
  const WallFinder finder(layers, frames_, noise);
  const double middle = 0.5 * (layers.front().z_min + layers.back().z_max);
  chunks_.assign(Chunks(points.positions.size()).count(), {});
  const auto work = [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::vector<std::pair<int, WallPlace>> found;
    found.reserve(end - begin);
    Chunk& sorted = chunks_[chunk];
    sorted.first.assign(frames_.size() + 1, 0);
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = points.positions[i].cast<double>();
      const int wall = finder.wallOf(p, points.normals[i]);
      if (wall < 0) continue;
      const WallFrame& frame = frames_[static_cast<std::size_t>(wall)];
      const Eigen::Vector2d r = p.head<2>() - frame.reference;
      found.push_back(
          {wall,
           {static_cast<float>(r.dot(frame.tangent())), static_cast<float>(r.dot(frame.normal)),
            static_cast<float>(p.z() - middle)}});
      ++sorted.first[static_cast<std::size_t>(wall) + 1];
    }
    for (std::size_t k = 0; k < frames_.size(); ++k) sorted.first[k + 1] += sorted.first[k];
    sorted.places.resize(found.size());
    std::vector<std::size_t> next = sorted.first;
    for (const auto& [wall, place] : found) {
      sorted.places[next[static_cast<std::size_t>(wall)]++] = place;
    }
  };
  forEachChunk(points.positions.size(), threads, work);
  return true;
}

}  // namespace storey::detail
