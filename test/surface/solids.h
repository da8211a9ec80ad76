// SPDX-License-Identifier: BSD-3-Clause
// What an extruded solid must be, from the layers that it is made of.
#pragma once

#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace storey::test {

inline std::string problemsOf(const ModelCheck& check) {
  const auto append = [](std::string all, const std::string& p) {
    return std::move(all) + p + "\n";
  };
  return std::accumulate(check.problems.begin(), check.problems.end(), std::string(), append);
}

// The truth, by the shoelace formula.
inline double layerVolume(const std::vector<FloorplanLayer>& layers) {
  double sum = 0.0;
  for (const FloorplanLayer& layer : layers) sum += area(layer.plan) * (layer.z_max - layer.z_min);
  return sum;
}

// Rounding moves each wall by at most one unit, each cap by half a unit.
inline double volumeTolerance(const std::vector<FloorplanLayer>& layers, double grid) {
  double sum = 0.0;
  for (const FloorplanLayer& layer : layers) {
    sum += perimeter(layer.plan) * (layer.z_max - layer.z_min) + area(layer.plan);
  }
  return sum * grid;
}

inline std::size_t countLabel(const PolyhedralModel& model, FaceLabel label) {
  return static_cast<std::size_t>(
      std::count_if(model.faces.begin(), model.faces.end(),
                    [&](const PolyhedralFace& f) { return f.label == label; }));
}

struct Expected {
  std::size_t vertices;
  std::size_t faces;
  int shells;
  int euler;
};

inline void expectSolid(const std::vector<FloorplanLayer>& layers, const Expected& expected) {
  const PolyhedralModel model = extrudeFloorplans(layers);
  const ModelCheck check = checkModel(model);
  EXPECT_TRUE(check.ok()) << problemsOf(check);
  EXPECT_EQ(model.vertices.size(), expected.vertices);
  EXPECT_EQ(model.faces.size(), expected.faces);
  EXPECT_EQ(model.num_shells, expected.shells);
  EXPECT_EQ(check.euler, expected.euler);
  EXPECT_NEAR(check.volume, layerVolume(layers), volumeTolerance(layers, model.grid));
}

}  // namespace storey::test
