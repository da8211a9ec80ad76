// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/boundary_complex.h>
#include <storey/surface/detail/grid_layers.h>

#include <map>
#include <vector>

namespace storey {
namespace detail {

/// Fills the surroundings of contacts with small prisms, as layers of their own: a diamond around
/// a vertex of the plan, the convex hull of two diamonds along an edge.
class Plugger {
 public:
  void plug(const PlanArrangement& plan, const SlabLabels& labels,
            const std::vector<Pinch>& pinches, std::vector<GridLayer>& layers);

 private:
  std::vector<GridPoint> diamonds(const PlanArrangement& plan, const Pinch& pinch);

  std::map<GridPoint, std::int64_t> radii_;  // plugs in one place have one size
};

/// Fills, for each contact, the smallest empty cell that ends there.
void fillCells(const PlanArrangement& plan, const std::vector<Pinch>& pinches, SlabLabels& labels);

}  // namespace detail
}  // namespace storey
