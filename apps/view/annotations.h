// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderer.h>

#include "view/drawing.h"
#include "view/layout.h"

namespace storey::view {

/// Writes around the scene what a drawing says about itself: title, legend, colour bar, the axes
/// and a scale bar.
/// \param renderer covers the whole window
/// \param pixels   for a unit of length in the plane of the picture
void addAnnotations(vtkRenderer& renderer, const Layout& layout, const Drawing& drawing,
                    const Projection& projection, double pixels);

}  // namespace storey::view
