// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/coplanar_regions.h>
#include <storey/surface/detail/face_merging.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

using Ring = std::vector<int>;  // umbrellas

// What is summed up over the elementary faces of a region.
struct RegionFacts {
  int first = -1;                      // elementary face
  bool stands_on_nothing = true;       // cap down: neither supported nor above a part
  std::map<int, double> area_of_wall;  // by wall id
  double hypothetical_area = 0.0;
  double seen_area = 0.0;
  std::vector<Ring> rings;
};

class FaceMerger {
 public:
  FaceMerger(const PlanArrangement& plan, const SlabLabels& labels, const BoundaryComplex& boundary,
             const std::vector<FloorplanEdge>& sources, const Lattice& lattice, std::int64_t strip)
      : plan_(plan),
        labels_(labels),
        boundary_(boundary),
        sources_(sources),
        lattice_(lattice),
        strip_(strip),
        kept_(boundary.umbrella_corner.size(), 0),
        corner_kept_(plan.vertices.size() * at(labels.numLevels()), 0) {}

  PolyhedralModel merge() {
    std::vector<char> counts(plan_.vertices.size(), 1);
    region_ = findCoplanarRegions(plan_, boundary_, sources_, strip_, {}, counts);
    keepCorners();
    // Once more: what is exactly coplanar but for the corners that went.
    for (std::size_t v = 0; v < counts.size(); ++v) counts[v] = vertexKept(v);
    region_ = findCoplanarRegions(plan_, boundary_, sources_, 0, region_, counts);
    keepCorners();
    collectFacts();
    traceRings();
    for (const RegionFacts& facts : facts_) keepDegenerateRings(facts);
    while (keepBentRuns()) {
    }
    for (RegionFacts& facts : facts_) simplifyRings(facts);
    return assemble();
  }

 private:
  int regionOf(int dart) const { return region_[at(boundary_.element[at(dart)])]; }
  bool onBorder(int dart) const { return regionOf(dart) != regionOf(boundary_.twin[at(dart)]); }
  int level(int corner) const { return corner % labels_.numLevels(); }
  const GridPoint& plan(int corner) const {
    return plan_.vertices[at(corner / labels_.numLevels())];
  }
  int cornerOf(int umbrella) const { return boundary_.umbrella_corner[at(umbrella)]; }

  // The next dart along the border of the region.
  int nextOnBorder(int dart) const {
    int next = boundary_.next[at(dart)];
    while (!onBorder(next)) next = boundary_.next[at(boundary_.twin[at(next)])];
    return next;
  }

  // Where two polygons meet in a line nothing is lost without the corner.
  void keepCorners() {
    std::fill(kept_.begin(), kept_.end(), 0);
    std::fill(corner_kept_.begin(), corner_kept_.end(), 0);
    std::vector<int> borders(kept_.size(), 0);
    for (int d = 0; d < static_cast<int>(boundary_.numDarts()); ++d) {
      if (onBorder(d)) ++borders[at(boundary_.umbrella[at(d)])];
    }
    for (std::size_t u = 0; u < kept_.size(); ++u) {
      if (borders[u] > 2) keep(static_cast<int>(u));
    }
  }

  // At any level.
  char vertexKept(std::size_t vertex) const {
    const auto first =
        corner_kept_.begin() + static_cast<std::ptrdiff_t>(vertex * at(labels_.numLevels()));
    return std::find(first, first + labels_.numLevels(), 1) != first + labels_.numLevels();
  }

  void keep(int umbrella) {
    kept_[at(umbrella)] = 1;
    corner_kept_[at(cornerOf(umbrella))] = 1;
  }

  void collectFacts() {
    for (int i = 0; i < static_cast<int>(region_.size()); ++i) {
      if (at(region_[at(i)]) == facts_.size()) {
        facts_.emplace_back();
        facts_.back().first = i;
      }
      RegionFacts& facts = facts_[at(region_[at(i)])];
      const Element& element = boundary_.elements[at(i)];
      if (element.kind == ElementKind::Wall) addWallFacts(element, sources_[at(i)], facts);
      if (element.kind == ElementKind::CapDown) {
        for (int k = 0; k < element.z; ++k) {
          if (labels_.solid(element.plan, k)) facts.stands_on_nothing = false;
        }
      }
    }
  }

  void addWallFacts(const Element& wall, const FloorplanEdge& source, RegionFacts& facts) const {
    const GridPoint d = plan_.to(wall.plan) - plan_.from(wall.plan);
    const double area =
        std::sqrt(static_cast<double>(dot(d, d))) *
        static_cast<double>(labels_.levels[at(wall.z + 1)] - labels_.levels[at(wall.z)]);
    facts.area_of_wall[source.wall] += area;
    (source.hypothetical ? facts.hypothetical_area : facts.seen_area) += area;
  }

