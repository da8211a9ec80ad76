// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/detail/coplanar_regions.h>

#include <algorithm>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Two walls that meet at a vertical edge.
struct Candidate {
  bool different_walls;  // the same wall first
  int a;                 // elementary faces, a before b along the wall
  int b;

  bool operator<(const Candidate& o) const {
    return std::tie(different_walls, a, b) < std::tie(o.different_walls, o.a, o.b);
  }
};

class RegionFinder {
 public:
  RegionFinder(const PlanArrangement& plan, const BoundaryComplex& boundary,
               const std::vector<FloorplanEdge>& sources, std::int64_t strip,
               const std::vector<char>& counts)
      : plan_(plan),
        boundary_(boundary),
        sources_(sources),
        strip_(strip),
        counts_(counts),
        sets_(boundary.elements.size()),
        pieces_(boundary.elements.size()) {}

  std::vector<int> find(const std::vector<int>& known) {
    uniteExact();
    uniteKnown(known);
    collectPieces();
    uniteWalls();
    return number();
  }

 private:
  // Caps of a level, and walls above one another: coplanar without tolerance.
  void uniteExact() {
    for (std::size_t d = 0; d < boundary_.numDarts(); ++d) {
      const Element& face = boundary_.face(static_cast<int>(d));
      const Element& other = boundary_.face(boundary_.twin[d]);
      if (face.kind != other.kind) continue;
      if (face.kind != ElementKind::Wall || face.plan == other.plan) {
        sets_.unite(boundary_.element[d], boundary_.element[at(boundary_.twin[d])]);
      }
    }
  }

  void uniteKnown(const std::vector<int>& known) {
    std::vector<int> first(known.size(), -1);  // by region
    for (std::size_t i = 0; i < known.size(); ++i) {
      int& face = first[at(known[i])];
      if (face < 0) face = static_cast<int>(i);
      sets_.unite(face, static_cast<int>(i));
    }
  }

  void collectPieces() {
    for (std::size_t i = 0; i < boundary_.elements.size(); ++i) {
      const Element& face = boundary_.elements[i];
      if (face.kind == ElementKind::Wall) {
        pieces_[at(sets_.find(static_cast<int>(i)))].push_back(face.plan);
      }
    }
    for (std::vector<int>& pieces : pieces_) sortUnique(pieces);
  }

  static void sortUnique(std::vector<int>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  void uniteWalls() {
    for (const Candidate& c : candidates()) {
      const int a = sets_.find(c.a);
      const int b = sets_.find(c.b);
      if (a == b) continue;
      std::vector<int> both = pieces_[at(a)];
      both.insert(both.end(), pieces_[at(b)].begin(), pieces_[at(b)].end());
      sortUnique(both);
      if (!isStraight(both)) continue;
      sets_.unite(a, b);
      pieces_[at(sets_.find(a))] = std::move(both);
    }
  }

  // Within the strip, one piece after the other along it: neither turning back nor two ways side
  // by side at different heights.
  bool isStraight(const std::vector<int>& pieces) const {
    std::vector<GridPoint> points;
    std::vector<GridPoint> counting;
    GridPoint sum;
    for (const int h : pieces) {
      sum = sum + (plan_.to(h) - plan_.from(h));
      for (const int v : {plan_.origin[at(h)], plan_.target(h)}) {
        points.push_back(plan_.vertices[at(v)]);
        if (counts_[at(v)] != 0) counting.push_back(points.back());
      }
    }
    if (!withinStrip(counting, strip_)) return false;
    const auto [from, to] = findChord(points);
    const GridPoint chord = dot(to - from, sum) > 0 ? to - from : from - to;
    std::vector<std::pair<std::int64_t, std::int64_t>> spans;
    for (const int h : pieces) {
      spans.emplace_back(dot(chord, plan_.from(h)), dot(chord, plan_.to(h)));
      if (spans.back().second <= spans.back().first) return false;
    }
    std::sort(spans.begin(), spans.end());
    for (std::size_t i = 1; i < spans.size(); ++i) {
      if (spans[i].first < spans[i - 1].second) return false;
    }
    return true;
  }

  std::vector<Candidate> candidates() const {
    std::vector<Candidate> result;
    for (std::size_t d = 0; d < boundary_.numDarts(); ++d) {
      const int a = boundary_.element[d];
      const int b = boundary_.element[at(boundary_.twin[d])];
      const Element& first = boundary_.elements[at(a)];
      const Element& second = boundary_.elements[at(b)];
      if (first.kind != ElementKind::Wall || second.kind != ElementKind::Wall) continue;
      if (plan_.target(first.plan) != plan_.origin[at(second.plan)]) continue;
      const int wall = sources_[at(a)].wall;
      result.push_back({wall < 0 || wall != sources_[at(b)].wall, a, b});
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  std::vector<int> number() {
    std::vector<int> region(boundary_.elements.size());
    int count = 0;
    for (int i = 0; i < static_cast<int>(region.size()); ++i) {
      const int root = sets_.find(i);
      region[at(i)] = root == i ? count++ : region[at(root)];
    }
    return region;
  }

  const PlanArrangement& plan_;
  const BoundaryComplex& boundary_;
  const std::vector<FloorplanEdge>& sources_;
  std::int64_t strip_;
  const std::vector<char>& counts_;
  UnionFind<int> sets_;
  std::vector<std::vector<int>> pieces_;  // half-edges of a region of walls, at its representative
};

}  // namespace

std::vector<int> findCoplanarRegions(const PlanArrangement& plan, const BoundaryComplex& boundary,
                                     const std::vector<FloorplanEdge>& sources, std::int64_t strip,
                                     const std::vector<int>& known,
                                     const std::vector<char>& counts) {
  return RegionFinder(plan, boundary, sources, strip, counts).find(known);
}

}  // namespace detail
}  // namespace storey
