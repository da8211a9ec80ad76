// SPDX-License-Identifier: BSD-3-Clause
#include "view/render.h"

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "io/failure.h"
#include "io/output_file.h"
#include "view/annotations.h"
#include "view/layout.h"
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

void prepareScene(vtkRenderer& renderer) {
  constexpr int kMaxPeels = 40;  // facets one behind the other
  renderer.SetBackground(1.0, 1.0, 1.0);
  renderer.SetUseDepthPeeling(1);
  renderer.SetMaximumNumberOfPeels(kMaxPeels);
  renderer.SetOcclusionRatio(0.0);
}

void writePng(const std::string& path, vtkRenderWindow& window) {
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(&window);
  grabber->SetInputBufferTypeToRGB();
  grabber->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(grabber->GetOutputPort());
  average->SetShrinkFactors(kOversampling, kOversampling, 1);
  average->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* const png = writer->GetResult();
  io::OutputFile file(path);
  file.write(png->GetPointer(0), static_cast<std::size_t>(png->GetNumberOfTuples()));
  file.commit();
}

}  // namespace

PictureWriter::PictureWriter(const PictureSize& size) : size_(size) {
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by a Failure, in one line
  const vtkNew<vtkRenderWindow> window;
  const bool needs_display = window->IsA("vtkXOpenGLRenderWindow") != 0;
  window->SetOffScreenRendering(1);
  if ((needs_display && !display_.usable()) || window->SupportsOpenGL() == 0) {
    throw io::Failure(io::Temporary, "", "there is no display with OpenGL to draw on",
                      "run it as: xvfb-run -a -s '-screen 0 1600x1200x24' storey_view ...");
  }
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
  addScene(*scene, drawing, layout, pixels);
  aimCamera(*scene, layout, projection, bounds, pixels);
  addAnnotations(*sheet, layout, drawing, projection, pixels);
  window->Render();
  writePng(path, *window);
}

}  // namespace storey::view
