// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "view/drawing.h"

namespace storey::view {

constexpr Colour kNoLabel{205, 205, 205};  ///< points that a stage gave nothing
constexpr Colour kDark{35, 35, 40};        ///< edges and writing

/// Hue in turns (1 = once round, 0 = red), saturation and value within [0, 1].
Colour fromHsv(double hue, double saturation, double value);

/// Colour i of n that differ pairwise, hues at equal distances; needs i < n.
Colour distinctColour(std::size_t i, std::size_t n);

/// Colour of slice k: warm and cold hues in turn, three shades of each.
Colour sliceColour(std::size_t k);

/// From dark blue at 0 over green to yellow at 1, lighter all the way; clamped.
Colour sequentialColour(double share);

/// Colour of edge region k: twelve in turn, neighbours far apart in hue.
Colour regionColour(std::size_t k);

/// Colour of a horizontal direction; angle in radians from +x to +y.
Colour azimuthColour(double angle);

/// The colour under a fixed light, so that a wall looks the same from every side: from the
/// south-south-east, high. \param normal unit
Colour shaded(Colour colour, const Eigen::Vector3d& normal);

/// n colours of `sequentialColour` from 0 to 1, for a bar.
std::vector<Colour> sequentialColours(std::size_t n);

}  // namespace storey::view
