// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade.h>
#include <storey/surface/polyhedral_model.h>
#include <storey/surface/window_detection.h>

#include <cstddef>
#include <vector>

namespace storey {

/// Cuts windows into a wall: each becomes a hole in it, a pane parallel to it and four reveals in
/// between [Sui et al. 2016, Sec. 5]. Corners are put on the model's grid, those of the holes where
/// they keep to the wall's plane best, within 6 grid units of where they should be. The model stays
/// valid (`checkModel`): windows with which it would not, as those that reach beyond their wall or
/// meet another face behind it, are left out.
/// \param face   of `model`, a wall
/// \param frame  of that face, seen from either side
/// \param depth  of the panes behind the plane, against the frame's normal; negative: in front.
///               Below 4 grid units nothing is cut
/// \return whether each window was cut; all false, after a PCL_ERROR, if the model is not valid or
///         the face no wall
std::vector<bool> cutWindows(PolyhedralModel& model, std::size_t face, const FacadeFrame& frame,
                             const std::vector<FacadeWindow>& windows, double depth);

}  // namespace storey
