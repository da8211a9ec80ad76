// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <cstdint>
#include <string_view>

namespace storey::io {

/// Names of what faces are in files: of `FaceLabel`, in its order, and after them of the parts of
/// windows.
constexpr const char* kLabelNames[] = {"wall", "roof", "ground", "ceiling", "window", "reveal"};
constexpr std::uint8_t kNumLabels = 6;
constexpr std::uint8_t kWindowLabel = 4;
constexpr std::uint8_t kRevealLabel = 5;

/// What a face is in files.
inline std::uint8_t fileLabel(const PolyhedralFace& face) {
  switch (face.window) {
    case WindowPart::Pane:
      return kWindowLabel;
    case WindowPart::Reveal:
      return kRevealLabel;
    case WindowPart::None:
      break;
  }
  return static_cast<std::uint8_t>(face.label);
}

inline const char* labelName(std::uint8_t label) {
  return label < kNumLabels ? kLabelNames[label] : "other";
}

/// The label of this name; wall if there is none.
inline std::uint8_t labelOf(std::string_view name) {
  for (std::uint8_t label = 0; label < kNumLabels; ++label) {
    if (name == kLabelNames[label]) return label;
  }
  return 0;
}

}  // namespace storey::io
