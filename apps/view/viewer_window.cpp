// SPDX-License-Identifier: BSD-3-Clause
#include "view/viewer_window.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "io/failure.h"
#include "view/annotations.h"
#include "view/layout.h"
#include "view/palette.h"
#include "view/png.h"
#include "view/render.h"
#include "view/scene.h"
#include "view/stages.h"
#include "view/viewer_controls.h"

namespace storey::view {
namespace {

// Mouse as VTK's own; its keys would shade, pick and quit.
class MouseStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static MouseStyle* New() { VTK_STANDARD_NEW_BODY(MouseStyle); }
  void OnChar() override { window->press(Interactor->GetKeyCode()); }

  ViewerWindow* window = nullptr;
};

Projection projectionOf(vtkCamera& camera) {
  Projection projection;
  camera.GetDirectionOfProjection(projection.towards.data());
  projection.towards *= -1.0;
  camera.GetViewUp(projection.up.data());
  projection.right = projection.up.cross(projection.towards).normalized();
  projection.up = projection.towards.cross(projection.right);
  return projection;
}

double pixelsOf(vtkCamera& camera, const Layout& layout) {
  return layout.height / (2.0 * camera.GetParallelScale());
}

}  // namespace

ViewerWindow::ViewerWindow(const Reconstruction& reconstruction, ViewerState state,
                           const PictureSize& size)
    : reconstruction_(reconstruction), state_(std::move(state)) {
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by a Failure, in one line
  requireOpenGl(display_, "run it where there is a screen, or with --pictures");
  prepare(size);
  prepareSlider();
  draw();
}

// A loop of our own: VTK 9.1 asks its display for events once more after the end of its own loop.
void ViewerWindow::run() {
  constexpr std::chrono::milliseconds kPause(10);
  while (!closed_) {
    interactor_->ProcessEvents();
    std::this_thread::sleep_for(kPause);
  }
}

void ViewerWindow::prepare(const PictureSize& size) {
  constexpr double kMostOfScreen = 0.9;
  window_->SetDPI(72);          // a font size is its pixels
  window_->SetMultiSamples(0);  // depth peeling forbids it
  window_->SetAlphaBitPlanes(1);
  window_->SetNumberOfLayers(3);
  window_->SetWindowName("storey_view");
  const int* const screen = window_->GetScreenSize();
  window_->SetSize(std::min(size.width, static_cast<int>(kMostOfScreen * screen[0])),
                   std::min(size.height, static_cast<int>(kMostOfScreen * screen[1])));
  prepareScene(*scene_);
  scene_->UseFXAAOn();
  sheet_->SetLayer(1);
  sheet_->InteractiveOff();
  window_->AddRenderer(scene_);
  window_->AddRenderer(sheet_);
  controls_->SetLayer(2);
  controls_->InteractiveOff();
  window_->AddRenderer(controls_);
  scene_->AddObserver(vtkCommand::StartEvent, this, &ViewerWindow::annotate);
  interactor_->SetRenderWindow(window_);
  vtkNew<MouseStyle> style;
  style->window = this;
  style->AddObserver(vtkCommand::EndInteractionEvent, this, &ViewerWindow::noteMove);
  interactor_->SetInteractorStyle(style);
  interactor_->AddObserver(vtkCommand::ExitEvent, this, &ViewerWindow::close);
  interactor_->Initialize();
}

void ViewerWindow::prepareSlider() {
  const auto paint = [](vtkProperty2D& property, Colour colour) {
    property.SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  };
  paint(*slider_->GetTubeProperty(), {205, 205, 210});
  paint(*slider_->GetCapProperty(), {205, 205, 210});
  paint(*slider_->GetSliderProperty(), {60, 100, 160});
  paint(*slider_->GetSelectedProperty(), {60, 100, 160});
  slider_->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  slider_->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  slider_->GetPoint1Coordinate()->SetValue(0.56, 0.07);
  slider_->GetPoint2Coordinate()->SetValue(0.96, 0.07);
  slider_->SetTubeWidth(0.006);
  slider_->SetSliderLength(0.02);
  slider_->SetSliderWidth(0.02);
  slider_->SetEndCapLength(0.004);
  slider_->ShowSliderLabelOff();  // the title has the number
  slider_widget_->SetInteractor(interactor_);
  slider_widget_->SetCurrentRenderer(controls_);
  slider_widget_->SetDefaultRenderer(controls_);
  slider_widget_->SetRepresentation(slider_);
  slider_widget_->SetAnimationModeToJump();
  slider_widget_->KeyPressActivationOff();  // else it takes the key i
  slider_widget_->AddObserver(vtkCommand::InteractionEvent, this, &ViewerWindow::moveToSlider);
}

