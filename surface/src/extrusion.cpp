// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/face_merging.h>
#include <storey/surface/detail/grid_layers.h>
#include <storey/surface/detail/plugs.h>
#include <storey/surface/detail/slab_labels.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include <string>

namespace storey {
namespace {

using detail::GridEdge;
using detail::GridLayer;

constexpr int kMaxPlugRounds = 3;   // a plug can make parts touch that did not
constexpr int kMaxFillRounds = 64;  // each fills at least one cell

detail::PlanArrangement arrange(const std::vector<GridLayer>& layers) {
  std::vector<detail::GridSegment> segments;
  for (const GridLayer& layer : layers) {
    for (const GridEdge& edge : layer.edges) segments.emplace_back(edge.a, edge.b);
  }
  return detail::arrangeSegments(std::move(segments));
}

// The building on the lattice, cut into cells and elementary faces.
struct Solid {
  detail::PlanArrangement plan;
  detail::SlabLabels labels;
  detail::BoundaryComplex boundary;
  std::vector<detail::Pinch> pinches;

  void findBoundary() {
    boundary = detail::buildBoundary(plan, labels);
    pinches = detail::findPinches(labels, boundary);
  }
};

Solid buildSolid(const std::vector<GridLayer>& layers) {
  Solid solid;
  solid.plan = arrange(layers);
  if (solid.plan.interior.empty()) return solid;
  solid.labels = detail::labelCells(solid.plan, layers);
  solid.findBoundary();
  return solid;
}

// A solid whose shells do not touch themselves. The plugs come to the layers.
Solid buildManifold(std::vector<GridLayer>& layers) {
  detail::Plugger plugger;
  Solid solid = buildSolid(layers);
  for (int round = 0; round < kMaxPlugRounds && !solid.pinches.empty(); ++round) {
    plugger.plug(solid.plan, solid.labels, solid.pinches, layers);
    solid = buildSolid(layers);
  }
  // What plugs leave is small: whole cells between them.
  for (int round = 0; round < kMaxFillRounds && !solid.pinches.empty(); ++round) {
    detail::fillCells(solid.plan, solid.pinches, solid.labels);
    solid.findBoundary();
  }
  return solid;
}

}  // namespace

PolyhedralModel extrudeFloorplans(const std::vector<FloorplanLayer>& layers, double grid) {
  detail::Lattice lattice;
  std::string error;
  std::vector<GridLayer> rounded = detail::makeGridLayers(layers, grid, lattice, error);
  if (!error.empty()) {
    PCL_ERROR("[storey::extrudeFloorplans] %s.\n", error.c_str());
    return {};
  }
  const Solid solid = buildManifold(rounded);
  if (!solid.boundary.elements.empty()) {
    const std::vector<FloorplanEdge> sources =
        detail::findSources(solid.plan, solid.labels, solid.boundary, rounded);
    const auto merge = [&](std::int64_t strip) {
      return detail::mergeFaces(solid.plan, solid.labels, solid.boundary, sources, lattice, strip);
    };
    PolyhedralModel model = merge(detail::kPlanarStrip);
    // Walls that are planar only within the rounding can get in each other's way where the grid is
    // coarse against the details. Exactly planar ones cannot.
    if (!checkModel(model).ok()) model = merge(0);
    model.storeys = layers;
    return model;
  }
  PCL_ERROR("[storey::extrudeFloorplans] the floorplans enclose nothing on a grid of %g.\n",
            lattice.grid);
  return {};
}

}  // namespace storey
