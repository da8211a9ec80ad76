// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>

#include <vector>

#include "view/drawing.h"
#include "view/layout.h"

namespace storey::view {

/// Puts what a drawing shows into a renderer, without camera and annotations.
/// \param pixels for a unit of length in the plane of the picture
/// \return the actors of the lines, for `liftLines`; the renderer keeps them
std::vector<vtkActor*> addScene(vtkRenderer& renderer, const Drawing& drawing, const Layout& layout,
                                double pixels);

/// Brings lines before the facets that they bound: towards the eye, which is not seen.
void liftLines(const std::vector<vtkActor*>& lines, const Drawing& drawing, const Layout& layout,
               const Eigen::Vector3d& towards, double pixels);

/// Gives a renderer of the whole window a camera that sees the bounds in the middle of the scene.
void aimCamera(vtkRenderer& renderer, const Layout& layout, const Projection& projection,
               const ProjectedBounds& bounds, double pixels);

}  // namespace storey::view
