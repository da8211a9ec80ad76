// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/divided_walls.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/detail/plan_rings.h>
#include <storey/surface/detail/wall_solving.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kFalseAlarms = 0.01;  // a building
constexpr double kInLine = 1.0;        // noise deviations
constexpr double kBreak = 3.0;         // noise deviations: shorter ones divide no wall

// Stretches along a wall, ascending, apart from each other.
using Pieces = std::vector<std::pair<double, double>>;

std::size_t pieceOf(const Pieces& pieces, double along) {
  const auto after = std::lower_bound(
      pieces.begin(), pieces.end(), along,
      [](const std::pair<double, double>& piece, double s) { return piece.second < s; });
  if (after == pieces.end()) return pieces.size() - 1;
  const auto k = static_cast<std::size_t>(after - pieces.begin());
  const bool nearer = k > 0 && along - pieces[k - 1].second < pieces[k].first - along;
  return nearer ? k - 1 : k;
}

// Of each wall. Stretches are one piece where no gap wider than `apart` lies between them.
std::vector<Pieces> piecesOf(const std::vector<WallFrame>& frames,
                             const std::vector<FloorplanLayer>& layers, double apart) {
  std::map<int, std::size_t> frame_of;
  for (std::size_t k = 0; k < frames.size(); ++k) frame_of[frames[k].id] = k;
  std::vector<Pieces> stretches(frames.size());
  for (const FloorplanLayer& layer : layers) {
    for (const WallStretch& stretch : stretchesOf(layer.plan)) {
      const auto known = frame_of.find(stretch.wall);
      if (known == frame_of.end()) continue;
      const WallFrame& frame = frames[known->second];
      const double a = frame.tangent().dot(stretch.start - frame.reference);
      stretches[known->second].push_back(
          std::minmax({a, a + stretch.length * frame.tangent().dot(stretch.tangent)}));
    }
  }
  std::vector<Pieces> pieces(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::sort(stretches[k].begin(), stretches[k].end());
    for (const auto& [from, to] : stretches[k]) {
      if (pieces[k].empty() || from > pieces[k].back().second + apart) {
        pieces[k].emplace_back(from, to);
      } else {
        pieces[k].back().second = std::max(pieces[k].back().second, to);
      }
    }
  }
  return pieces;
}

// Moments of the points of each piece, about the line of the wall.
struct PieceMoments {
  std::vector<WallMoments> pieces;

  PieceMoments& operator+=(const PieceMoments& other) {
    if (pieces.size() < other.pieces.size()) pieces.resize(other.pieces.size());
    for (std::size_t k = 0; k < other.pieces.size(); ++k) pieces[k] += other.pieces[k];
    return *this;
  }
};

// Of the points about the line that describes them best.
double sumOfSquares(const WallMoments& sums) {
  const double spread = sums.ss - sums.s * sums.s / sums.w;
  const double shear = sums.sd - sums.s * sums.d / sums.w;
  const double all = sums.dd - sums.d * sums.d / sums.w;
  return spread > 0.0 ? all - shear * shear / spread : all;
}

// What a chi-squared variable exceeds with no more than this probability (Laurent, Massart 2000).
double chiSquaredBound(double degrees, double probability) {
  const double x = -std::log(probability);
  return degrees + 2.0 * std::sqrt(degrees * x) + 2.0 * x;
}

// Whether one line describes the pieces as well as one each.
bool isOne(const std::vector<WallMoments>& pieces, double probability) {
  WallMoments all;
  double apart = 0.0;
  for (const WallMoments& piece : pieces) {
    all += piece;
    apart += sumOfSquares(piece);
  }
  const double gain = (sumOfSquares(all) - apart) * all.w / apart;
  return gain < chiSquaredBound(2.0 * static_cast<double>(pieces.size()) - 2.0, probability);
}

// Whether the line of the piece with most points passes the middles of all others. Where panes of
// windows are not as many on each, their points tell of one that nearly does.
bool areInLine(const std::vector<WallMoments>& pieces, double apart) {
  const WallMoments& most =
      *std::max_element(pieces.begin(), pieces.end(),
                        [](const WallMoments& a, const WallMoments& b) { return a.w < b.w; });
  const double spread = most.ss - most.s * most.s / most.w;
  const double slope = spread > 0.0 ? (most.sd - most.s * most.d / most.w) / spread : 0.0;
  return std::all_of(pieces.begin(), pieces.end(), [&](const WallMoments& piece) {
    const double along = piece.s / piece.w - most.s / most.w;
    return std::abs(piece.d / piece.w - most.d / most.w - slope * along) < apart;
  });
}

}  // namespace

bool divideWalls(const PointsByWall& by_wall, const std::map<int, WallFit>& fits, double noise,
                 unsigned int threads, std::vector<FloorplanLayer>& layers) {
  if (fits.empty()) return false;
  const std::vector<WallFrame>& frames = by_wall.frames();
  const std::vector<Pieces> pieces = piecesOf(frames, layers, kBreak * noise);
  const auto add = [&](std::size_t k, const WallPlace* begin, const WallPlace* end,
                       PieceMoments& sum) {
    if (pieces[k].size() < 2) return;
    sum.pieces.resize(pieces[k].size());
    const WallFrame& frame = frames[k];
    const WallFit& fit = fits.at(frame.id);
    const double offset = fit.normal.dot(frame.reference) - fit.offset;
    const double along = fit.normal.dot(frame.tangent());
    const double across = fit.normal.dot(frame.normal);
    for (const WallPlace* p = begin; p != end; ++p) {
      const auto s = static_cast<double>(p->along);
      const double d = offset + along * s + across * static_cast<double>(p->across);
      const double weight = tukeyWeight(d / noise);
      if (weight > 0.0) sum.pieces[pieceOf(pieces[k], s)].add(s, d, weight);
    }
  };
  const std::vector<PieceMoments> moments = by_wall.sum<PieceMoments>(threads, add);
  int next_id = frames.empty() ? 0 : frames.back().id + 1;
  bool any = false;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::vector<WallMoments>& sums = moments[k].pieces;
    const bool seen = std::all_of(sums.begin(), sums.end(), [](const WallMoments& piece) {
      return piece.support >= kMinWallSupport;
    });
    if (sums.size() < 2 || !seen || areInLine(sums, kInLine * noise)) continue;
    if (isOne(sums, kFalseAlarms / static_cast<double>(frames.size()))) continue;
    for (FloorplanLayer& layer : layers) {
      forEachRing(layer.plan, [&](FloorplanRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          if (ring.edges[i].wall != frames[k].id) continue;
          const Eigen::Vector2d middle =
              0.5 * (ring.vertices[i] + ring.vertices[(i + 1) % ring.size()]);
          const double s = frames[k].tangent().dot(middle - frames[k].reference);
          ring.edges[i].wall = next_id + static_cast<int>(pieceOf(pieces[k], s));
        }
      });
    }
    next_id += static_cast<int>(sums.size());
    any = true;
  }
  return any;
}

}  // namespace storey::detail
