// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/detail/level_evidence.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kGate = 4.0;        // noise deviations across the wall
constexpr double kEndMargin = 3.0;   // noise deviations that a wall may seem longer than it is
constexpr double kMinStretch = 6.0;  // noise deviations: shorter ends of walls tell nothing
constexpr double kReference = 30.0;  // noise deviations of height that give the density
constexpr double kMixingGap = 8.0;   // noise deviations: gates of two walls, side by side
constexpr double kSameSense = 0.7;   // cosine of 45 degrees

using Stretches = std::vector<WallStretch>;

WallStretch part(const WallStretch& stretch, double from, double to) {
  return {stretch.start + from * stretch.tangent, stretch.tangent, to - from, stretch.wall};
}

// The parts of a layer's walls that an edge of the same wall covers in the other layer, and those
// that none does.
struct SplitStretches {
  Stretches covered;
  Stretches uncovered;
};

SplitStretches split(const Stretches& stretches, const Stretches& others) {
  SplitStretches result;
  for (const WallStretch& stretch : stretches) {
    std::vector<std::pair<double, double>> covers;
    for (const WallStretch& other : others) {
      if (other.wall < 0 || other.wall != stretch.wall) continue;
      const double a = (other.start - stretch.start).dot(stretch.tangent);
      const double b = a + other.length * other.tangent.dot(stretch.tangent);
      covers.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(covers.begin(), covers.end());
    covers.emplace_back(stretch.length, stretch.length);
    double from = 0.0;
    for (const auto& [begin, end] : covers) {
      const double to = std::min(begin, stretch.length);
      if (to > from) result.uncovered.push_back(part(stretch, from, to));
      const double until = std::min(end, stretch.length);
      from = std::max({from, to, 0.0});
      if (until > from) result.covered.push_back(part(stretch, from, until));
      from = std::max(from, until);
    }
  }
  return result;
}

// Whether a wall of the other layer runs so close beside the stretch that points of both mix.
bool hasCloseNeighbor(const WallStretch& stretch, const Stretches& others, double gap) {
  return std::any_of(others.begin(), others.end(), [&](const WallStretch& other) {
    if (other.wall == stretch.wall || other.tangent.dot(stretch.tangent) < kSameSense) return false;
    const double a = (other.start - stretch.start).dot(stretch.tangent);
    const double b = a + other.length * other.tangent.dot(stretch.tangent);
    return std::abs((other.start - stretch.start).dot(stretch.normal())) < gap &&
           std::min(b, stretch.length) > std::max(a, 0.0);
  });
}

// The walls around one level.
class LevelWalls {
 public:
  LevelWalls(const Stretches& below, const Stretches& above, double noise)
      : LevelWalls(split(below, above), split(above, below), below, above, noise) {}

  // Notes what a point of a wall tells of the level. Of a wall that may go on it tells nothing.
  void note(const Eigen::Vector3d& point, const Eigen::Vector2d& normal,
            LevelEvidence& level) const {
    const int nearest = all_.nearest(point.head<2>(), normal, 0.0);
    if (nearest < 0 || lists_[static_cast<std::size_t>(nearest)] == List::None) return;
    if (going_.nearest(point.head<2>(), normal, 0.0) >= 0) return;
    const bool mixed = mixed_[static_cast<std::size_t>(nearest)] != 0;
    const bool ends = lists_[static_cast<std::size_t>(nearest)] == List::Ends;
    (ends ? level.ends : level.starts)[mixed].add(point.z());
  }

 private:
  enum class List { None, Ends, Starts };

  LevelWalls(const SplitStretches& lower, const SplitStretches& upper, const Stretches& below,
             const Stretches& above, double noise)
      : all_(joined(lower, upper), kGate * noise), going_(lengthened(lower, noise), kGate * noise) {
    const auto classify = [&](const SplitStretches& own, const Stretches& others, List list) {
      for (const WallStretch& stretch : own.uncovered) {
        lists_.push_back(stretch.length > kMinStretch * noise ? list : List::None);
        mixed_.push_back(hasCloseNeighbor(stretch, others, kMixingGap * noise));
      }
    };
    classify(lower, above, List::Ends);
    classify(upper, below, List::Starts);
    lists_.resize(all_.size(), List::None);
    mixed_.resize(all_.size(), 0);
  }

  static Stretches joined(const SplitStretches& lower, const SplitStretches& upper) {
    Stretches all = lower.uncovered;
    for (const Stretches* more : {&upper.uncovered, &lower.covered, &upper.covered}) {
      all.insert(all.end(), more->begin(), more->end());
    }
    return all;
  }

  // Points near the ends of a wall that goes on seem to lie beside it.
  static Stretches lengthened(const SplitStretches& lower, double noise) {
    Stretches going = lower.covered;
    for (WallStretch& s : going) {
      s = part(s, -kEndMargin * noise, s.length + kEndMargin * noise);
    }
    return going;
  }

  EdgeIndex all_;  // what ends, what starts, what goes on, in this order
  EdgeIndex going_;
  std::vector<List> lists_;
  std::vector<char> mixed_;
};

// Level k lies below layer k; level n is the top. Its window reaches into its neighbours by the
// search range and, on the side of the wall, by the height that gives the density.
std::vector<LevelEvidence> makeLevels(const std::vector<FloorplanLayer>& layers,
                                      const FitOptions& options) {
  std::vector<LevelEvidence> levels;
  const double reach = options.max_shift + kReference * options.noise;
  for (std::size_t k = 0; k <= layers.size(); ++k) {
    const double guess = k < layers.size() ? layers[k].z_min : layers.back().z_max;
    // Half of a thin layer belongs to its other boundary.
    const double below = k > 0 ? 0.5 * (layers[k - 1].z_max - layers[k - 1].z_min) : reach;
    const double above = k < layers.size() ? 0.5 * (layers[k].z_max - layers[k].z_min) : reach;
    levels.emplace_back(guess, guess - std::min(reach, std::max(below, 0.5 * options.max_shift)),
                        guess + std::min(reach, std::max(above, 0.5 * options.max_shift)),
                        options.noise);
  }
  return levels;
}

// Whether a level face that looks up (or down) lies over the point at level k.
bool isCap(const std::vector<FloorplanLayer>& layers, std::size_t k, const Eigen::Vector2d& point,
           bool up) {
  const bool below = k > 0 && contains(layers[k - 1].plan, point);
  if (below != up) return false;
  return (k < layers.size() && contains(layers[k].plan, point)) != up;
}

}  // namespace

