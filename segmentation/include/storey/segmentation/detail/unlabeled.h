// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace storey {

/// The label of a point that has none: its position or normal is not usable.
constexpr std::uint32_t kUnlabeled = UINT32_MAX;

}  // namespace storey
