// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

namespace storey::io {

/// Names of `FaceLabel` in files, in its order.
constexpr const char* kLabelNames[] = {"wall", "roof", "ground", "ceiling"};
constexpr std::uint8_t kNumLabels = 4;

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
