// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <cstddef>
#include <string>
#include <vector>

#include "synth/surface_sampler.h"

namespace storey::bench {

/// About the area of the walls of a tooth of `toothedBlock`.
constexpr double kToothArea = 36.0;

/// A block whose two long sides are cut into teeth of all depths, so that no two of its walls lie
/// in one plane. \param walls a multiple of 8
std::vector<FloorplanLayer> toothedBlock(std::size_t walls);

/// Samples a building as the paper does and writes its cloud as binary PLY with normals.
void writeCloud(const std::string& path, const std::vector<FloorplanLayer>& building,
                std::size_t points, synth::SampledFaces faces = synth::SampledFaces::Walls);

}  // namespace storey::bench
