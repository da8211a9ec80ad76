// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderer.h>

#include "view/drawing.h"
#include "view/layout.h"

namespace storey::view {

/// Puts what a drawing shows into a renderer, without camera and annotations.
/// \param pixels for a unit of length in the plane of the picture
void addScene(vtkRenderer& renderer, const Drawing& drawing, const Layout& layout, double pixels);

/// Gives a renderer of the whole window a camera that sees the bounds in the middle of the scene.
void aimCamera(vtkRenderer& renderer, const Layout& layout, const Projection& projection,
               const ProjectedBounds& bounds, double pixels);

}  // namespace storey::view
