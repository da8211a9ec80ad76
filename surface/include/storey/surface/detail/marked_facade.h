// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/window_detection.h>

#include <string>
#include <vector>

namespace storey::detail {

/// Where a mark lies on the model.
struct MarkedFacade {
  std::string problem;  ///< why there is none; empty if there is one
  std::size_t facade = 0;
  FacadeFrame frame;
  std::vector<Eigen::Vector2d> outline;  ///< the mark in the frame's coordinates
};

/// The facade that the middle of a mark shows, and the mark on it. All four corners must be on it.
MarkedFacade findMarked(const std::vector<Facade>& facades, const Camera& camera,
                        const WindowMark& mark, const Eigen::Vector3d& vertical);

}  // namespace storey::detail
