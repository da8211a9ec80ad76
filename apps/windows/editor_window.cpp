// SPDX-License-Identifier: BSD-3-Clause
#include "windows/editor_window.h"

#include <vtkActor2D.h>
#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkInteractorStyle.h>
#include <vtkObjectFactory.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "io/failure.h"
#include "view/palette.h"
#include "view/render.h"
#include "view/sheet.h"

namespace storey::windows {
namespace {

// Sizes in a window of 1600 x 1200.
constexpr double kFoot = 40.0;
constexpr double kHead = 44.0;
constexpr double kStrip = 170.0;
constexpr double kGap = 8.0;

class EditorStyle : public vtkInteractorStyle {
 public:
  static EditorStyle* New() { VTK_STANDARD_NEW_BODY(EditorStyle); }
  void OnChar() override { window->press(Interactor->GetKeyCode()); }
  void OnLeftButtonDown() override { window->grab(); }
  void OnLeftButtonUp() override { window->release(); }
  void OnRightButtonDown() override { window->grabDepth(); }
  void OnRightButtonUp() override { window->release(); }
  void OnMiddleButtonDown() override { window->grabPhoto(); }
  void OnMiddleButtonUp() override { window->release(); }
  void OnMouseMove() override { window->drag(); }
  void OnMouseWheelForward() override { window->zoom(kStep); }
  void OnMouseWheelBackward() override { window->zoom(1.0 / kStep); }

  EditorWindow* window = nullptr;

 private:
  static constexpr double kStep = 1.25;
};

view::Colour colourOf(const OverlayLines& lines) {
  switch (lines.mark) {
    case Mark::Kept:
      return lines.current ? view::Colour{60, 235, 90} : view::Colour{40, 160, 70};
    case Mark::Doubtful:
      return {255, 175, 30};
    case Mark::Dropped:
      return {240, 60, 60};
    case Mark::Pane:
      return {90, 190, 255};
    default:
      return {255, 60, 220};
  }
}

/// What of a photo fills a rectangle; dark where there is none.
vtkNew<vtkImageData> imageOf(const detail::ImagePyramid& photo, const Camera& camera,
                             const PhotoView& view) {
  constexpr unsigned char kBackground = 30;
  const int width = std::max(1, static_cast<int>(view.high.x() - view.low.x()));
  const int height = std::max(1, static_cast<int>(view.high.y() - view.low.y()));
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < height; ++y) {
    auto* out = static_cast<unsigned char*>(image->GetScalarPointer(0, y, 0));
    for (int x = 0; x < width; ++x, out += 3) {
      const Eigen::Vector2d pixel = view.toPhoto(view.low + Eigen::Vector2d(x + 0.5, y + 0.5));
      std::fill_n(out, 3, kBackground);
      if (!camera.contains(pixel)) continue;
      const Eigen::Array3f color = photo.sample(pixel, 1.0 / view.scale);
      for (int c = 0; c < 3; ++c) out[c] = static_cast<unsigned char>(std::lround(color[c]));
    }
  }
  return image;
}

}  // namespace

EditorWindow::EditorWindow(WindowEditor editor, const std::vector<FacadePhoto>& photos, Save save,
                           const view::PictureSize& size)
    : editor_(std::move(editor)), save_(std::move(save)) {
  for (const FacadePhoto& photo : photos) images_.emplace_back(photo.image);
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by a Failure, in one line
  view::requireOpenGl(display_, "run it where there is a screen, or use --quad or --auto");
  prepare(size);
  place();
  draw();
}

void EditorWindow::prepare(const view::PictureSize& size) {
  constexpr double kMostOfScreen = 0.9;
  window_->SetDPI(72);  // a font size is its pixels
  window_->SetMultiSamples(0);
  window_->SetWindowName("storey_windows");
  const int* const screen = window_->GetScreenSize();
  window_->SetSize(std::min(size.width, static_cast<int>(kMostOfScreen * screen[0])),
                   std::min(size.height, static_cast<int>(kMostOfScreen * screen[1])));
  renderer_->SetBackground(0.12, 0.12, 0.13);
  window_->AddRenderer(renderer_);
  interactor_->SetRenderWindow(window_);
  vtkNew<EditorStyle> style;
  style->window = this;
  interactor_->SetInteractorStyle(style);
  interactor_->AddObserver(vtkCommand::ExitEvent, this, &EditorWindow::close);
  interactor_->Initialize();
}

