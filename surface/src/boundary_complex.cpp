// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/detail/boundary_complex.h>

#include <algorithm>
#include <array>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

class Builder {
 public:
  Builder(const PlanArrangement& plan, const SlabLabels& labels)
      : plan_(plan),
        labels_(labels),
        num_half_edges_(static_cast<int>(plan.origin.size())),
        wall_dart_(at(labels.numSlabs()) * plan.origin.size(), -1),
        cap_dart_(at(labels.numLevels()) * plan.origin.size(), -1) {}

  BoundaryComplex build() {
    addWalls();
    addCaps();
    for (int h = 0; h < num_half_edges_; h += 2) {
      for (int level = 0; level < labels_.numLevels(); ++level) pairAtHorizontalEdge(h, level);
    }
    for (const std::vector<int>& star : plan_.outgoing) {
      for (int slab = 0; slab < labels_.numSlabs(); ++slab) pairAtVerticalEdge(star, slab);
    }
    numberUmbrellas();
    numberShells();
    return std::move(result_);
  }

 private:
  bool solidLeft(int half_edge, int slab) const {
    return labels_.solid(plan_.cell[at(half_edge)], slab);
  }
  int& wallDart(int half_edge, int slab) {
    return wall_dart_[at(half_edge) * at(labels_.numSlabs()) + at(slab)];
  }
  int& capDart(int half_edge, int level) {
    return cap_dart_[at(half_edge) * at(labels_.numLevels()) + at(level)];
  }
  int cornerAt(int vertex, int level) const { return vertex * labels_.numLevels() + level; }

  int addDart(int face, int corner) {
    result_.element.push_back(face);
    result_.corner.push_back(corner);
    result_.next.push_back(-1);
    result_.prev.push_back(-1);
    result_.twin.push_back(-1);
    return static_cast<int>(result_.element.size()) - 1;
  }
  void link(int dart, int next) {
    result_.next[at(dart)] = next;
    result_.prev[at(next)] = dart;
  }
  void pair(int a, int b) {
    result_.twin[at(a)] = b;
    result_.twin[at(b)] = a;
  }

  // Darts of a wall on half-edge u -> v: bottom u v, up at v, top v u, down at u.
  void addWalls() {
    for (int h = 0; h < num_half_edges_; ++h) {
      const int u = plan_.origin[at(h)];
      const int v = plan_.target(h);
      for (int k = 0; k < labels_.numSlabs(); ++k) {
        if (!solidLeft(h, k) || solidLeft(h ^ 1, k)) continue;
        const int face = static_cast<int>(result_.elements.size());
        result_.elements.push_back({ElementKind::Wall, h, k});
        const int first = addDart(face, cornerAt(u, k));
        addDart(face, cornerAt(v, k));
        addDart(face, cornerAt(v, k + 1));
        addDart(face, cornerAt(u, k + 1));
        for (int i = 0; i < 4; ++i) link(first + i, first + (i + 1) % 4);
        wallDart(h, k) = first;
      }
    }
  }

  void addCaps() {
    std::vector<std::vector<int>> sides(plan_.interior.size());
    for (int h = 0; h < num_half_edges_; ++h) {
      if (plan_.cell[at(h)] >= 0) sides[at(plan_.cell[at(h)])].push_back(h);
    }
    for (int cell = 0; cell < static_cast<int>(sides.size()); ++cell) {
      for (int level = 0; level < labels_.numLevels(); ++level) {
        const bool below = labels_.solid(cell, level - 1);
        if (below != labels_.solid(cell, level)) addCap(cell, level, below, sides[at(cell)]);
      }
    }
  }

  void addCap(int cell, int level, bool up, const std::vector<int>& sides) {
    const int face = static_cast<int>(result_.elements.size());
    result_.elements.push_back({up ? ElementKind::CapUp : ElementKind::CapDown, cell, level});
    for (const int h : sides) {
      const int from = up ? plan_.origin[at(h)] : plan_.target(h);
      capDart(h, level) = addDart(face, cornerAt(from, level));
    }
    for (const int h : sides) {
      const int dart = capDart(h, level);
      const int next = capDart(plan_.next[at(h)], level);
      up ? link(dart, next) : link(next, dart);
    }
  }

  // The (at most four) faces at the edge of half-edge h at a level.
  void pairAtHorizontalEdge(int h, int level) {
    const int t = h ^ 1;
    const bool left_below = solidLeft(h, level - 1);
    const bool left_above = solidLeft(h, level);
    const bool right_below = solidLeft(t, level - 1);
    const bool right_above = solidLeft(t, level);
    int below = -1;
    int above = -1;
    if (left_below != right_below) below = wallDart(left_below ? h : t, level - 1) + 2;
    if (left_above != right_above) above = wallDart(left_above ? h : t, level);
    const int left = left_below != left_above ? capDart(h, level) : -1;
    const int right = right_below != right_above ? capDart(t, level) : -1;
    std::array<int, 4> faces = {below, left, above, right};
    const auto end = std::remove(faces.begin(), faces.end(), -1);
    const auto count = end - faces.begin();
    if (count == 2) pair(faces[0], faces[1]);
    if (count < 4) return;
    pair(below, left_below ? left : right);  // each solid quadrant keeps its own two
    pair(above, left_below ? right : left);
  }

  // Walls at a vertex of the plan: each wedge of solid keeps its own two.
  void pairAtVerticalEdge(const std::vector<int>& star, int slab) {
    const std::size_t n = star.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!solidLeft(star[i], slab) || solidLeft(star[i] ^ 1, slab)) continue;
      std::size_t j = (i + 1) % n;
      while (solidLeft(star[j], slab)) j = (j + 1) % n;
      pair(wallDart(star[i], slab) + 3, wallDart(star[j] ^ 1, slab) + 1);
    }
  }

  void numberUmbrellas() {
    result_.umbrella.assign(result_.numDarts(), -1);
    for (int first = 0; first < static_cast<int>(result_.numDarts()); ++first) {
      if (result_.umbrella[at(first)] >= 0) continue;
      const int number = static_cast<int>(result_.umbrella_corner.size());
      result_.umbrella_corner.push_back(result_.corner[at(first)]);
      int dart = first;
      do {
        result_.umbrella[at(dart)] = number;
        dart = result_.twin[at(result_.prev[at(dart)])];
      } while (dart != first);
    }
  }

  void numberShells() {
    UnionFind<int> sets(result_.elements.size());
    for (std::size_t d = 0; d < result_.numDarts(); ++d) {
      sets.unite(result_.element[d], result_.element[at(result_.twin[d])]);
    }
    result_.shell.resize(result_.elements.size());
    int count = 0;
    for (int i = 0; i < static_cast<int>(result_.elements.size()); ++i) {
      const int root = sets.find(i);  // the smallest member: numbered already unless i itself
      result_.shell[at(i)] = root == i ? count++ : result_.shell[at(root)];
    }
  }

  const PlanArrangement& plan_;
  const SlabLabels& labels_;
  int num_half_edges_;
  std::vector<int> wall_dart_;  // [half-edge][slab] -> first dart of the wall
  std::vector<int> cap_dart_;   // [half-edge][level] -> dart of the cap on its left
  BoundaryComplex result_;
};

}  // namespace

BoundaryComplex buildBoundary(const PlanArrangement& plan, const SlabLabels& labels) {
  return Builder(plan, labels).build();
}

}  // namespace detail
}  // namespace storey
