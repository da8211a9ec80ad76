// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/detail/model_darts.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

void addRing(const std::vector<int>& ring, int face, ModelDarts& darts) {
  const int first = static_cast<int>(darts.numDarts());
  const int size = static_cast<int>(ring.size());
  for (int i = 0; i < size; ++i) {
    darts.from.push_back(ring[at(i)]);
    darts.next.push_back(first + (i + 1) % size);
    darts.face.push_back(face);
  }
}

std::string edgeName(const ModelDarts& darts, int dart) {
  return "edge " + std::to_string(darts.from[at(dart)]) + " - " + std::to_string(darts.to(dart)) +
         " of face " + std::to_string(darts.face[at(dart)]);
}

void findTwins(ModelDarts& darts, ModelCheck& check) {
  std::vector<std::tuple<int, int, int>> ends;  // from, to, dart
  for (int d = 0; d < static_cast<int>(darts.numDarts()); ++d) {
    ends.emplace_back(darts.from[at(d)], darts.to(d), d);
  }
  std::sort(ends.begin(), ends.end());
  const auto range = [&](int a, int b) {
    const auto begin = std::lower_bound(ends.begin(), ends.end(), std::make_tuple(a, b, -1));
    const auto end = std::lower_bound(begin, ends.end(), std::make_tuple(a, b + 1, -1));
    return std::make_pair(begin, end);
  };
  darts.twin.assign(darts.numDarts(), -1);
  std::set<std::pair<int, int>> edges;
  for (const auto& [a, b, d] : ends) {
    edges.insert(std::minmax(a, b));
    const auto same = range(a, b);
    const auto back = range(b, a);
    if (std::get<2>(*same.first) != d) {
      noteDefect(check.overused_edges, check.problems,
                 edgeName(darts, d) + " is run in the same sense by face " +
                     std::to_string(darts.face[at(std::get<2>(*same.first))]));
    } else if (back.first == back.second) {
      noteDefect(check.open_edges, check.problems,
                 edgeName(darts, d) + " has no face on the other side");
    } else if (same.second - same.first == 1 && back.second - back.first == 1) {
      darts.twin[at(d)] = std::get<2>(*back.first);
    }
  }
  check.edges = edges.size();
}

// The surface as triangles: a face that meets a vertex with two corners is once around it only if
// the corners are not mixed up, and rings alone do not tell.
class TriangleTopology {
 public:
  explicit TriangleTopology(const ModelDarts& darts) : darts_(darts) {
    for (std::size_t t = 0; t < darts.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const int side = 3 * static_cast<int>(t) + i;
        sides_.push_back({from(side), to(side), darts.triangles[t].face, side});
      }
    }
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t d = 0; d < darts.numDarts(); ++d) {
      if (darts.twin[d] < 0) continue;
      other_face_[{darts.from[d], darts.to(static_cast<int>(d))}] = darts.face[at(darts.twin[d])];
    }
  }

  int numSides() const { return static_cast<int>(sides_.size()); }
  int face(int side) const { return darts_.triangles[at(side / 3)].face; }
  int from(int side) const { return darts_.triangles[at(side / 3)].vertices[at(side % 3)]; }
  int to(int side) const { return from(nextSide(side)); }
  static int nextSide(int side) { return side - side % 3 + (side + 1) % 3; }
  static int prevSide(int side) { return side - side % 3 + (side + 2) % 3; }

  // The side of the triangle on the other side; -1 if there is none.
  int twin(int side) const {
    const auto border = other_face_.find({from(side), to(side)});
    const int other = border == other_face_.end() ? face(side) : border->second;
    const std::array<int, 4> key = {to(side), from(side), other, -1};
    const auto it = std::lower_bound(sides_.begin(), sides_.end(), key);
    if (it == sides_.end() || (*it)[0] != key[0] || (*it)[1] != key[1] || (*it)[2] != other) {
      return -1;
    }
    return (*it)[3];
  }

 private:
  const ModelDarts& darts_;
  std::vector<std::array<int, 4>> sides_;          // from, to, face, side
  std::map<std::pair<int, int>, int> other_face_;  // of the edges of the model
};

// The faces around a vertex must be one cycle.
void checkVertices(const TriangleTopology& surface, const ModelDarts& darts, ModelCheck& check) {
  std::vector<char> seen(at(surface.numSides()), 0);
  std::vector<char> visited(darts.points.size(), 0);
  for (int first = 0; first < surface.numSides(); ++first) {
    if (seen[at(first)] != 0) continue;
    const int vertex = surface.from(first);
    if (visited[at(vertex)] != 0) {
      noteDefect(check.split_vertices, check.problems,
                 "the faces at vertex " + std::to_string(vertex) + " are more than one cycle");
    }
    visited[at(vertex)] = 1;
    int side = first;
    do {
      seen[at(side)] = 1;
      side = surface.twin(TriangleTopology::prevSide(side));
    } while (side >= 0 && side != first);
  }
}

void findShells(const PolyhedralModel& model, ModelDarts& darts, ModelCheck& check) {
  UnionFind<int> sets(model.faces.size());
  for (std::size_t d = 0; d < darts.numDarts(); ++d) {
    if (darts.twin[d] >= 0) sets.unite(darts.face[d], darts.face[at(darts.twin[d])]);
  }
  std::map<int, int> root_of_label;
  darts.shell.resize(model.faces.size());
  for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) {
    const int root = sets.find(f);
    darts.shell[at(f)] = root == f ? darts.num_shells++ : darts.shell[at(root)];
    const int label = model.faces[at(f)].shell;
    const bool new_label = root_of_label.emplace(label, root).second;
    if (root_of_label[label] != root || (new_label && root != f)) {
      noteDefect(check.wrong_shells, check.problems,
                 "face " + std::to_string(f) + " says shell " + std::to_string(label) +
                     ", which is not what it is connected with");
    }
  }
  check.shells = at(darts.num_shells);
  if (model.num_shells != darts.num_shells) {
    noteDefect(check.wrong_shells, check.problems,
               "num_shells is " + std::to_string(model.num_shells) + ", but there are " +
                   std::to_string(darts.num_shells));
  }
}

void checkEuler(const ModelDarts& darts, ModelCheck& check) {
  std::vector<std::set<int>> vertices(at(darts.num_shells));
  std::vector<int> triangles(at(darts.num_shells), 0);
  for (const FaceTriangle& t : darts.triangles) {
    const int shell = darts.shell[at(t.face)];
    vertices[at(shell)].insert(t.vertices.begin(), t.vertices.end());
    ++triangles[at(shell)];
  }
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    // 2 E = 3 F in a closed surface of triangles; odd F cannot be one
    const int twice = 2 * static_cast<int>(vertices[s].size()) - triangles[s];
    check.euler += twice / 2;
    if (twice <= 4 && twice % 4 == 0) continue;
    noteDefect(check.bad_euler, check.problems,
               "shell " + std::to_string(s) + " has Euler number " + std::to_string(twice / 2));
  }
}

}  // namespace

void checkTopology(const PolyhedralModel& model, ModelDarts& darts, ModelCheck& check) {
  for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) {
    addRing(model.faces[at(f)].outer, f, darts);
    for (const std::vector<int>& ring : model.faces[at(f)].inner) addRing(ring, f, darts);
  }
  findTwins(darts, check);
  findShells(model, darts, check);
  if (check.open_edges + check.overused_edges > 0) return;
  checkVertices(TriangleTopology(darts), darts, check);
  checkEuler(darts, check);
}

}  // namespace detail
}  // namespace storey
