// SPDX-License-Identifier: BSD-3-Clause
#include "view/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace storey::view {
namespace {

std::uint8_t toByte(double share) { return static_cast<std::uint8_t>(std::lround(255.0 * share)); }

}  // namespace

Colour fromHsv(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(6.0 * (hue - std::floor(hue)) + shift, 6.0);
    const double drop = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return toByte(value * (1.0 - saturation * drop));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

Colour distinctColour(std::size_t i, std::size_t n) {
  constexpr std::size_t kHuesToldApart = 6;
  const double hue = static_cast<double>(i) / static_cast<double>(n);
  const bool dark = n > kHuesToldApart && i % 2 == 1;
  return fromHsv(hue, dark ? 0.75 : 0.9, dark ? 0.55 : 0.9);
}

Colour sliceColour(std::size_t k) {
  constexpr double kWarm = 0.08;  // orange
  constexpr double kCold = 0.58;  // blue
  const double shade = static_cast<double>((k / 2) % 3);
  return fromHsv(k % 2 == 0 ? kWarm : kCold, 0.55 + 0.2 * shade, 0.95 - 0.17 * shade);
}

Colour sequentialColour(double share) {
  constexpr std::array<std::array<double, 3>, 5> kAnchors = {{{0.16, 0.08, 0.40},
                                                              {0.15, 0.33, 0.58},
                                                              {0.13, 0.58, 0.52},
                                                              {0.52, 0.79, 0.29},
                                                              {0.99, 0.89, 0.18}}};
  const double position = std::clamp(share, 0.0, 1.0) * (kAnchors.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(position), 3);
  const double rest = position - static_cast<double>(low);
  const auto channel = [&](std::size_t c) {
    return toByte((1.0 - rest) * kAnchors[low][c] + rest * kAnchors[low + 1][c]);
  };
  return {channel(0), channel(1), channel(2)};
}

Colour regionColour(std::size_t k) {
  constexpr std::size_t kColours = 12;
  constexpr std::size_t kStep = 5;
  return distinctColour(k * kStep % kColours, kColours);
}

Colour azimuthColour(double angle) { return fromHsv(angle / (2.0 * M_PI), 0.8, 0.85); }

Colour shaded(Colour colour, const Eigen::Vector3d& normal) {
  constexpr double kAmbient = 0.62;
  const Eigen::Vector3d to_light = Eigen::Vector3d(0.35, -0.75, 1.1).normalized();
  const double light =
      std::min(1.0, kAmbient + (1.0 - kAmbient) * 1.2 * std::max(0.0, normal.dot(to_light)));
  const auto dim = [&](std::uint8_t c) { return static_cast<std::uint8_t>(light * c); };
  return {dim(colour.r), dim(colour.g), dim(colour.b)};
}

std::vector<Colour> sequentialColours(std::size_t n) {
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < n; ++i) {
    colours.push_back(sequentialColour((static_cast<double>(i) + 0.5) / static_cast<double>(n)));
  }
  return colours;
}

}  // namespace storey::view
