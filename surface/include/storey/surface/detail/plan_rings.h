// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

namespace storey::detail {

/// Calls `visit(ring)` for the outer ring of each component and for its holes. \param plan a
/// Floorplan, const or not
template <typename Plan, typename Visit>
void forEachRing(Plan& plan, const Visit& visit) {
  for (auto& component : plan.components) {
    visit(component.outer);
    for (auto& hole : component.holes) visit(hole);
  }
}

}  // namespace storey::detail
