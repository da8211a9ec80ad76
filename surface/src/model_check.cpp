// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/model_darts.h>
#include <storey/surface/model_check.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <limits>
#include <set>

namespace storey {
namespace detail {

void noteDefect(std::size_t& count, std::vector<std::string>& problems, const std::string& what) {
  constexpr std::size_t kMaxDescribed = 3;  // of each kind
  if (count++ < kMaxDescribed) problems.push_back(what);
}

}  // namespace detail
namespace {

using detail::GridPoint;
using detail::LatticePoint;
using detail::ModelDarts;
using detail::noteDefect;

constexpr std::int64_t kPlanarStrip = 2;  // grid units wide: one to either side of the plane

std::size_t at(int index) { return static_cast<std::size_t>(index); }

std::vector<std::vector<int>> allRings(const PolyhedralFace& face) {
  std::vector<std::vector<int>> rings = {face.outer};
  rings.insert(rings.end(), face.inner.begin(), face.inner.end());
  return rings;
}

std::string faceName(std::size_t face) { return "face " + std::to_string(face); }

void checkIndices(const PolyhedralModel& model, ModelCheck& check) {
  std::vector<char> used(model.vertices.size(), 0);
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    for (const std::vector<int>& ring : allRings(model.faces[f])) {
      for (const int i : ring) {
        if (i >= 0 && at(i) < used.size()) {
          used[at(i)] = 1;
          continue;
        }
        noteDefect(check.bad_indices, check.problems,
                   faceName(f) + " has vertex " + std::to_string(i) + " of " +
                       std::to_string(used.size()));
      }
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) continue;
    noteDefect(check.bad_indices, check.problems,
               "vertex " + std::to_string(i) + " is not used by any face");
  }
}

// Exact multiples of the grid, within a range in which the predicates are exact.
void readVertices(const PolyhedralModel& model, std::vector<LatticePoint>& points,
                  ModelCheck& check) {
  LatticePoint low;
  low.fill(std::numeric_limits<std::int64_t>::max());
  for (const Eigen::Vector3d& v : model.vertices) {
    const auto index = model.grid > 0.0 ? detail::latticeIndex(v, model.grid) : std::nullopt;
    for (std::size_t i = 0; index && i < 3; ++i) low[i] = std::min(low[i], (*index)[i]);
  }
  for (std::size_t i = 0; i < model.vertices.size(); ++i) {
    const Eigen::Vector3d& v = model.vertices[i];
    const auto p = model.grid > 0.0 ? detail::toLattice(v, model.grid, low) : std::nullopt;
    points.push_back(p.value_or(LatticePoint{}));
    bool exact = p.has_value();
    for (std::size_t k = 0; exact && k < 3; ++k) {
      exact = static_cast<double>((*p)[k] + low[k]) * model.grid == v[static_cast<int>(k)];
    }
    if (exact) continue;
    noteDefect(check.off_grid, check.problems,
               "vertex " + std::to_string(i) + " is no multiple of the grid");
  }
}

void checkRings(const PolyhedralModel& model, ModelDarts& darts, ModelCheck& check) {
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    bool good = true;
    for (std::vector<int> ring : allRings(model.faces[f])) {
      std::sort(ring.begin(), ring.end());
      good = good && ring.size() >= 3 && std::adjacent_find(ring.begin(), ring.end()) == ring.end();
    }
    const auto triangles =
        good ? triangulateFace(model, model.faces[f]) : std::vector<std::array<int, 3>>{};
    for (const std::array<int, 3>& t : triangles) {
      darts.triangles.push_back({t, static_cast<int>(f)});
    }
    if (!triangles.empty()) continue;
    noteDefect(check.bad_rings, check.problems, faceName(f) + " is no polygon with holes in it");
  }
}

std::vector<GridPoint> planPoints(const PolyhedralFace& face,
                                  const std::vector<LatticePoint>& points) {
  std::vector<GridPoint> plan;
  for (const std::vector<int>& ring : allRings(face)) {
    for (const int i : ring) plan.push_back({points[at(i)][0], points[at(i)][1]});
  }
  return plan;
}

void checkPlanes(const PolyhedralModel& model, const std::vector<LatticePoint>& points,
                 ModelCheck& check) {
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const PolyhedralFace& face = model.faces[f];
    bool planar = true;
    if (face.label == FaceLabel::Wall) {
      planar = detail::withinStrip(planPoints(face, points), kPlanarStrip);
    } else {
      for (const std::vector<int>& ring : allRings(face)) {
        for (const int i : ring) {
          planar = planar && points[at(i)][2] == points[at(face.outer[0])][2];
        }
      }
      const bool up = detail::areaVector(face, points)[2] > 0;
      if (planar && up != (face.label == FaceLabel::Roof)) {
        noteDefect(check.mislabelled, check.problems,
                   faceName(f) + " faces " + (up ? "up, but is no roof" : "down, but is a roof"));
      }
    }
    if (!planar) noteDefect(check.non_planar, check.problems, faceName(f) + " is not planar");
  }
}

bool samePlane(const PolyhedralFace& a, const PolyhedralFace& b,
               const std::vector<LatticePoint>& points) {
  const bool wall = a.label == FaceLabel::Wall;
  if (wall != (b.label == FaceLabel::Wall)) return false;
  const auto m = detail::areaVector(a, points);
  const auto n = detail::areaVector(b, points);
  if (!wall) return (m[2] > 0) == (n[2] > 0);  // they share an edge, hence the height
  double cosine = 0.0;                         // its sign only
  for (std::size_t i = 0; i < 2; ++i)
    cosine += static_cast<double>(m[i]) * static_cast<double>(n[i]);
  if (cosine <= 0.0) return false;
  std::vector<GridPoint> both = planPoints(a, points);
  const std::vector<GridPoint> other = planPoints(b, points);
  both.insert(both.end(), other.begin(), other.end());
  return detail::withinStrip(both, 0);
}

void checkNeighbours(const PolyhedralModel& model, const ModelDarts& darts, ModelCheck& check) {
  std::set<std::pair<int, int>> pairs;
  for (std::size_t d = 0; d < darts.numDarts(); ++d) {
    if (darts.twin[d] < 0) continue;
    const int a = darts.face[d];
    const int b = darts.face[at(darts.twin[d])];
    if (a < b) pairs.emplace(a, b);
  }
  for (const auto& [a, b] : pairs) {
    if (!samePlane(model.faces[at(a)], model.faces[at(b)], darts.points)) continue;
    noteDefect(check.split_planes, check.problems,
               "faces " + std::to_string(a) + " and " + std::to_string(b) +
                   " are neighbours in one plane");
  }
}

}  // namespace

ModelCheck checkModel(const PolyhedralModel& model) {
  ModelCheck check;
  check.vertices = model.vertices.size();
  check.faces = model.faces.size();
  if (model.faces.empty()) {
    check.problems.push_back("the model has no faces");
    return check;
  }
  ModelDarts darts;
  checkIndices(model, check);
  readVertices(model, darts.points, check);
  checkRings(model, darts, check);
  if (!check.ok()) return check;
  checkPlanes(model, darts.points, check);
  checkTopology(model, darts, check);
  checkVolume(model, darts, check);
  checkContacts(darts, check);
  checkNeighbours(model, darts, check);
  return check;
}

}  // namespace storey
