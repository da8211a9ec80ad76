// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/flat_face.h>
#include <storey/surface/model_check.h>

#include <array>
#include <string>
#include <vector>

namespace storey {
namespace detail {

struct FaceTriangle {
  std::array<int, 3> vertices;
  int face;
};

/// A model taken apart for the checks. A dart is one directed edge of a ring.
struct ModelDarts {
  std::vector<FaceTriangle> triangles;  ///< ascending by face
  std::vector<LatticePoint> points;     ///< of the vertices, relative to their smallest coordinates
  std::vector<int> from;                ///< dart -> vertex
  std::vector<int> next;                ///< dart -> the next one of its ring
  std::vector<int> twin;   ///< dart -> the one in the opposite sense, -1: none or several
  std::vector<int> face;   ///< dart -> face
  std::vector<int> shell;  ///< face -> connected part of the surface
  int num_shells = 0;

  std::size_t numDarts() const { return from.size(); }
  int to(int dart) const {
    return from[static_cast<std::size_t>(next[static_cast<std::size_t>(dart)])];
  }
};

/// Counts a defect and describes the first few of its kind.
void noteDefect(std::size_t& count, std::vector<std::string>& problems, const std::string& what);

/// The topology: edges, vertices, shells, Euler numbers. All faces must be polygons.
void checkTopology(const PolyhedralModel& model, ModelDarts& darts, ModelCheck& check);

/// T-junctions, contacts and intersections. All faces must be polygons.
void checkContacts(const ModelDarts& darts, ModelCheck& check);

/// Volume, area, and the sense of the shells.
void checkVolume(const PolyhedralModel& model, const ModelDarts& darts, ModelCheck& check);

/// Twice the area vector of a face, all rings.
std::array<Wide, 3> areaVector(const PolyhedralFace& face, const std::vector<LatticePoint>& points);

}  // namespace detail
}  // namespace storey
