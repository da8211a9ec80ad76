// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::view {

/// Where the environment names no display and `xvfb-run` is to be had: starts the program again
/// under it, on a display of which nothing is seen, and so does not return. Else returns.
void restartOnVirtualDisplay(char** argv);

}  // namespace storey::view
