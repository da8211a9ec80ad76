// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <array>
#include <cstddef>
#include <string>

#include "io/label_names.h"

namespace storey::exports {

/// Colours of faces, shares of red, green and blue, in the order of `io::kLabelNames`.
constexpr std::array<std::array<double, 3>, io::kNumLabels> kFaceColours = {{{0.85, 0.82, 0.76},
                                                                             {0.70, 0.34, 0.28},
                                                                             {0.45, 0.45, 0.42},
                                                                             {0.60, 0.58, 0.66},
                                                                             {0.36, 0.50, 0.62},
                                                                             {0.74, 0.71, 0.66}}};

/// A material for each label, and after them one for each label of faces that are guessed.
constexpr std::size_t kNumMaterials = 2 * std::size_t{io::kNumLabels};

inline std::size_t materialOf(const PolyhedralFace& face) {
  return std::size_t{io::fileLabel(face)} + (face.hypothetical ? io::kNumLabels : 0);
}

inline std::string materialName(std::size_t material) {
  const bool guessed = material >= io::kNumLabels;
  return io::labelName(static_cast<std::uint8_t>(material % io::kNumLabels)) +
         std::string(guessed ? "_hypothetical" : "");
}

/// Guessed faces are paler.
inline std::array<double, 3> materialColour(std::size_t material) {
  std::array<double, 3> colour = kFaceColours[material % io::kNumLabels];
  if (material >= io::kNumLabels) {
    for (double& channel : colour) channel = 0.5 + 0.5 * channel;
  }
  return colour;
}

}  // namespace storey::exports