// A loop of our own: VTK 9.1 asks its display for events once more after the end of its own loop.
void EditorWindow::run() {
  constexpr std::chrono::milliseconds kPause(10);
  while (!closed_) {
    interactor_->ProcessEvents();
    const int* const size = window_->GetSize();
    if (size[0] != layout_.width || size[1] != layout_.height) {
      place();
      draw();
    }
    std::this_thread::sleep_for(kPause);
  }
}

void EditorWindow::act(WindowEditor::Action action) {
  switch (action) {
    case WindowEditor::Action::Close:
      close();
      return;
    case WindowEditor::Action::Save:
      try {
        editor_.saved(save_(editor_.edit()));
      } catch (const std::exception& error) {
        editor_.say(error.what());
      }
      break;
    case WindowEditor::Action::Nothing:
      return;
    case WindowEditor::Action::Draw:
      break;
  }
  if (placed_photo_ != editor_.photo()) place();
  draw();
}

void EditorWindow::press(char key) {
  act(editor_.press(key));
  if (key == 't') {
    place();
    draw();
  }
}

Eigen::Vector2d EditorWindow::mouse() const {
  const int* const at = interactor_->GetEventPosition();
  return {at[0] + 0.5, at[1] + 0.5};
}

void EditorWindow::grab() {
  const Eigen::Vector2d at = mouse();
  for (const Thumbnail& thumbnail : strip_) {
    if (thumbnail.view.contains(at)) return act(editor_.goTo(thumbnail.photo));
  }
  if (!view_.contains(at)) return;
  drag_ = Drag::Window;
  act(editor_.grab(view_.toPhoto(at)));
}

void EditorWindow::grabDepth() {
  drag_ = Drag::Depth;
  drag_start_ = mouse();
  act(editor_.grabDepth());
}

void EditorWindow::grabPhoto() {
  drag_ = Drag::Photo;
  drag_start_ = mouse();
  corner_start_ = view_.corner;
}

void EditorWindow::drag() {
  constexpr double kTexels = 0.1;  // a pixel of the mouse
  const Eigen::Vector2d at = mouse();
  if (drag_ == Drag::Window) act(editor_.drag(view_.toPhoto(at)));
  if (drag_ == Drag::Depth) act(editor_.dragDepth(kTexels * (at.x() - drag_start_.x())));
  if (drag_ != Drag::Photo) return;
  const Eigen::Vector2d by = (at - drag_start_) / view_.scale;
  view_.corner = corner_start_ + Eigen::Vector2d(-by.x(), by.y());
  draw();
}

void EditorWindow::release() {
  if (drag_ == Drag::Window) act(editor_.release());
  drag_ = Drag::Nothing;
}

void EditorWindow::zoom(double factor) {
  const Eigen::Vector2d at = mouse();
  if (!view_.contains(at)) return;
  view_.zoom(factor, at);
  draw();
}

/// Gives the photo the whole of its rectangle.
void EditorWindow::place() {
  const int* const size = window_->GetSize();
  layout_ = view::layoutOf(size[0], size[1]);
  const double u = layout_.unit;
  const double foot = (kFoot + (editor_.strip() ? kStrip : 0.0)) * u;
  view_ = PhotoView::whole(editor_.photos()[editor_.photo()].camera, {0.0, std::ceil(foot)},
                           {layout_.width, std::floor(layout_.height - kHead * u)});
  placed_photo_ = editor_.photo();
}

void EditorWindow::addImage(std::size_t photo, const PhotoView& view) {
  vtkNew<vtkImageMapper> mapper;
  mapper->SetInputData(imageOf(images_[photo], editor_.photos()[photo].camera, view));
  mapper->SetColorWindow(255.0);
  mapper->SetColorLevel(127.5);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(view.low.x(), view.low.y());
  renderer_->AddActor2D(actor);
}

void EditorWindow::addOverlay(std::size_t photo, const PhotoView& view, double width) {
  view::Sheet sheet(*renderer_, layout_);
  for (const OverlayLines& lines : overlayOf(editor_, photo, view)) {
    const double thin = lines.mark == Mark::Pane || !lines.current ? 0.6 : 1.0;
    sheet.segments(lines.segments, colourOf(lines), thin * width);
  }
}

