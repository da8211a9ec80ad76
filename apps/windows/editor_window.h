// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/image_pyramid.h>
#include <storey/surface/facade_texturing.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <functional>
#include <string>
#include <vector>

#include "view/display.h"
#include "view/layout.h"
#include "view/options.h"
#include "windows/editor_overlay.h"

namespace storey::windows {

/// A window around a `WindowEditor`: a photo with what is edited drawn over it, and a strip of the
/// photos that show the same facade.
class EditorWindow {
 public:
  /// Writes what there is to disk and says so. What it throws is said in the window.
  using Save = std::function<std::string(const WindowEdit&)>;

  /// Shows the window. \throws io::Failure (Temporary) if there is no display for it
  EditorWindow(WindowEditor editor, const std::vector<FacadePhoto>& photos, Save save,
               const view::PictureSize& size);
  EditorWindow(const EditorWindow&) = delete;
  EditorWindow& operator=(const EditorWindow&) = delete;

  /// Answers to the user until the window is closed.
  void run();

  // What keys and mouse go through.
  void press(char key);
  void grab();
  void drag();
  void release();
  void grabDepth();
  void grabPhoto();
  void zoom(double factor);

  const WindowEditor& editor() const { return editor_; }
  const PhotoView& photoView() const { return view_; }
  vtkRenderWindowInteractor& interactor() { return *interactor_; }
  vtkRenderWindow& window() { return *window_; }

 private:
  enum class Drag { Nothing, Window, Depth, Photo };
  struct Thumbnail {
    std::size_t photo;
    PhotoView view;
  };

  void prepare(const view::PictureSize& size);
  void act(WindowEditor::Action action);
  void place();
  void placeStrip();
  void draw();
  void addImage(std::size_t photo, const PhotoView& view);
  void addOverlay(std::size_t photo, const PhotoView& view, double width);
  void addWriting();
  void addHelp();
  Eigen::Vector2d mouse() const;
  void close() { closed_ = true; }

  WindowEditor editor_;
  Save save_;
  std::vector<detail::ImagePyramid> images_;
  view::DisplayConnection display_;
  view::Layout layout_;
  PhotoView view_;
  std::vector<Thumbnail> strip_;
  std::size_t placed_photo_ = 0;
  Drag drag_ = Drag::Nothing;
  Eigen::Vector2d drag_start_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d corner_start_ = Eigen::Vector2d::Zero();
  bool closed_ = false;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
};

}  // namespace storey::windows