LevelEvidence::LevelEvidence(double level, double from, double to, double noise)
    : guess(level), low(from), high(to), caps(from, to, noise) {
  ends.fill(caps);
  starts.fill(caps);
}

LevelEvidence& LevelEvidence::operator+=(const LevelEvidence& other) {
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] += other.ends[i];
    starts[i] += other.starts[i];
  }
  caps += other.caps;
  return *this;
}

std::vector<LevelEvidence> collectLevelEvidence(const std::vector<FloorplanLayer>& layers,
                                                const FitPoints& points,
                                                const FitOptions& options) {
  const std::vector<LevelEvidence> levels = makeLevels(layers, options);
  std::vector<LevelWalls> walls;
  const std::size_t n = layers.size();
  for (std::size_t k = 0; k <= n; ++k) {
    walls.emplace_back(k > 0 ? stretchesOf(layers[k - 1].plan) : Stretches(),
                       k < n ? stretchesOf(layers[k].plan) : Stretches(), options.noise);
  }
  const auto note = [&](const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                        std::vector<LevelEvidence>& notes) {
    const Eigen::Vector3d p = position.cast<double>();
    const bool of_wall = isWallNormal(normal);
    // Levels are sorted, and windows overlap only with their neighbours'.
    auto level = std::lower_bound(notes.begin(), notes.end(), p.z(),
                                  [](const LevelEvidence& l, double z) { return l.high < z; });
    for (; level != notes.end() && level->low <= p.z(); ++level) {
      const auto k = static_cast<std::size_t>(level - notes.begin());
      if (of_wall) {
        walls[k].note(p, normal.head<2>().cast<double>(), *level);
      } else if (isCap(layers, k, p.head<2>(), normal.z() > 0.0f)) {
        level->caps.add(p.z());
      }
    }
  };
  return sumByChunks(points.positions.size(), options.threads, levels,
                     [&](std::size_t begin, std::size_t end, std::vector<LevelEvidence>& notes) {
                       for (std::size_t i = begin; i < end; ++i) {
                         note(points.positions[i], points.normals[i], notes);
                       }
                     });
}

}  // namespace storey::detail
