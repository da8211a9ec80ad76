// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/face_merging.h>
#include <storey/surface/detail/grid_layers.h>
#include <storey/surface/detail/slab_labels.h>
#include <storey/surface/extrusion.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace storey {
namespace {

using detail::GridEdge;
using detail::GridLayer;
using detail::GridPoint;

constexpr int kMaxRounds = 8;  // of plugging: a plug can join parts that touch elsewhere
constexpr std::int64_t kLargestPlug = 256;  // grid units
constexpr std::int64_t kExtentPerPlug = 4096;

detail::PlanArrangement arrange(const std::vector<GridLayer>& layers) {
  std::vector<detail::GridSegment> segments;
  for (const GridLayer& layer : layers) {
    for (const GridEdge& edge : layer.edges) segments.emplace_back(edge.a, edge.b);
  }
  return detail::arrangeSegments(std::move(segments));
}

// Half the diagonal of a plug around a vertex: small against the building and the edges that end
// there.
std::int64_t plugRadius(const detail::PlanArrangement& plan, int vertex) {
  const auto [low, high] = std::minmax_element(plan.vertices.begin(), plan.vertices.end());
  std::int64_t radius = std::min(kLargestPlug, (high->x - low->x) / kExtentPerPlug);
  for (const int h : plan.outgoing[static_cast<std::size_t>(vertex)]) {
    const GridPoint d = plan.to(h) - plan.from(h);
    const double length = std::sqrt(static_cast<double>(detail::dot(d, d)));
    radius = std::min(radius, static_cast<std::int64_t>(length / 3.0));
  }
  return std::max<std::int64_t>(radius, 1);
}

std::vector<GridPoint> convexHull(std::vector<GridPoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<GridPoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = hull.size();
    for (const GridPoint& p : points) {
      while (hull.size() >= begin + 2 &&
             detail::orient(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Layers of their own that fill the surroundings of contacts.
class Plugger {
 public:
  void plug(const detail::PlanArrangement& plan, const detail::SlabLabels& labels,
            const std::vector<detail::Pinch>& pinches, std::vector<GridLayer>& layers) {
    for (const detail::Pinch& pinch : pinches) {
      GridLayer plug;
      plug.z_min = labels.levels[static_cast<std::size_t>(pinch.slab)];
      plug.z_max = labels.levels[static_cast<std::size_t>(pinch.slab) + 1];
      const std::vector<GridPoint> hull = convexHull(diamonds(plan, pinch));
      for (std::size_t i = 0; i < hull.size(); ++i) {
        plug.edges.push_back({hull[i], hull[(i + 1) % hull.size()], {-1, true}});
      }
      layers.push_back(std::move(plug));
    }
  }

 private:
  std::vector<GridPoint> diamonds(const detail::PlanArrangement& plan, const detail::Pinch& pinch) {
    std::vector<GridPoint> corners;
    for (const int v : {pinch.a, pinch.b}) {
      const GridPoint& p = plan.vertices[static_cast<std::size_t>(v)];
      // The first plug shortens the edges: later ones in the same place must have its size.
      const std::int64_t r = radii_.emplace(p, plugRadius(plan, v)).first->second;
      corners.insert(corners.end(),
                     {{p.x + r, p.y}, {p.x, p.y + r}, {p.x - r, p.y}, {p.x, p.y - r}});
    }
    return corners;
  }

  std::map<GridPoint, std::int64_t> radii_;
};

}  // namespace

PolyhedralModel extrudeFloorplans(const std::vector<FloorplanLayer>& layers, double grid) {
  detail::Lattice lattice;
  std::string error;
  std::vector<GridLayer> rounded = detail::makeGridLayers(layers, grid, lattice, error);
  if (!error.empty()) {
    PCL_ERROR("[storey::extrudeFloorplans] %s.\n", error.c_str());
    return {};
  }
  Plugger plugger;
  for (int round = 0;; ++round) {
    const detail::PlanArrangement plan = arrange(rounded);
    if (plan.interior.empty()) break;
    const detail::SlabLabels labels = detail::labelCells(plan, rounded);
    const detail::BoundaryComplex boundary = detail::buildBoundary(plan, labels);
    const std::vector<detail::Pinch> pinches = detail::findPinches(labels, boundary);
    if (!pinches.empty() && round < kMaxRounds) {
      plugger.plug(plan, labels, pinches, rounded);
      continue;
    }
    const std::vector<FloorplanEdge> sources = detail::findSources(plan, labels, boundary, rounded);
    PolyhedralModel model =
        detail::mergeFaces(plan, labels, boundary, sources, lattice, detail::kPlanarStrip);
    model.storeys = layers;
    return model;
  }
  PCL_ERROR("[storey::extrudeFloorplans] the floorplans enclose nothing on a grid of %g.\n",
            lattice.grid);
  return {};
}

}  // namespace storey