  void traceRings() {
    std::vector<char> done(boundary_.numDarts(), 0);
    for (int first = 0; first < static_cast<int>(boundary_.numDarts()); ++first) {
      if (done[at(first)] != 0 || !onBorder(first)) continue;
      RegionFacts& facts = facts_[at(regionOf(first))];
      Ring ring;
      int dart = first;
      do {
        done[at(dart)] = 1;
        ring.push_back(boundary_.umbrella[at(dart)]);
        noteSupport(dart, facts);
        dart = nextOnBorder(dart);
      } while (dart != first);
      splitAtRepeats(ring, facts.rings);
    }
  }

  // The lower side of a part that rests on another one ends there at a wall below.
  void noteSupport(int dart, RegionFacts& facts) const {
    const Element& face = boundary_.face(dart);
    const Element& other = boundary_.face(boundary_.twin[at(dart)]);
    if (face.kind == ElementKind::CapDown && other.kind == ElementKind::Wall && other.z < face.z) {
      facts.stands_on_nothing = false;
    }
  }

  // A border that passes a corner twice (a hole touching the outside there) becomes two rings.
  static void splitAtRepeats(const Ring& border, std::vector<Ring>& rings) {
    Ring path;
    for (const int umbrella : border) {
      const auto seen = std::find(path.begin(), path.end(), umbrella);
      if (seen != path.end()) {
        rings.emplace_back(seen, path.end());
        path.erase(seen, path.end());
      }
      path.push_back(umbrella);
    }
    rings.push_back(path);
  }

  // A cap between two walls that are nearly one keeps what it needs to have an area.
  void keepDegenerateRings(const RegionFacts& facts) {
    for (const Ring& ring : facts.rings) {
      Ring corners;
      for (const int u : ring) {
        if (kept_[at(u)] != 0) corners.push_back(u);
      }
      if (corners.size() >= 3 && twiceArea(corners, facts) != 0) continue;
      for (const int u : ring) keep(u);
    }
  }

  // Without its corners a run of edges that is straight only within the strip moves sideways. It
  // keeps them if something else is in the way there. Whether there was such a run.
  bool keepBentRuns() {
    bool found = false;
    for (const RegionFacts& facts : facts_) {
      for (const Ring& ring : facts.rings) {
        const auto is_kept = [&](int u) { return kept_[at(u)] != 0; };
        const auto start = std::find_if(ring.begin(), ring.end(), is_kept) - ring.begin();
        Ring run;
        for (std::size_t i = 0; i <= ring.size(); ++i) {
          const int u = ring[(at(static_cast<int>(start)) + i) % ring.size()];
          run.push_back(u);
          if (!is_kept(u) || i == 0) continue;
          if (mustKeep(run)) {
            std::for_each(run.begin(), run.end(), [&](int v) { keep(v); });
            found = true;
          }
          run = {u};
        }
      }
    }
    return found;
  }

  bool mustKeep(const Ring& run) const {
    const GridPoint& a = plan(cornerOf(run.front()));
    const GridPoint& b = plan(cornerOf(run.back()));
    bool straight = true;
    bool touched = false;
    for (std::size_t i = 1; i + 1 < run.size(); ++i) {
      const int corner = cornerOf(run[i]);
      straight = straight && orient(a, b, plan(corner)) == 0;
      touched = touched || corner_kept_[at(corner)] != 0;
    }
    return !straight && (touched || !chordIsFree(run, a, b));
  }

  // Whether no other vertex of the plan is where the run moves, or within a unit of it.
  bool chordIsFree(const Ring& run, const GridPoint& a, const GridPoint& b) const {
    std::vector<GridPoint> own;
    for (const int u : run) own.push_back(plan(cornerOf(u)));
    std::int64_t deviation = 0;
    for (const GridPoint& p : own) deviation = std::max(deviation, std::abs(orient(a, b, p)));
    const double length = std::sqrt(static_cast<double>(dot(b - a, b - a)));
    const double reach = static_cast<double>(deviation) + length;  // times the length
    const auto margin = static_cast<std::int64_t>(reach / length) + 1;
    std::sort(own.begin(), own.end());
    const auto [low, high] = std::minmax({a.x, b.x});
    const auto [bottom, top] = std::minmax({a.y, b.y});
    auto it = std::lower_bound(plan_.vertices.begin(), plan_.vertices.end(),
                               GridPoint{low - margin, bottom - margin});
    for (; it != plan_.vertices.end() && it->x <= high + margin; ++it) {
      if (it->y < bottom - margin || it->y > top + margin) continue;
      const auto distance = static_cast<double>(std::abs(orient(a, b, *it)));
      if (distance <= reach && !std::binary_search(own.begin(), own.end(), *it)) return false;
    }
    return true;
  }

  void simplifyRings(RegionFacts& facts) const {
    for (Ring& ring : facts.rings) {
      ring.erase(std::remove_if(ring.begin(), ring.end(), [&](int u) { return kept_[at(u)] == 0; }),
                 ring.end());
    }
  }

