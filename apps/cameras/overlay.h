// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cameras/agreement.h"

namespace storey::cameras {

/// The photo, paled, with the points that it shows drawn on it, near ones red and far ones blue.
RgbImage drawPoints(const CloudPoints& cloud, const Camera& camera, const RgbImage& image);

}  // namespace storey::cameras
