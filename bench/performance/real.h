// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace storey::bench {

/// Runs storey_reconstruct on every cloud of a folder, with the options that its options.txt gives,
/// and prints what that took.
void measureRealClouds(const std::string& folder, const std::string& scratch);

}  // namespace storey::bench
