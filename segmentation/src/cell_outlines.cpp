// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/cell_labels.h>
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kMinCrossing = 0.1;      // sine: flatter lines meet anywhere
constexpr double kSeenShare = 1.0 / 3.0;  // of a wall that is not hypothetical

// Gives points closer than the tolerance one number.
class VertexNames {
 public:
  explicit VertexNames(double tolerance) : cell_(4.0 * tolerance), tolerance_(tolerance) {}

  int nameOf(const Eigen::Vector2d& p) {
    const auto x = static_cast<long long>(std::floor(p.x() / cell_));
    const auto y = static_cast<long long>(std::floor(p.y() / cell_));
    for (long long dx = -1; dx <= 1; ++dx) {
      for (long long dy = -1; dy <= 1; ++dy) {
        const auto [begin, end] = names_.equal_range({x + dx, y + dy});
        for (auto it = begin; it != end; ++it) {
          if ((points_[static_cast<std::size_t>(it->second)] - p).norm() < tolerance_) {
            return it->second;
          }
        }
      }
    }
    names_.emplace(std::make_pair(x, y), static_cast<int>(points_.size()));
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  const Eigen::Vector2d& operator[](int name) const {
    return points_[static_cast<std::size_t>(name)];
  }

 private:
  double cell_;
  double tolerance_;
  std::multimap<std::pair<long long, long long>, int> names_;
  std::vector<Eigen::Vector2d> points_;
};

// A piece of the boundary with the inside on its left.
struct BoundaryEdge {
  int from = 0;
  int to = 0;
  int wall = 0;
  double length = 0.0;
  double seen = 0.0;  // length confirmed by points
  bool used = false;
};

std::vector<BoundaryEdge> boundaryOf(const LineArrangement& plan, const CellBlock& block,
                                     VertexNames& names) {
  std::vector<BoundaryEdge> edges;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    const bool behind = block.inside[static_cast<std::size_t>(edge.behind)] != 0;
    const bool ahead = block.inside[static_cast<std::size_t>(edge.ahead)] != 0;
    if (behind == ahead) continue;
    const PlanLine& line = plan.lines[static_cast<std::size_t>(edge.line)];
    const Eigen::Vector2d foot = line.offset * line.normal;
    const int low = names.nameOf(foot + edge.s_min * line.tangent());
    const int high = names.nameOf(foot + edge.s_max * line.tangent());
    if (low == high) continue;
    BoundaryEdge piece;
    piece.from = behind ? low : high;
    piece.to = behind ? high : low;
    piece.wall = 2 * edge.line + (behind ? 0 : 1);
    piece.length = edge.length();
    piece.seen = piece.length * std::max(0.0, (behind ? 1.0 : -1.0) * block.coverage[e]);
    edges.push_back(piece);
  }
  return edges;
}

// At a vertex where two parts touch, the leftmost turn stays with the own part.
BoundaryEdge* nextEdge(const BoundaryEdge& edge, const VertexNames& names,
                       std::multimap<int, BoundaryEdge*>& starts) {
  const Eigen::Vector2d in = names[edge.to] - names[edge.from];
  BoundaryEdge* best = nullptr;
  double best_turn = 0.0;
  const auto [begin, end] = starts.equal_range(edge.to);
  for (auto it = begin; it != end; ++it) {
    if (it->second->used) continue;
    const Eigen::Vector2d out = names[it->second->to] - names[it->second->from];
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    if (best == nullptr || turn > best_turn) {
      best = it->second;
      best_turn = turn;
    }
  }
  return best;
}

// One vertex for each change of the wall along a closed chain of pieces.
FloorplanRing toRing(const std::vector<const BoundaryEdge*>& chain, const VertexNames& names) {
  FloorplanRing ring;
  std::size_t first = 0;
  while (first < chain.size() &&
         chain[first]->wall == chain[(first + chain.size() - 1) % chain.size()]->wall) {
    ++first;
  }
  double length = 0.0;
  double seen = 0.0;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const BoundaryEdge& piece = *chain[(first + k) % chain.size()];
    const BoundaryEdge& before = *chain[(first + k + chain.size() - 1) % chain.size()];
    if (k == 0 || piece.wall != before.wall) {
      if (k > 0) ring.edges.back().hypothetical = seen < kSeenShare * length;
      ring.vertices.push_back(names[piece.from]);
      ring.edges.push_back({piece.wall, false});
      length = 0.0;
      seen = 0.0;
    }
    length += piece.length;
    seen += piece.seen;
  }
  if (!ring.edges.empty()) ring.edges.back().hypothetical = seen < kSeenShare * length;
  return ring;
}

// Where three lines nearly meet, the cut may go round the wrong side of the small cell between
// them: it is right to the noise, but has a corner too many. An edge shorter than `length` whose
// neighbours then meet nearby goes.
void dropShortEdges(double length, FloorplanRing& ring) {
  const auto lineThrough = [&](std::size_t i, Eigen::Vector2d& normal, double& offset) {
    const Eigen::Vector2d along = ring.vertices[(i + 1) % ring.size()] - ring.vertices[i];
    normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    offset = normal.dot(ring.vertices[i]);
  };
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const std::size_t n = ring.size();
    const std::size_t next = (i + 1) % n;
    Eigen::Vector2d n1, n2;
    double d1 = 0.0, d2 = 0.0;
    lineThrough((i + n - 1) % n, n1, d1);
    lineThrough(next, n2, d2);
    const double det = n1.x() * n2.y() - n1.y() * n2.x();
    const Eigen::Vector2d meet((d1 * n2.y() - d2 * n1.y()) / det,
                               (n1.x() * d2 - n2.x() * d1) / det);
    const bool drops = (ring.vertices[next] - ring.vertices[i]).norm() < length &&
                       std::abs(det) > kMinCrossing && (meet - ring.vertices[i]).norm() < length &&
                       (meet - ring.vertices[next]).norm() < length;
    if (!drops) {
      ++i;
      continue;
    }
    ring.vertices[next] = meet;
    ring.vertices.erase(ring.vertices.begin() + static_cast<std::ptrdiff_t>(i));
    ring.edges.erase(ring.edges.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

Floorplan outlineOf(const LineArrangement& plan, const CellBlock& block, double tolerance,
                    double short_edge, double min_area) {
  VertexNames names(tolerance);
  std::vector<BoundaryEdge> edges = boundaryOf(plan, block, names);
  std::multimap<int, BoundaryEdge*> starts;
  for (BoundaryEdge& edge : edges) starts.emplace(edge.from, &edge);
  std::vector<FloorplanRing> rings;
  for (BoundaryEdge& edge : edges) {
    std::vector<const BoundaryEdge*> chain;
    for (BoundaryEdge* piece = &edge; piece != nullptr && !piece->used;
         piece = nextEdge(*piece, names, starts)) {
      piece->used = true;
      chain.push_back(piece);
    }
    if (chain.empty() || chain.back()->to != chain.front()->from) continue;
    FloorplanRing ring = toRing(chain, names);
    dropShortEdges(short_edge, ring);
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return assembleFloorplan(rings, min_area);
}

}  // namespace storey::detail
