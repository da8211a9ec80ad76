// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

/// Stacks of floorplans for the tests of the solid.
namespace storey::test {

inline FloorplanRing ring(std::vector<Eigen::Vector2d> vertices) {
  FloorplanRing result;
  result.edges.resize(vertices.size());
  result.vertices = std::move(vertices);
  return result;
}

inline FloorplanRing rectangle(double x0, double y0, double x1, double y1) {
  return ring({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

inline FloorplanRing reversed(FloorplanRing result) {
  std::reverse(result.vertices.begin(), result.vertices.end());
  std::reverse(result.edges.begin(), result.edges.end());
  return result;
}

inline FloorplanLayer layer(double z_min, double z_max, const std::vector<FloorplanRing>& rings) {
  FloorplanLayer result;
  result.z_min = z_min;
  result.z_max = z_max;
  for (const FloorplanRing& outer : rings) result.plan.components.push_back({outer, {}});
  return result;
}

/// Scales (heights too), turns and shifts.
inline void move(std::vector<FloorplanLayer>& layers, double scale, double yaw,
                 const Eigen::Vector2d& shift) {
  const Eigen::Rotation2Dd turn(yaw);
  const auto apply = [&](FloorplanRing& r) {
    for (Eigen::Vector2d& v : r.vertices) v = turn * (scale * v) + shift;
  };
  for (FloorplanLayer& l : layers) {
    l.z_min *= scale;
    l.z_max *= scale;
    for (FloorplanComponent& c : l.plan.components) {
      apply(c.outer);
      std::for_each(c.holes.begin(), c.holes.end(), apply);
    }
  }
}

/// The outlines of a set of cells of a grid with n x n cells, corners at `corner(i, j)`. Cells
/// that touch at a corner are separate there.
template <typename Corner>
Floorplan outlineCells(const std::vector<std::vector<bool>>& inside, Corner corner) {
  const int n = static_cast<int>(inside.size());
  const auto filled = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < n && j < n &&
           inside[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  };
  using Node = std::array<int, 2>;
  std::map<Node, std::vector<Node>> out;  // edges with the inside on their left
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (!filled(i, j)) continue;
      if (!filled(i, j - 1)) out[{i, j}].push_back({i + 1, j});
      if (!filled(i + 1, j)) out[{i + 1, j}].push_back({i + 1, j + 1});
      if (!filled(i, j + 1)) out[{i + 1, j + 1}].push_back({i, j + 1});
      if (!filled(i - 1, j)) out[{i, j + 1}].push_back({i, j});
    }
  }
  Floorplan plan;
  std::vector<FloorplanRing> holes;
  while (!out.empty()) {
    const Node start = out.begin()->first;
    Node at = start;
    Node from = start;
    FloorplanRing outline;
    do {
      std::vector<Node>& ways = out[at];
      // At a contact turn left, so that the ring stays with its own cell.
      const auto left = [&](const Node& to) {
        return (at[0] - from[0]) * (to[1] - at[1]) - (at[1] - from[1]) * (to[0] - at[0]);
      };
      const auto way =
          std::max_element(ways.begin(), ways.end(),
                           [&](const Node& a, const Node& b) { return left(a) < left(b); });
      const Node to = *way;
      ways.erase(way);
      if (ways.empty()) out.erase(at);
      outline.vertices.push_back(corner(at[0], at[1]));
      // walls of one grid line lie in one plane
      outline.edges.push_back({to[0] == at[0] ? at[0] : n + 1 + at[1], false});
      from = at;
      at = to;
    } while (at != start);
    if (signedArea(outline) > 0) {
      plan.components.push_back({outline, {}});
    } else {
      holes.push_back(outline);
    }
  }
  for (FloorplanRing& hole : holes) {
    // Which component a hole is listed under makes no difference to area and inside.
    plan.components.front().holes.push_back(std::move(hole));
  }
  return plan;
}

/// A stack of random cells of one grid, uneven, sheared and turned; sometimes cells keep from layer
/// to layer, sometimes all change.
inline std::vector<FloorplanLayer> randomCellStack(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int n = 2 + static_cast<int>(random() % 4);
  std::vector<double> x = {0.0};
  std::vector<double> y = {0.0};
  for (int i = 0; i < n; ++i) {
    x.push_back(x.back() + 0.5 + 3.0 * unit(random));
    y.push_back(y.back() + 0.5 + 3.0 * unit(random));
  }
  const double shear = random() % 3 == 0 ? 0.5 * unit(random) : 0.0;
  const Eigen::Rotation2Dd turn(random() % 3 == 0 ? 0.0 : 6.0 * unit(random));
  const auto corner = [&](int i, int j) {
    const double v = y[static_cast<std::size_t>(j)];
    return Eigen::Vector2d(turn * Eigen::Vector2d(x[static_cast<std::size_t>(i)] + shear * v, v));
  };
  const auto size = static_cast<std::size_t>(n);
  std::vector<std::vector<bool>> inside(size, std::vector<bool>(size, false));
  std::vector<FloorplanLayer> layers;
  double z = 0.0;
  const int num_layers = 1 + static_cast<int>(random() % 8);
  const double change = 0.1 + 0.9 * unit(random);
  const double fill = 0.3 + 0.5 * unit(random);
  for (int k = 0; k < num_layers; ++k) {
    for (auto& row : inside) {
      for (std::size_t j = 0; j < size; ++j) {
        if (k == 0 || unit(random) < change) row[j] = unit(random) < fill;
      }
    }
    inside[0][0] = true;  // never empty
    FloorplanLayer next;
    next.z_min = z;
    z += 0.3 + unit(random);
    next.z_max = z;
    next.plan = outlineCells(inside, corner);
    layers.push_back(next);
    if (random() % 6 == 0) z += 0.2;  // a gap
  }
  return layers;
}

/// A stack of random star-shaped polygons.
inline std::vector<FloorplanLayer> randomStarStack(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<FloorplanLayer> layers;
  const int num_layers = 2 + static_cast<int>(random() % 6);
  for (int k = 0; k < num_layers; ++k) {
    const int corners = 3 + static_cast<int>(random() % 10);
    std::vector<Eigen::Vector2d> vertices;
    const double phase = unit(random);
    const Eigen::Vector2d centre(2.0 * unit(random), 2.0 * unit(random));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * (i + phase) / corners;
      const double radius = 2.0 + 4.0 * unit(random);
      vertices.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    layers.push_back(layer(k, k + 1, {ring(vertices)}));
  }
  return layers;
}

}  // namespace storey::test
