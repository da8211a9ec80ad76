// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <vector>

#include "stacks.h"

namespace storey::test {

constexpr double kSigma = 0.1;

// Gives every edge of every layer a wall id of its own.
inline std::vector<FloorplanLayer> named(std::vector<FloorplanLayer> layers) {
  int next = 0;
  for (FloorplanLayer& l : layers) {
    for (FloorplanComponent& component : l.plan.components) {
      for (FloorplanEdge& edge : component.outer.edges) edge.wall = next++;
      for (FloorplanRing& hole : component.holes) {
        for (FloorplanEdge& edge : hole.edges) edge.wall = next++;
      }
    }
  }
  return layers;
}

inline FitOptions options() {
  FitOptions result;
  result.noise = kSigma;
  result.max_shift = 1.0;
  return result;
}

inline const std::vector<FloorplanLayer>& lShape() {
  static const std::vector<FloorplanLayer> layers =
      named({layer(0, 10, {ring({{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 15}, {0, 15}})})});
  return layers;
}

}  // namespace storey::test
