// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

#include <string>
#include <vector>

#include "view/display.h"
#include "view/layout.h"
#include "view/options.h"
#include "view/reconstruction.h"
#include "view/viewer_state.h"

namespace storey::view {

/// A window to look at the stages of a reconstruction: draws what a `ViewerState` says, and tells
/// it of keys and of the slider. What cannot be drawn is said in the window.
class ViewerWindow {
 public:
  /// Shows the window. \throws io::Failure (Temporary) if there is no display for it
  ViewerWindow(const Reconstruction& reconstruction, ViewerState state, const PictureSize& size);
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  /// Answers to the user until the window is closed.
  void run();

  /// What keys go through.
  void press(char key);

  const ViewerState& state() const { return state_; }
  vtkRenderWindowInteractor& interactor() { return *interactor_; }

 private:
  void prepare(const PictureSize& size);
  void prepareSlider();
  Layout place() const;
  Drawing makeCurrentDrawing() const;
  void draw();
  void aim();
  void annotate();
  void showSlider();
  void moveToSlider();
  void save();
  void close() { closed_ = true; }
  void noteMove() { moved_ = true; }

  const Reconstruction& reconstruction_;
  ViewerState state_;
  DisplayConnection display_;
  std::string status_;  // said in place of the keys until the next one
  Drawing drawing_;
  std::vector<vtkActor*> lines_;  // of the scene
  bool moved_ = false;            // the camera, by the user: then it stays as it is
  bool aimed_at_plan_ = false;
  bool closed_ = false;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> scene_;
  vtkNew<vtkRenderer> sheet_;     // writing, made anew for each frame
  vtkNew<vtkRenderer> controls_;  // the slider
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkSliderRepresentation2D> slider_;
  vtkNew<vtkSliderWidget> slider_widget_;
};

}  // namespace storey::view
