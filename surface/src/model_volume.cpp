// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/model_darts.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

template <typename Visit>
void forEachRing(const PolyhedralFace& face, Visit visit) {
  visit(face.outer);
  for (const std::vector<int>& ring : face.inner) visit(ring);
}

// Twice the area vector of a triangle that has a corner at the origin.
std::array<Wide, 3> cross(const LatticePoint& a, const LatticePoint& b) {
  const auto product = [](std::int64_t p, std::int64_t q) { return static_cast<Wide>(p) * q; };
  return {product(a[1], b[2]) - product(a[2], b[1]), product(a[2], b[0]) - product(a[0], b[2]),
          product(a[0], b[1]) - product(a[1], b[0])};
}

// Six times the volume between the face and the origin.
Wide sixfoldVolume(const PolyhedralFace& face, const std::vector<LatticePoint>& points) {
  Wide sum = 0;
  forEachRing(face, [&](const std::vector<int>& ring) {
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const std::array<Wide, 3> n = cross(points[at(ring[i])], points[at(ring[i + 1])]);
      const LatticePoint& apex = points[at(ring[0])];
      sum += n[0] * apex[0] + n[1] * apex[1] + n[2] * apex[2];
    }
  });
  return sum;
}

// Whether a point of the plan, given threefold, is inside the rings (even-odd rule).
bool insideRings(const PolyhedralFace& face, const std::vector<LatticePoint>& points,
                 const LatticePoint& threefold) {
  bool odd = false;
  forEachRing(face, [&](const std::vector<int>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto [a, b] = std::minmax(points[at(ring[i])], points[at(ring[(i + 1) % ring.size()])],
                                      [](const auto& p, const auto& q) { return p[1] < q[1]; });
      if (3 * a[1] > threefold[1] || 3 * b[1] <= threefold[1]) continue;
      const Wide left = static_cast<Wide>(b[0] - a[0]) * (threefold[1] - 3 * a[1]) -
                        static_cast<Wide>(b[1] - a[1]) * (threefold[0] - 3 * a[0]);
      if (left > 0) odd = !odd;  // on the edge: the same for faces on either side of it
    }
  });
  return odd;
}

// How many solids of the other shells a point of this shell is in: a ray upwards leaves a solid
// through a roof and enters one from below.
int solidsAround(const PolyhedralModel& model, const ModelDarts& darts, int shell,
                 const LatticePoint& threefold) {
  int solids = 0;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const PolyhedralFace& face = model.faces[f];
    if (darts.shell[f] == shell || face.label == FaceLabel::Wall) continue;
    if (3 * darts.points[at(face.outer[0])][2] <= threefold[2]) continue;
    if (!insideRings(face, darts.points, threefold)) continue;
    solids += face.label == FaceLabel::Roof ? 1 : -1;
  }
  return solids;
}

void checkShell(const PolyhedralModel& model, const ModelDarts& darts, int shell, Wide volume,
                ModelCheck& check) {
  int solids = 0;
  for (const FaceTriangle& t : darts.triangles) {
    // A point of a cap: one of a wall would be above and below the edges of others.
    if (darts.shell[at(t.face)] != shell) continue;
    if (model.faces[at(t.face)].label == FaceLabel::Wall) continue;
    LatticePoint threefold{};
    for (const int i : t.vertices) {
      for (std::size_t k = 0; k < 3; ++k) threefold[k] += darts.points[at(i)][k];
    }
    solids = solidsAround(model, darts, shell, threefold);
    break;
  }
  const std::string name = "shell " + std::to_string(shell);
  if (volume == 0) noteDefect(check.inverted_shells, check.problems, name + " has no volume");
  if (volume > 0 && solids != 0) {
    noteDefect(check.inverted_shells, check.problems, name + " lies inside another one");
  }
  if (volume < 0 && solids != 1) {
    noteDefect(check.inverted_shells, check.problems,
               name + " is turned inside out and no cavity of another one");
  }
}

}  // namespace

std::array<Wide, 3> areaVector(const PolyhedralFace& face,
                               const std::vector<LatticePoint>& points) {
  std::array<Wide, 3> sum{};
  forEachRing(face, [&](const std::vector<int>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto n = cross(points[at(ring[i])], points[at(ring[(i + 1) % ring.size()])]);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    }
  });
  return sum;
}

void checkVolume(const PolyhedralModel& model, const ModelDarts& darts, ModelCheck& check) {
  std::vector<Wide> volumes(at(darts.num_shells), 0);
  const double square = model.grid * model.grid;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    volumes[at(darts.shell[f])] += sixfoldVolume(model.faces[f], darts.points);
    const std::array<Wide, 3> n = areaVector(model.faces[f], darts.points);
    check.area +=
        0.5 * square *
        std::hypot(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2]));
  }
  Wide total = 0;
  for (const Wide volume : volumes) total += volume;
  check.volume = static_cast<double>(total) * square * model.grid / 6.0;
  if (check.open_edges + check.overused_edges + check.mislabelled > 0) return;
  for (int s = 0; s < darts.num_shells; ++s) checkShell(model, darts, s, volumes[at(s)], check);
}

}  // namespace detail
}  // namespace storey
