// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cameras/agreement.h"
#include "io/cameras/camera_set.h"

namespace storey::cameras {

/// What photos say of a cloud and of their cameras.
struct CameraCheck {
  std::vector<PhotoAgreement> agreement;  ///< of each photo
  double correlation = 0.0;               ///< of all
  Suspicion best;                         ///< the mistake that it would help most to undo
};

/// The cameras as JSON: format, number of points, and for each photo its number and name, size,
/// focal lengths and principal point in pixels, `world_to_camera` (3 x 4, by rows) and centre; with
/// a check also its agreement with the others, that of all, and the mistake that it would help most
/// to undo, if it would help at all. Names that are no UTF-8 are mended.
std::string toJson(const io::CameraSet& set, const std::optional<CameraCheck>& check);

}  // namespace storey::cameras
