// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace storey::synth {

/// A building with known truth: its floorplans from the bottom (z = 0) up. Every edge has a wall
/// id, the same for all edges in one vertical plane. Units are those of the paper's synthetic
/// clouds, where the noise is 0.1 and a building about 26 wide [Sui et al. 2016, Sec. 6.1].
struct Building {
  std::string name;
  std::vector<FloorplanLayer> layers;
  std::size_t points = 200000;  ///< size of the cloud unless the user asks for another
};

struct NamedBuilding {
  std::string name;
  std::string description;
};

/// The names that `makeBuilding` knows, `random:SEED` among them.
const std::vector<NamedBuilding>& namedBuildings();

/// The building of that name; without layers if there is none. `random:SEED` takes a decimal
/// number below 2^64.
Building makeBuilding(const std::string& name);

/// A building drawn at random: 1-6 floorplan types, up to 4 components with 3-16 walls each,
/// courtyards, setbacks, overhangs, towers, legs, any wall directions, now and then two parallel
/// walls only 0.25 (2.5 deviations of the noise) apart. All its outlines are simple, components
/// and parallel walls keep a clear distance otherwise, and every component stands on the layer
/// below. The same seed gives the same building on every machine.
std::vector<FloorplanLayer> randomBuilding(std::uint64_t seed);

/// Number of different directions of outward wall normals (a box has 4); angles closer than
/// `tolerance` (rad) are one.
std::size_t countDirections(const std::vector<FloorplanLayer>& layers, double tolerance = 1e-6);

}  // namespace storey::synth
