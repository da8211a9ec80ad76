// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/extrusion.h>

#include <string>
#include <vector>

#include "surface/stacks.h"
#include "synth/buildings.h"

/// Models that a format may stumble over, and frames that its numbers may.
namespace storey::test {

struct NamedModel {
  std::string name;
  std::vector<FloorplanLayer> layers;
  std::size_t solids = 1;
};

inline std::vector<NamedModel> stackedModels() {
  std::vector<FloorplanLayer> court = {layer(0, 3, {rectangle(0, 0, 9, 7)})};
  court[0].plan.components[0].holes = {reversed(rectangle(2, 2, 5, 4))};
  std::vector<FloorplanLayer> cavity = {layer(-1, 0, {rectangle(0, 0, 9, 7)}), court[0],
                                        layer(3, 4.5, {rectangle(0, 0, 9, 7)})};
  // Roof with a hole: a tower in the middle of a podium.
  std::vector<FloorplanLayer> tower = {layer(0, 2, {rectangle(0, 0, 9, 7)}),
                                       layer(2, 8, {rectangle(3, 2, 6, 5)})};
  std::vector<FloorplanLayer> overhang = {layer(0, 2, {rectangle(1, 1, 3, 3)}),
                                          layer(2, 5, {rectangle(0, 0, 9, 7)})};
  return {
      {"box", {layer(0, 3, {rectangle(0, 0, 4, 2)})}},
      {"courtyard", court},
      {"cavity", cavity},
      {"tower", tower},
      {"overhang", overhang},
      {"touching in an edge", {layer(0, 3, {rectangle(0, 0, 4, 2), rectangle(4, 2, 7, 6)})}, 2},
      {"apart", {layer(0, 3, {rectangle(0, 0, 4, 2)}), layer(5, 6, {rectangle(0, 0, 1, 1)})}, 2}};
}

/// Turned, so that no wall runs along an axis, and with one id a wall.
inline PolyhedralModel modelOf(std::vector<FloorplanLayer> layers, double scale = 1.0) {
  move(layers, scale, 0.3, Eigen::Vector2d(scale * 20.0, scale * -7.0));
  int wall = 0;
  for (FloorplanLayer& l : layers) {
    for (FloorplanComponent& c : l.plan.components) {
      for (FloorplanEdge& e : c.outer.edges) e.wall = wall++;
      for (FloorplanRing& hole : c.holes) {
        for (FloorplanEdge& e : hole.edges) e.wall = wall++;
      }
    }
  }
  return extrudeFloorplans(layers);
}

struct NamedFrame {
  std::string name;
  Eigen::Isometry3d local_to_input = Eigen::Isometry3d::Identity();
};

/// As the cloud's, far out, and far out and turned (a tower on the globe).
inline std::vector<NamedFrame> frames() {
  NamedFrame here{"as it is"};
  NamedFrame far{"far out"};
  far.local_to_input.translation() = Eigen::Vector3d(1e7, -3e7, 1234.5);
  NamedFrame globe{"on the globe"};
  globe.local_to_input.translation() = Eigen::Vector3d(1141745.25, 5391160.5, 3201808.125);
  globe.local_to_input.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(),
                                         Eigen::Vector3d(0.178839, 0.84445, 0.504898))
          .toRotationMatrix();
  return {here, far, globe};
}

/// Calls with every model, at every scale, in every frame, and with what to call them.
template <typename Check>
void forEachExported(Check check) {
  for (const double scale : {1.0, 0.001}) {
    for (const NamedModel& named : stackedModels()) {
      const PolyhedralModel model = modelOf(named.layers, scale);
      for (const NamedFrame& frame : frames()) {
        check(named.name + " " + frame.name + " at scale " + std::to_string(scale), model,
              frame.local_to_input, named.solids);
      }
    }
  }
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const PolyhedralModel model = modelOf(synth::randomBuilding(seed));
    for (const NamedFrame& frame : frames()) {
      check("random:" + std::to_string(seed) + " " + frame.name, model, frame.local_to_input,
            static_cast<std::size_t>(model.num_shells));
    }
  }
}

}  // namespace storey::test
