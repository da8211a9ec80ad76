// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/flat_face.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <map>

namespace storey {
namespace {

using detail::FlatRing;
using detail::FlatVertex;
using detail::orient;
using detail::Wide;
using Triangle = std::array<int, 3>;

// Whether the segment from a to b meets p but at its ends.
bool passesThrough(const FlatVertex& a, const FlatVertex& b, const FlatVertex& p) {
  if (p.at(a) || p.at(b) || orient(a, b, p) != 0) return false;
  return std::min(a.u, b.u) <= p.u && p.u <= std::max(a.u, b.u) && std::min(a.v, b.v) <= p.v &&
         p.v <= std::max(a.v, b.v);
}

// Whether the segment may not be a diagonal because of the edge from p to q.
bool blocks(const FlatVertex& p, const FlatVertex& q, const FlatVertex& a, const FlatVertex& b) {
  if (passesThrough(a, b, p)) return true;
  if ((p.at(a) && q.at(b)) || (p.at(b) && q.at(a))) return true;
  const Wide side_p = orient(a, b, p);
  const Wide side_q = orient(a, b, q);
  if (side_p == 0 || side_q == 0 || (side_p > 0) == (side_q > 0)) return false;
  const Wide side_a = orient(p, q, a);
  const Wide side_b = orient(p, q, b);
  return side_a != 0 && side_b != 0 && (side_a > 0) != (side_b > 0);
}

bool blockedBy(const FlatRing& ring, const FlatVertex& a, const FlatVertex& b) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (blocks(ring[i], ring[(i + 1) % ring.size()], a, b)) return true;
  }
  return false;
}

// Whether p is seen from corner c of a ring between the edges from `before` and to `after`.
bool insideCorner(const FlatVertex& before, const FlatVertex& c, const FlatVertex& after,
                  const FlatVertex& p) {
  const Wide turn = orient(before, c, after);
  const bool left_in = orient(before, c, p) > 0;
  const bool left_out = orient(c, after, p) > 0;
  if (turn > 0) return left_in && left_out;
  if (turn < 0) return left_in || left_out;
  const bool straight = static_cast<Wide>(before.u - c.u) * (after.u - c.u) +
                            static_cast<Wide>(before.v - c.v) * (after.v - c.v) <
                        0;
  // A spike (the end of a bridge) sees everything but the edge itself, which `blocks` refuses.
  return straight ? left_in : true;
}

// Joins holes to the outer ring by bridges, so that one ring remains that runs each bridge twice.
class HoleJoiner {
 public:
  explicit HoleJoiner(std::vector<FlatRing> rings) : rings_(std::move(rings)) {
    std::sort(rings_.begin() + 1, rings_.end(),
              [](const FlatRing& a, const FlatRing& b) { return leftmost(a) < leftmost(b); });
  }

  /// Empty if a hole cannot be reached.
  FlatRing join() {
    FlatRing joined = rings_[0];
    for (std::size_t left = rings_.size() - 1; left > 0; --left) {
      if (!joinTouching(joined) && !joinVisible(joined)) return {};
    }
    return joined;
  }

 private:
  static std::pair<std::int64_t, std::int64_t> leftmost(const FlatRing& ring) {
    std::pair<std::int64_t, std::int64_t> best(ring[0].u, ring[0].v);
    for (const FlatVertex& p : ring) best = std::min(best, {p.u, p.v});
    return best;
  }

  // A hole that touches the ring at a vertex must be joined there: a bridge elsewhere would cut
  // the face in two.
  bool joinTouching(FlatRing& joined) {
    for (std::size_t r = 1; r < rings_.size(); ++r) {
      for (std::size_t h = 0; h < rings_[r].size(); ++h) {
        for (std::size_t j = 0; j < joined.size(); ++j) {
          if (!joined[j].at(rings_[r][h]) || !cornerOpens(joined, j, rings_[r], h)) continue;
          insertHole(joined, j, r, h, true);
          return true;
        }
      }
    }
    return false;
  }

  // Whether the hole's edges at the common vertex lie within this corner of the ring.
  static bool cornerOpens(const FlatRing& joined, std::size_t j, const FlatRing& hole,
                          std::size_t h) {
    const std::size_t n = joined.size();
    return insideCorner(joined[(j + n - 1) % n], joined[j], joined[(j + 1) % n],
                        hole[(h + 1) % hole.size()]);
  }

