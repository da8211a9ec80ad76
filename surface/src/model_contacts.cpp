// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/model_darts.h>
#include <storey/surface/detail/triangle_contact.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

struct ModelTriangle {
  std::array<int, 3> vertices;
  LatticeTriangle corners;
  LatticePoint low;
  LatticePoint high;
  int face;
};

class ContactChecker {
 public:
  ContactChecker(const ModelDarts& darts, ModelCheck& check)
      : darts_(darts), check_(check), shell_of_vertex_(darts.points.size(), -1) {
    for (std::size_t d = 0; d < darts.numDarts(); ++d) {
      shell_of_vertex_[at(darts.from[d])] = darts.shell[at(darts.face[d])];
      edges_.emplace(darts.from[d], darts.to(static_cast<int>(d)));
    }
  }

  void run() {
    findRepeatedPlaces();
    findJunctions();
    collectTriangles();
    findIntersections();
  }

 private:
  const LatticePoint& point(int vertex) const { return darts_.points[at(vertex)]; }

  void findRepeatedPlaces() {
    std::vector<int> order(darts_.points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int v) { return std::tie(point(v), shell_of_vertex_[at(v)]); };
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (key(order[i]) != key(order[i - 1])) continue;
      noteDefect(check_.self_contacts, check_.problems,
                 "vertices " + std::to_string(order[i - 1]) + " and " + std::to_string(order[i]) +
                     " of one shell are in the same place");
    }
  }

  void findJunctions() {
    std::vector<int> order(darts_.points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return point(a) < point(b) || (point(a) == point(b) && a < b); });
    for (const auto& [a, b] : edges_) {
      if (a > b && edges_.count({b, a}) != 0) continue;  // once for both senses
      const auto [x_min, x_max] = std::minmax(point(a)[0], point(b)[0]);
      auto it = std::lower_bound(order.begin(), order.end(), x_min,
                                 [&](int v, std::int64_t x) { return point(v)[0] < x; });
      for (; it != order.end() && point(*it)[0] <= x_max; ++it) {
        if (shell_of_vertex_[at(*it)] != shell_of_vertex_[at(a)] || !onEdge(a, b, *it)) continue;
        noteDefect(check_.t_junctions, check_.problems,
                   "vertex " + std::to_string(*it) + " lies on edge " + std::to_string(a) + " - " +
                       std::to_string(b));
      }
    }
  }

  // Closer than half a unit to the interior of the edge.
  bool onEdge(int a, int b, int vertex) const {
    const LatticePoint& p = point(a);
    std::array<Wide, 3> d{};
    std::array<Wide, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(p[i], point(b)[i]);
      if (point(vertex)[i] < low || point(vertex)[i] > high) return false;
      d[i] = point(b)[i] - p[i];
      e[i] = point(vertex)[i] - p[i];
    }
    const Wide length = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Wide along = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
    if (along <= 0 || along >= length) return false;
    const Wide x = d[1] * e[2] - d[2] * e[1];
    const Wide y = d[2] * e[0] - d[0] * e[2];
    const Wide z = d[0] * e[1] - d[1] * e[0];
    return 4 * (x * x + y * y + z * z) < length;
  }

  void collectTriangles() {
    for (const FaceTriangle& t : darts_.triangles) {
      const auto& v = t.vertices;
      ModelTriangle triangle{v, {point(v[0]), point(v[1]), point(v[2])}, {}, {}, t.face};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& c = triangle.corners;
        const auto [low, high] = std::minmax({c[0][i], c[1][i], c[2][i]});
        triangle.low[i] = low;
        triangle.high[i] = high;
      }
      triangles_.push_back(triangle);
    }
    std::sort(triangles_.begin(), triangles_.end(),
              [](const ModelTriangle& a, const ModelTriangle& b) {
                return std::tie(a.low, a.vertices) < std::tie(b.low, b.vertices);
              });
  }

  void findIntersections() {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const ModelTriangle& a = triangles_[i];
      for (std::size_t j = i + 1; j < triangles_.size(); ++j) {
        const ModelTriangle& b = triangles_[j];
        if (b.low[0] > a.high[0]) break;
        if (b.low[1] > a.high[1] || b.high[1] < a.low[1] || b.low[2] > a.high[2] ||
            b.high[2] < a.low[2] || a.face == b.face || !intersect(a, b)) {
          continue;
        }
        noteDefect(check_.self_intersections, check_.problems,
                   "faces " + std::to_string(std::min(a.face, b.face)) + " and " +
                       std::to_string(std::max(a.face, b.face)) + " intersect");
      }
    }
  }

  // Whether they meet elsewhere than they may.
  bool intersect(const ModelTriangle& a, const ModelTriangle& b) const {
    const TriangleContact contact = findContact(a.corners, b.corners);
    if (contact.kind == TriangleContact::Nothing) return false;
    if (contact.kind == TriangleContact::Area) return true;
    if (darts_.shell[at(a.face)] == darts_.shell[at(b.face)]) {
      const auto common = std::count_if(a.vertices.begin(), a.vertices.end(), [&](int v) {
        return std::find(b.vertices.begin(), b.vertices.end(), v) != b.vertices.end();
      });
      return common < (contact.kind == TriangleContact::Point ? 1 : 2);
    }
    return contact.kind == TriangleContact::Segment && !alongEdge(a, contact.edge_of_first) &&
           !alongEdge(b, contact.edge_of_second);
  }

  // Whether the edge of the triangle is one of the model.
  bool alongEdge(const ModelTriangle& t, int edge) const {
    if (edge < 0) return false;
    return edges_.count({t.vertices[at(edge)], t.vertices[at((edge + 1) % 3)]}) != 0;
  }

  const ModelDarts& darts_;
  ModelCheck& check_;
  std::vector<int> shell_of_vertex_;
  std::set<std::pair<int, int>> edges_;  // directed
  std::vector<ModelTriangle> triangles_;
};

}  // namespace

void checkContacts(const ModelDarts& darts, ModelCheck& check) {
  ContactChecker(darts, check).run();
}

}  // namespace detail
}  // namespace storey
