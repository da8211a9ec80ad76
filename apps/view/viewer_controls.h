// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderer.h>

#include <string>

#include "view/layout.h"
#include "view/viewer_state.h"

namespace storey::view {

/// Writes what the window of the viewer has besides a picture: the line of keys or `status`, and
/// where the state asks for it the list of keys and stages over the scene.
void addControls(vtkRenderer& renderer, const Layout& layout, const ViewerState& state,
                 const std::string& status);

}  // namespace storey::view