  bool joinVisible(FlatRing& joined) {
    const FlatRing& hole = rings_[1];
    const auto by_place = [](const FlatVertex& a, const FlatVertex& b) {
      return std::tie(a.u, a.v) < std::tie(b.u, b.v);
    };
    const auto h = static_cast<std::size_t>(std::min_element(hole.begin(), hole.end(), by_place) -
                                            hole.begin());
    std::vector<std::size_t> order(joined.size());
    for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
    const auto distance = [&](std::size_t j) {
      const auto du = static_cast<double>(joined[j].u - hole[h].u);
      const auto dv = static_cast<double>(joined[j].v - hole[h].v);
      return du * du + dv * dv;
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::make_pair(distance(a), a) < std::make_pair(distance(b), b);
    });
    for (const std::size_t j : order) {
      if (!visible(joined, j, hole[h])) continue;
      insertHole(joined, j, 1, h, false);
      return true;
    }
    return false;
  }

  bool visible(const FlatRing& joined, std::size_t j, const FlatVertex& p) const {
    const std::size_t n = joined.size();
    if (!insideCorner(joined[(j + n - 1) % n], joined[j], joined[(j + 1) % n], p)) return false;
    if (blockedBy(joined, joined[j], p)) return false;
    return std::none_of(rings_.begin() + 1, rings_.end(),
                        [&](const FlatRing& ring) { return blockedBy(ring, joined[j], p); });
  }

  // After corner j: the hole from h all around, and back to corner j.
  void insertHole(FlatRing& joined, std::size_t j, std::size_t r, std::size_t h, bool touching) {
    FlatRing detour;
    const FlatRing& hole = rings_[r];
    for (std::size_t i = touching ? 1 : 0; i < hole.size(); ++i) {
      detour.push_back(hole[(h + i) % hole.size()]);
    }
    detour.push_back(hole[h]);
    if (!touching) detour.push_back(joined[j]);
    joined.insert(joined.begin() + static_cast<std::ptrdiff_t>(j) + 1, detour.begin(),
                  detour.end());
    rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(r));
  }

  std::vector<FlatRing> rings_;  // the outer one, and the holes that are left, from left to right
};

// Whether corner i can be cut off: convex, nothing else in the closed triangle.
bool isEar(const FlatRing& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const FlatVertex& a = ring[(i + n - 1) % n];
  const FlatVertex& b = ring[i];
  const FlatVertex& c = ring[(i + 1) % n];
  if (orient(a, b, c) <= 0) return false;
  if (n == 3) return true;
  for (const FlatVertex& p : ring) {
    if (p.at(a) || p.at(b) || p.at(c)) continue;
    if (orient(a, b, p) >= 0 && orient(b, c, p) >= 0 && orient(c, a, p) >= 0) return false;
  }
  return !blockedBy(ring, c, a);
}

std::vector<Triangle> clipEars(FlatRing ring) {
  std::vector<Triangle> triangles;
  std::size_t i = 0;
  std::size_t refused = 0;
  while (ring.size() >= 3) {
    const std::size_t n = ring.size();
    if (refused == n) return {};
    if (!isEar(ring, i)) {
      i = (i + 1) % n;
      ++refused;
      continue;
    }
    triangles.push_back({ring[(i + n - 1) % n].index, ring[i].index, ring[(i + 1) % n].index});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    if (ring.size() < 3) break;
    i = (i + 1) % ring.size();  // not the next corner: no fans
    refused = 0;
  }
  return triangles;
}

// Pieces of a face, merged across their common edges.
class PieceMerger {
 public:
  explicit PieceMerger(const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) pieces_.emplace_back(t.begin(), t.end());
    for (std::size_t p = 0; p < pieces_.size(); ++p) own(p);
  }

  std::vector<std::vector<int>> merge() {
    std::vector<std::pair<int, int>> diagonals;
    for (const auto& entry : owner_) {
      const std::pair<int, int> back(entry.first.second, entry.first.first);
      if (entry.first.first < entry.first.second && owner_.count(back) != 0) {
        diagonals.push_back(entry.first);
      }
    }
    for (const std::pair<int, int>& d : diagonals) mergeAcross(d.first, d.second);
    pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(),
                                 [](const std::vector<int>& piece) { return piece.empty(); }),
                  pieces_.end());
    return pieces_;
  }

 private:
  void own(std::size_t piece) {
    const std::vector<int>& ring = pieces_[piece];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      owner_[{ring[i], ring[(i + 1) % ring.size()]}] = piece;
    }
  }

  // Only where the two have nothing but this edge in common: the union is simple then.
  void mergeAcross(int a, int b) {
    const std::size_t left = owner_[{a, b}];
    const std::size_t right = owner_[{b, a}];
    if (left == right) return;
    std::vector<int> first = pieces_[left];
    std::vector<int> second = pieces_[right];
    std::rotate(first.begin(), std::find(first.begin(), first.end(), b), first.end());
    std::rotate(second.begin(), std::find(second.begin(), second.end(), a), second.end());
    for (std::size_t i = 1; i + 1 < second.size(); ++i) {
      if (std::find(first.begin(), first.end(), second[i]) != first.end()) return;
    }
    first.insert(first.end(), second.begin() + 1, second.end() - 1);  // b ... a, then up to b
    pieces_[left] = std::move(first);
    pieces_[right].clear();
    owner_.erase({a, b});
    owner_.erase({b, a});
    own(left);
  }

  std::vector<std::vector<int>> pieces_;
  std::map<std::pair<int, int>, std::size_t> owner_;  // directed edge -> piece
};

}  // namespace

std::vector<std::array<int, 3>> triangulateFace(const PolyhedralModel& model,
                                                const PolyhedralFace& face) {
  std::vector<FlatRing> rings = detail::flattenFace(model, face);
  if (!detail::isPolygon(rings)) return {};
  const FlatRing joined = HoleJoiner(std::move(rings)).join();
  return joined.empty() ? std::vector<Triangle>{} : clipEars(joined);
}

std::vector<std::vector<int>> splitHoles(const PolyhedralModel& model, const PolyhedralFace& face) {
  if (face.inner.empty()) return {face.outer};
  return PieceMerger(triangulateFace(model, face)).merge();
}

}  // namespace storey