/// As many of the photos that show the facade as there is room for, the one shown among them.
void EditorWindow::placeStrip() {
  strip_.clear();
  if (!editor_.strip()) return;
  const std::vector<std::size_t> photos = editor_.related();
  const double gap = kGap * layout_.unit;
  const double low = kFoot * layout_.unit + gap;
  const double height = kStrip * layout_.unit - 2.0 * gap;
  const auto here = std::find(photos.begin(), photos.end(), editor_.photo());
  const Camera& first = editor_.photos()[photos.front()].camera;
  const double usual = gap + height * first.width / first.height;
  const auto half = static_cast<std::ptrdiff_t>(0.5 * layout_.width / usual);
  const std::ptrdiff_t index = here == photos.end() ? 0 : here - photos.begin();
  double left = gap;
  for (auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, index - half));
       i < photos.size(); ++i) {
    const Camera& camera = editor_.photos()[photos[i]].camera;
    const double width = std::floor(height * camera.width / camera.height);
    if (left + width > layout_.width) break;
    strip_.push_back(
        {photos[i], PhotoView::whole(camera, {left, low}, {left + width, low + height})});
    left += width + gap;
  }
}

void EditorWindow::draw() {
  renderer_->RemoveAllViewProps();
  addImage(editor_.photo(), view_);
  addOverlay(editor_.photo(), view_, 2.5);
  placeStrip();
  for (const Thumbnail& thumbnail : strip_) {
    addImage(thumbnail.photo, thumbnail.view);
    addOverlay(thumbnail.photo, thumbnail.view, 1.2);
  }
  addWriting();
  if (editor_.help()) addHelp();
  window_->Render();
}

void EditorWindow::addWriting() {
  constexpr view::Colour kLight{235, 235, 235};
  constexpr const char* kKeys =
      "n p: photo   click: corner, keep, drop   drag: move   a: propose all   f: facade   "
      "0.3 Enter: depth   u: undo   s: save   q: close   h: help";
  view::Sheet sheet(*renderer_, layout_);
  const double u = layout_.unit;
  const double room = layout_.width - 2.0 * view::kMargin * u;
  char title[200];
  const FoundFacade* const facade = editor_.facade();
  int length = std::snprintf(title, sizeof title, "%.60s (%zu of %zu)",
                             editor_.photos()[editor_.photo()].name.c_str(), editor_.photo() + 1,
                             editor_.photos().size());
  if (facade != nullptr) {
    const char* const from = facade->edit.depth          ? "given"
                             : facade->found.depth_known ? "from the photos"
                                                         : "not known";
    std::snprintf(title + length, sizeof title - static_cast<std::size_t>(length),
                  "      facade %zu: %zu windows, depth %.4g (%s)", facade->found.facade,
                  facade->found.windows.size(), facade->depth(), from);
  }
  std::string text = title;
  if (!editor_.typed().empty()) text += "      new depth: " + editor_.typed() + "_";
  sheet.text(text, {view::kMargin * u, layout_.height - 0.5 * kHead * u}, view::kFont, room,
             kLight);
  const bool says = !editor_.status().empty();
  sheet.text(says ? editor_.status() : kKeys, {view::kMargin * u, 0.5 * kFoot * u}, view::kFont,
             room, says ? view::Colour{255, 220, 90} : kLight);
}

void EditorWindow::addHelp() {
  constexpr double kWidth = 800.0;
  constexpr double kColumn = 170.0;
  view::Sheet sheet(*renderer_, layout_);
  const double u = layout_.unit;
  const double top = layout_.height - (kHead + view::kMargin) * u;
  const double line = view::kLine * u;
  const double bottom = top - (static_cast<double>(editorHelp().size()) + 1.0) * line;
  const double left = view::kMargin * u;
  sheet.rectangle({left, bottom}, {left + kWidth * u, top}, {252, 252, 245});
  double y = top - line;
  for (const auto& [key, text] : editorHelp()) {
    sheet.text(key, {left + 20.0 * u, y}, view::kFont, kColumn * u, view::kDark);
    sheet.text(text, {left + (20.0 + kColumn) * u, y}, view::kFont, (kWidth - kColumn - 40.0) * u,
               view::kDark);
    y -= line;
  }
}

}  // namespace storey::windows