void ViewerWindow::press(char key) {
  status_.clear();
  switch (state_.press(key)) {
    case ViewerState::Action::Draw:
      draw();
      break;
    case ViewerState::Action::Aim:
      aim();
      window_->Render();
      break;
    case ViewerState::Action::Save:
      save();
      break;
    case ViewerState::Action::Close:
      close();
      break;
    default:
      window_->Render();
  }
}

Layout ViewerWindow::place() const {
  const int* const size = window_->GetSize();
  return layoutOf(size[0], size[1]);
}

Drawing ViewerWindow::makeCurrentDrawing() const {
  const ViewerState::Entry& entry = state_.entry();
  Drawing drawing;
  drawing.title = std::string("No picture of ") + infoOf(entry.stage).name;
  if (!entry.missing.empty()) {
    const bool of_slices = entry.stage >= Stage::Slices && entry.stage <= Stage::Segments;
    drawing.subtitle = "there is no " + entry.missing + "; storey_reconstruct --intermediate " +
                       (of_slices ? "--method paper " : "") + "leaves it";
    return drawing;
  }
  try {
    const View view = isPlan(entry.stage) ? View::Top : View::Free;
    return makeDrawing(reconstruction_, entry.stage, view, state_.step(), state_.overlay());
  } catch (const io::Failure& failure) {
    drawing.subtitle = failure.what();
  }
  return drawing;
}

void ViewerWindow::draw() {
  drawing_ = makeCurrentDrawing();
  scene_->RemoveAllViewProps();
  lines_.clear();
  const Projection projection = view::projectionOf(drawing_.view);
  const ProjectedBounds bounds = boundsOf(drawing_, projection);
  if (!bounds.empty()) {
    const Layout layout = place();
    lines_ = addScene(*scene_, drawing_, layout, pixelsPerLength(layout, bounds));
    if (!moved_ || aimed_at_plan_ != isPlan(state_.stage())) aim();  // else as the user left it
  }
  showSlider();
  scene_->ResetCameraClippingRange();  // where the camera stayed, the scene may be another
  window_->Render();
}

void ViewerWindow::aim() {
  const Projection projection = view::projectionOf(state_.view());
  const ProjectedBounds bounds = boundsOf(drawing_, projection);
  if (bounds.empty()) return;
  const Layout layout = place();
  aimCamera(*scene_, layout, projection, bounds, pixelsPerLength(layout, bounds));
  scene_->ResetCameraClippingRange();
  moved_ = false;
  aimed_at_plan_ = isPlan(state_.stage());
}

// Before each frame: axes and scale are those of the camera, and the window may have another size.
void ViewerWindow::annotate() {
  sheet_->RemoveAllViewProps();
  const Layout layout = place();
  vtkCamera& camera = *scene_->GetActiveCamera();
  const Projection projection = projectionOf(camera);
  const double pixels = pixelsOf(camera, layout);
  liftLines(lines_, drawing_, layout, projection.towards, pixels);
  addAnnotations(*sheet_, layout, drawing_, projection, pixels);
  addControls(*sheet_, layout, state_, status_);
}

void ViewerWindow::showSlider() {
  const std::size_t steps = state_.entry().steps;
  if (steps < 2) {
    slider_widget_->EnabledOff();
    return;
  }
  slider_->SetMinimumValue(0.0);
  slider_->SetMaximumValue(static_cast<double>(steps - 1));
  slider_->SetValue(*state_.step());
  slider_widget_->EnabledOn();
}

void ViewerWindow::moveToSlider() {
  if (state_.setStep(static_cast<int>(std::lround(slider_->GetValue())))) draw();
}

void ViewerWindow::save() {
  int number = 1;
  const auto name = [&] {
    return std::string("view_") + (number < 10 ? "0" : "") + std::to_string(number) + ".png";
  };
  while (reconstruction_.has(name())) ++number;
  try {
    writePng(reconstruction_.file(name()), *window_, 1);
    status_ = "written: " + reconstruction_.file(name());
  } catch (const io::Failure& failure) {
    status_ = failure.what();
  }
  window_->Render();
}

}  // namespace storey::view
