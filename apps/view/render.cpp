// SPDX-License-Identifier: BSD-3-Clause
#include "view/render.h"

#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "io/failure.h"
#include "view/annotations.h"
#include "view/layout.h"
#include "view/png.h"
#include "view/scene.h"

namespace storey::view {
namespace {

// Rendered in each direction for one pixel of the picture and averaged: smooth edges on every
// OpenGL, also where multisampling is missing or forbidden by depth peeling.
constexpr int kOversampling = 2;

void prepareWindow(vtkRenderWindow& window, const PictureSize& size) {
  window.SetOffScreenRendering(1);
  window.SetShowWindow(false);
  window.SetDPI(72);  // a font size is its pixels
  window.SetMultiSamples(0);
  window.SetAlphaBitPlanes(1);
  window.SetNumberOfLayers(2);
  window.SetSize(kOversampling * size.width, kOversampling * size.height);
}

}  // namespace

void prepareScene(vtkRenderer& renderer) {
  constexpr int kMaxPeels = 40;  // facets one behind the other
  renderer.SetBackground(1.0, 1.0, 1.0);
  renderer.SetUseDepthPeeling(1);
  renderer.SetMaximumNumberOfPeels(kMaxPeels);
  renderer.SetOcclusionRatio(0.0);
}

void requireOpenGl(const DisplayConnection& display, const std::string& hint) {
  const vtkNew<vtkRenderWindow> window;
  const bool needs_display = window->IsA("vtkXOpenGLRenderWindow") != 0;
  window->SetOffScreenRendering(1);
  if ((needs_display && !display.usable()) || window->SupportsOpenGL() == 0) {
    throw io::Failure(io::Temporary, "", "there is no display with OpenGL to draw on", hint);
  }
}

PictureWriter::PictureWriter(const PictureSize& size) : size_(size) {
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by a Failure, in one line
  requireOpenGl(display_, "install xvfb, and unset DISPLAY: it is then drawn out of sight");
}

void PictureWriter::write(const std::string& path, const Drawing& drawing) const {
  vtkNew<vtkRenderWindow> window;
  prepareWindow(*window, size_);
  const Layout layout = layoutOf(kOversampling * size_.width, kOversampling * size_.height);
  const Projection projection = projectionOf(drawing.view);
  const ProjectedBounds bounds = boundsOf(drawing, projection);
  const double pixels = pixelsPerLength(layout, bounds);

  vtkNew<vtkRenderer> scene;
  prepareScene(*scene);
  vtkNew<vtkRenderer> sheet;
  sheet->SetLayer(1);
  window->AddRenderer(scene);
  window->AddRenderer(sheet);
  liftLines(addScene(*scene, drawing, layout, pixels), drawing, layout, projection.towards, pixels);
  aimCamera(*scene, layout, projection, bounds, pixels);
  addAnnotations(*sheet, layout, drawing, projection, pixels);
  window->Render();
  writePng(path, *window, kOversampling);
}

}  // namespace storey::view
