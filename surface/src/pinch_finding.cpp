// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/detail/boundary_complex.h>

#include <algorithm>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// An edge (from < to) or a point (from == to) of space where the surface passes several times.
struct Contact {
  int from;  // corners
  int to;
  std::vector<int> shells;  // one entry a passage
  bool chosen = false;
};

class PinchFinder {
 public:
  PinchFinder(const SlabLabels& labels, const BoundaryComplex& boundary)
      : labels_(labels), boundary_(boundary), sets_(boundary.elements.size()) {}

  std::vector<Pinch> find() {
    addEdges();
    addPoints();
    while (choose()) {
    }
    std::vector<Pinch> pinches;
    const int n = labels_.numLevels();
    for (const Contact& c : contacts_) {
      const int slab = std::min(c.from % n, labels_.numSlabs() - 1);
      const bool upright = c.from != c.to && c.from / n == c.to / n;
      if (c.chosen) pinches.push_back({c.from / n, c.to / n, slab, upright});
    }
    return pinches;
  }

 private:
  struct Passage {
    int from;
    int to;
    int shell;
    bool operator<(const Passage& o) const {
      return std::tie(from, to, shell) < std::tie(o.from, o.to, o.shell);
    }
    bool samePlace(const Passage& o) const { return from == o.from && to == o.to; }
  };

  int shellOf(std::size_t dart) const { return boundary_.shell[at(boundary_.element[dart])]; }

  void addEdges() {
    std::vector<Passage> passages;
    for (std::size_t d = 0; d < boundary_.numDarts(); ++d) {
      const int from = boundary_.corner[d];
      const int to = boundary_.corner[at(boundary_.next[d])];
      if (from < to) passages.push_back({from, to, shellOf(d)});  // the other sense is its twin
    }
    addContacts(std::move(passages));
  }

  // Points that are not the ends of such edges: those mend when the edge does.
  void addPoints() {
    std::vector<int> ends;
    for (const Contact& c : contacts_) ends.insert(ends.end(), {c.from, c.to});
    std::sort(ends.begin(), ends.end());
    std::vector<Passage> passages;
    std::vector<char> seen(boundary_.umbrella_corner.size(), 0);
    for (std::size_t d = 0; d < boundary_.numDarts(); ++d) {
      char& known = seen[at(boundary_.umbrella[d])];
      const int corner = boundary_.corner[d];
      if (known == 0 && !std::binary_search(ends.begin(), ends.end(), corner)) {
        passages.push_back({corner, corner, shellOf(d)});
      }
      known = 1;
    }
    addContacts(std::move(passages));
  }

  void addContacts(std::vector<Passage> passages) {
    std::sort(passages.begin(), passages.end());
    for (std::size_t i = 1; i < passages.size(); ++i) {
      if (!passages[i].samePlace(passages[i - 1])) continue;
      if (i == 1 || !passages[i].samePlace(passages[i - 2])) {
        contacts_.push_back({passages[i].from, passages[i].to, {passages[i - 1].shell}});
      }
      contacts_.back().shells.push_back(passages[i].shell);
    }
  }

  // Chooses contacts of shells that are, or will be, one; filling a contact joins all shells there.
  bool choose() {
    bool found = false;
    for (Contact& c : contacts_) {
      if (c.chosen) continue;
      std::vector<int> roots;
      for (const int shell : c.shells) roots.push_back(sets_.find(shell));
      std::sort(roots.begin(), roots.end());
      c.chosen = std::adjacent_find(roots.begin(), roots.end()) != roots.end();
      if (!c.chosen) continue;
      for (const int root : roots) sets_.unite(roots.front(), root);
      found = true;
    }
    return found;
  }

  const SlabLabels& labels_;
  const BoundaryComplex& boundary_;
  UnionFind<int> sets_;  // of shells
  std::vector<Contact> contacts_;
};

}  // namespace

std::vector<Pinch> findPinches(const SlabLabels& labels, const BoundaryComplex& boundary) {
  return PinchFinder(labels, boundary).find();
}

}  // namespace detail
}  // namespace storey
