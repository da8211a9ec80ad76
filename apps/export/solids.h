// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <vector>

namespace storey::exports {

/// The shells of one connected solid, indices as in `PolyhedralFace::shell`.
struct Solid {
  int outer = 0;
  std::vector<int> cavities;
};

/// The solids of a model, ordered by their outer shell. Parts that touch in an edge or a point are
/// solids of their own.
std::vector<Solid> solidsOf(const PolyhedralModel& model);

/// The block over all that a shell covers in plan, from its foot to its top, on the grid of the
/// model: one solid without cavities.
PolyhedralModel blockOver(const PolyhedralModel& model, int shell);

}  // namespace storey::exports
