// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_labels.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Windows like the one that was marked on one photo. The first grid is learnt from that photo
/// alone (something may hide the marked window in others), the next two in all photos, each from
/// the one before. \param outline of the mark, in the facade's frame
std::vector<FacadeWindow> searchMarked(const TextureGrid& grid,
                                       const std::vector<RectifiedView>& views, std::size_t photo,
                                       const std::vector<Eigen::Vector2d>& outline);

/// Windows like those of a first grid: learnt from it in all photos, their edges fitted.
/// \param scores that it was found in: cells that look like wall teach nothing
std::vector<FacadeWindow> searchFrom(const TextureGrid& grid,
                                     const std::vector<RectifiedView>& views, const BandGrid& first,
                                     const WindowScores& scores);

}  // namespace storey::detail
