// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/grid_layers.h>
#include <storey/surface/detail/plan_rings.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey {
namespace detail {
namespace {

constexpr double kSnapDistance = 1.0;             // grid units, from a vertex to an edge
constexpr double kDefaultGrid = 1.0 / (1 << 20);  // of the extent
constexpr double kMaxLatticeIndex = 4.5e15;       // 2^52: index * grid is still exact to the unit

struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = -min;
};

std::string checkLayers(const std::vector<FloorplanLayer>& layers, Bounds& bounds) {
  bool any = false;
  std::string error;
  for (const FloorplanLayer& layer : layers) {
    if (!(std::isfinite(layer.z_min) && std::isfinite(layer.z_max) && layer.z_min < layer.z_max)) {
      return "a layer from z " + std::to_string(layer.z_min) + " to " +
             std::to_string(layer.z_max) + ", expected z_min < z_max";
    }
    forEachRing(layer.plan, [&](const FloorplanRing& ring) {
      if (ring.size() < 3) error = "a ring with less than 3 vertices";
      if (ring.edges.size() != ring.size())
        error = "a ring with unequal numbers of edges and vertices";
      for (const Eigen::Vector2d& v : ring.vertices) {
        if (!v.allFinite()) error = "a vertex that is not finite";
        bounds.min = bounds.min.cwiseMin(Eigen::Vector3d(v.x(), v.y(), layer.z_min));
        bounds.max = bounds.max.cwiseMax(Eigen::Vector3d(v.x(), v.y(), layer.z_max));
      }
      any = true;
    });
    if (!error.empty()) return error;
  }
  return any ? "" : "no layer with a floorplan";
}

std::string chooseLattice(const Bounds& bounds, double grid, Lattice& lattice) {
  const double extent = (bounds.max - bounds.min).maxCoeff();
  if (grid == 0.0) grid = std::pow(10.0, std::ceil(std::log10(extent * kDefaultGrid)));
  if (!(grid > 0.0) || !std::isfinite(grid)) {
    return "a grid of " + std::to_string(grid) + ", expected > 0, or 0 for the default";
  }
  if (!(extent / grid < static_cast<double>(kMaxLatticeExtent))) {
    return "a grid finer than 2^-30 of the extent";
  }
  if (!(bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).maxCoeff() / grid <
        kMaxLatticeIndex)) {
    return "coordinates too far from the origin for the grid";
  }
  lattice.grid = grid;
  for (int i = 0; i < 3; ++i) lattice.origin[i] = std::llround(bounds.min[i] / grid);
  return "";
}

// A vertex in grid units, not yet rounded, and rounded.
struct Corner {
  Eigen::Vector2d exact;
  GridPoint rounded;
};

Corner toCorner(const Eigen::Vector2d& v, const Lattice& lattice) {
  Corner corner;
  const double x = v.x() / lattice.grid;
  const double y = v.y() / lattice.grid;
  corner.exact = {x - static_cast<double>(lattice.origin[0]),
                  y - static_cast<double>(lattice.origin[1])};
  corner.rounded = {std::llround(x) - lattice.origin[0], std::llround(y) - lattice.origin[1]};
  return corner;
}

// All different corners, ascending by x.
std::vector<Corner> collectCorners(const std::vector<FloorplanLayer>& layers,
                                   const Lattice& lattice) {
  std::vector<Corner> corners;
  for (const FloorplanLayer& layer : layers) {
    forEachRing(layer.plan, [&](const FloorplanRing& ring) {
      for (const Eigen::Vector2d& v : ring.vertices) corners.push_back(toCorner(v, lattice));
    });
  }
  const auto key = [](const Corner& c) {
    return std::make_tuple(c.rounded, c.exact.x(), c.exact.y());
  };
  std::sort(corners.begin(), corners.end(),
            [&](const Corner& a, const Corner& b) { return key(a) < key(b); });
  const auto same = [](const Corner& a, const Corner& b) { return a.rounded == b.rounded; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  return corners;
}

// Appends the edge from a to b, split at the corners on it.
void appendPieces(const Corner& a, const Corner& b, const FloorplanEdge& source,
                  const std::vector<Corner>& corners, std::vector<GridEdge>& edges) {
  const Eigen::Vector2d direction = b.exact - a.exact;
  const double length = direction.norm();
  const auto [x_min, x_max] = std::minmax(a.exact.x(), b.exact.x());
  const auto [y_min, y_max] = std::minmax(a.exact.y(), b.exact.y());
  std::vector<std::pair<double, GridPoint>> stops;
  auto it = std::lower_bound(
      corners.begin(), corners.end(), x_min - 2.0 * kSnapDistance,
      [](const Corner& c, double x) { return static_cast<double>(c.rounded.x) < x; });
  for (; it != corners.end() && static_cast<double>(it->rounded.x) <= x_max + 2.0 * kSnapDistance;
       ++it) {
    const Eigen::Vector2d& p = it->exact;
    if (p.y() < y_min - kSnapDistance || p.y() > y_max + kSnapDistance) continue;
    if (it->rounded == a.rounded || it->rounded == b.rounded) continue;
    const Eigen::Vector2d offset = p - a.exact;
    const double along = offset.dot(direction) / length;
    const double across =
        std::abs(direction.x() * offset.y() - direction.y() * offset.x()) / length;
    if (along > 0.0 && along < length && across <= kSnapDistance) {
      stops.emplace_back(along, it->rounded);
    }
  }
  std::sort(stops.begin(), stops.end());
  stops.emplace_back(length, b.rounded);
  GridPoint from = a.rounded;
  for (const auto& stop : stops) {
    if (stop.second == from) continue;
    edges.push_back({from, stop.second, source});
    from = stop.second;
  }
}

}  // namespace

std::vector<GridLayer> makeGridLayers(const std::vector<FloorplanLayer>& layers, double grid,
                                      Lattice& lattice, std::string& error) {
  Bounds bounds;
  error = checkLayers(layers, bounds);
  if (error.empty()) error = chooseLattice(bounds, grid, lattice);
  if (!error.empty()) return {};
  const std::vector<Corner> corners = collectCorners(layers, lattice);
  std::vector<GridLayer> result;
  for (const FloorplanLayer& layer : layers) {
    GridLayer rounded;
    rounded.z_min = std::llround(layer.z_min / lattice.grid) - lattice.origin[2];
    rounded.z_max = std::llround(layer.z_max / lattice.grid) - lattice.origin[2];
    if (rounded.z_min == rounded.z_max) continue;
    forEachRing(layer.plan, [&](const FloorplanRing& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Corner a = toCorner(ring.vertices[i], lattice);
        const Corner b = toCorner(ring.vertices[(i + 1) % ring.size()], lattice);
        if (a.rounded != b.rounded) appendPieces(a, b, ring.edges[i], corners, rounded.edges);
      }
    });
    if (!rounded.edges.empty()) result.push_back(std::move(rounded));
  }
  if (result.empty()) error = "nothing is left on a grid of " + std::to_string(lattice.grid);
  return result;
}

}  // namespace detail
}  // namespace storey
