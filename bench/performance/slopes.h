// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace storey::bench {

/// How the time of the stages grows with the number of slices (method paper) and of walls (method
/// building) at a fixed number of points, to stdout. \param quick leaves out the largest
void measureSlopes(const std::string& scratch, bool quick);

}  // namespace storey::bench
