// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <cstddef>
#include <string>
#include <vector>

namespace storey {

/// What `checkModel` found: how often each kind of defect occurs, and the size of the model.
struct ModelCheck {
  std::size_t bad_indices = 0;      ///< ring entries that are no vertex; unused vertices
  std::size_t off_grid = 0;         ///< vertices that are not exact multiples of the grid
  std::size_t bad_rings = 0;        ///< faces with a ring of < 3 corners, a repeated vertex or no
                                    ///< area, rings that cross, inner rings not inside the outer
  std::size_t non_planar = 0;       ///< walls further than one grid unit from a vertical plane,
                                    ///< caps that are not level
  std::size_t mislabelled = 0;      ///< roofs that face down, grounds and ceilings that face up
  std::size_t open_edges = 0;       ///< directed edges without a face on the other side
  std::size_t overused_edges = 0;   ///< directed edges that several faces run in one sense
  std::size_t split_vertices = 0;   ///< vertices whose faces are not one cycle
  std::size_t wrong_shells = 0;     ///< `shell` or `num_shells` disagrees with what is connected
  std::size_t bad_euler = 0;        ///< shells with an Euler number that is odd or above 2
  std::size_t inverted_shells = 0;  ///< no volume, or negative and not the wall of a cavity, or
                                    ///< inside another solid
  std::size_t t_junctions = 0;      ///< vertices within half a unit of an edge of their shell
  std::size_t self_contacts = 0;    ///< vertices of one shell in the same place
  std::size_t self_intersections = 0;  ///< pairs of triangles that meet elsewhere than they may
  std::size_t split_planes = 0;        ///< edges between two faces of the same plane

  double volume = 0.0;  ///< unit of the model, cubed; cavities subtracted
  double area = 0.0;    ///< of all faces
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  std::size_t shells = 0;  ///< connected parts of the surface
  int euler = 0;           ///< V - E + F of the triangulated surface: 2 for each shell of genus 0

  std::vector<std::string> problems;  ///< in words, the first few of each kind

  /// No defect of any kind.
  bool ok() const { return problems.empty(); }
};

/// Tests all that `PolyhedralModel` promises, in integers on the model's grid (exact predicates in
/// 128 bits). Never fails on broken models: what cannot be tested because of an earlier defect is
/// left out, and the earlier defect is reported.
///
/// Shells may touch other shells along edges and at points, but not overlap; a shell must not
/// touch itself at all. A shell of negative volume is the wall of a cavity: it must lie inside a
/// shell of positive volume. The empty model is reported as a problem (`bad_indices` stays 0).
/// \par Complexity near linear for buildings: sweeps over boxes sorted by x
ModelCheck checkModel(const PolyhedralModel& model);

}  // namespace storey