  // Along a wall, to the right seen from outside.
  GridPoint alongWall(const RegionFacts& facts) const {
    std::vector<GridPoint> points;
    for (const Ring& ring : facts.rings) {
      for (const int u : ring) points.push_back(plan(cornerOf(u)));
    }
    const auto [from, to] = findChord(points);
    const int h = boundary_.elements[at(facts.first)].plan;
    return dot(to - from, plan_.to(h) - plan_.from(h)) > 0 ? to - from : from - to;
  }

  // In the plane of the face, seen from outside; for walls scaled by the length of the chord.
  Wide twiceArea(const Ring& ring, const RegionFacts& facts) const {
    const ElementKind kind = boundary_.elements[at(facts.first)].kind;
    const GridPoint along = kind == ElementKind::Wall ? alongWall(facts) : GridPoint{};
    const GridPoint& start = plan(cornerOf(ring.front()));
    Wide sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int a = cornerOf(ring[i]);
      const int b = cornerOf(ring[(i + 1) % ring.size()]);
      const GridPoint p = plan(a) - start;
      const GridPoint q = plan(b) - start;
      if (kind == ElementKind::Wall) {
        sum += static_cast<Wide>(dot(along, p)) * labels_.levels[at(level(b))] -
               static_cast<Wide>(dot(along, q)) * labels_.levels[at(level(a))];
      } else {
        sum += cross(p, q);
      }
    }
    return kind == ElementKind::CapDown ? -sum : sum;
  }

  PolyhedralFace makeFace(const RegionFacts& facts) const {
    const Element& first = boundary_.elements[at(facts.first)];
    PolyhedralFace face;
    face.shell = boundary_.shell[at(facts.first)];
    for (const Ring& ring : facts.rings) {
      if (twiceArea(ring, facts) > 0) {
        face.outer = ring;
      } else {
        face.inner.push_back(ring);
      }
    }
    if (first.kind == ElementKind::CapUp) face.label = FaceLabel::Roof;
    if (first.kind == ElementKind::CapDown) {
      face.label = facts.stands_on_nothing ? FaceLabel::Ground : FaceLabel::Ceiling;
    }
    if (first.kind == ElementKind::Wall) {
      const auto larger = [](const auto& a, const auto& b) { return a.second < b.second; };
      face.wall =
          std::max_element(facts.area_of_wall.begin(), facts.area_of_wall.end(), larger)->first;
      face.hypothetical = facts.hypothetical_area > facts.seen_area;
    }
    return face;
  }

  // Vertices ascend by place, those in one place by umbrella.
  std::vector<int> addVertices(PolyhedralModel& model) const {
    std::vector<int> number(kept_.size(), -1);
    std::vector<int> order;
    for (std::size_t u = 0; u < kept_.size(); ++u) {
      if (kept_[u] != 0) order.push_back(static_cast<int>(u));
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::make_pair(cornerOf(a), a) < std::make_pair(cornerOf(b), b);
    });
    for (const int u : order) {
      const int corner = cornerOf(u);
      number[at(u)] = static_cast<int>(model.vertices.size());
      model.vertices.emplace_back(lattice_.toDouble(plan(corner).x, 0),
                                  lattice_.toDouble(plan(corner).y, 1),
                                  lattice_.toDouble(labels_.levels[at(level(corner))], 2));
    }
    return number;
  }

  PolyhedralModel assemble() const {
    PolyhedralModel model;
    model.grid = lattice_.grid;
    const std::vector<int> number = addVertices(model);
    const auto renumber = [&](Ring& ring) {
      for (int& u : ring) u = number[at(u)];
      std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    };
    for (const RegionFacts& facts : facts_) {
      PolyhedralFace face = makeFace(facts);
      renumber(face.outer);
      for (Ring& ring : face.inner) renumber(ring);
      std::sort(face.inner.begin(), face.inner.end());
      model.num_shells = std::max(model.num_shells, face.shell + 1);
      model.faces.push_back(std::move(face));
    }
    std::stable_sort(
        model.faces.begin(), model.faces.end(),
        [](const PolyhedralFace& a, const PolyhedralFace& b) { return a.shell < b.shell; });
    return model;
  }

  const PlanArrangement& plan_;
  const SlabLabels& labels_;
  const BoundaryComplex& boundary_;
  const std::vector<FloorplanEdge>& sources_;
  const Lattice& lattice_;
  std::int64_t strip_;
  std::vector<int> region_;         // elementary face -> region
  std::vector<char> kept_;          // umbrella -> becomes a vertex
  std::vector<char> corner_kept_;   // corner -> one of its umbrellas does
  std::vector<RegionFacts> facts_;  // by region
};

}  // namespace

PolyhedralModel mergeFaces(const PlanArrangement& plan, const SlabLabels& labels,
                           const BoundaryComplex& boundary,
                           const std::vector<FloorplanEdge>& sources, const Lattice& lattice,
                           std::int64_t strip) {
  return FaceMerger(plan, labels, boundary, sources, lattice, strip).merge();
}

}  // namespace detail
}  // namespace storey
