// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_labels.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Windows like the one that was marked on one photo: from the grid that tells most about the
/// facade's colours among those that the mark is a window of; where there is none, from what that
/// photo alone shows to be like the mark, for something may hide the marked window in others.
/// \param outline of the mark, in the facade's frame
std::vector<FacadeWindow> searchMarked(const TextureGrid& grid,
                                       const std::vector<RectifiedView>& views, std::size_t photo,
                                       const std::vector<Eigen::Vector2d>& outline);

/// Windows like those of a first grid: learnt from it in all photos, their edges fitted.
/// \param scores that it was found in: cells that look like wall teach nothing
std::vector<FacadeWindow> searchFrom(const TextureGrid& grid,
                                     const std::vector<RectifiedView>& views, const BandGrid& first,
                                     const WindowScores& scores);

}  // namespace storey::detail
