// SPDX-License-Identifier: BSD-3-Clause
#include "windows/window_editor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace storey::windows {
namespace {

constexpr double kSlip = 3.0;  // pixels: a hand that clicks moves less

bool shows(const WindowGrid& grid, std::size_t photo) {
  return std::find(grid.photos.begin(), grid.photos.end(), static_cast<int>(photo)) !=
         grid.photos.end();
}

}  // namespace

WindowEditor::WindowEditor(std::vector<EditorPhoto> photos, WindowFinder finder,
                           std::vector<FoundFacade> start)
    : photos_(std::move(photos)), finder_(std::move(finder)), facades_(std::move(start)) {}

WindowEditor::Action WindowEditor::press(char key) {
  status_.clear();
  if (key != 'q') warned_ = false;
  switch (key) {
    case 'n':
      return goTo((photo_ + 1) % photos_.size());
    case 'p':
      return goTo((photo_ + photos_.size() - 1) % photos_.size());
    case 'f':
      if (!facades_.empty()) current_ = (current_ + 1) % facades_.size();
      return Action::Draw;
    case 'a':
      return proposeAll();
    case 'x':
      return removeFacade();
    case 'c':
      corners_.clear();
      typed_.clear();
      return Action::Draw;
    case 'u':
      return undo();
    case 't':
      strip_ = !strip_;
      return Action::Draw;
    case 'h':
      help_ = !help_;
      return Action::Draw;
    case 's':
      return Action::Save;
    case 'q':
      return leave();
    default:
      return type(key);
  }
}

WindowEditor::Action WindowEditor::goTo(std::size_t photo) {
  if (photo >= photos_.size()) return Action::Nothing;
  photo_ = photo;
  corners_.clear();  // they are of the other photo
  return Action::Draw;
}

WindowEditor::Action WindowEditor::leave() {
  if (!dirty_ || warned_) return Action::Close;
  warned_ = true;
  status_ = "not saved: s saves, q again leaves";
  return Action::Draw;
}

// --- depth

WindowEditor::Action WindowEditor::type(char key) {
  constexpr std::size_t kMostTyped = 20;
  const bool part = (key >= '0' && key <= '9') || key == '.' || key == '-';
  if (part && typed_.size() < kMostTyped) {
    typed_ += key;
  } else if (key == '\b' && !typed_.empty()) {
    typed_.pop_back();
  } else if (key == '\r' || key == '\n') {
    return setDepth();
  } else {
    return Action::Nothing;
  }
  return Action::Draw;
}

/// Takes what was typed; nothing typed: what the photos show.
WindowEditor::Action WindowEditor::setDepth() {
  char* end = nullptr;
  const double depth = std::strtod(typed_.c_str(), &end);
  const bool is_number = *end == '\0' && std::isfinite(depth);
  const bool is_empty = typed_.empty();
  typed_.clear();
  if (facades_.empty()) {
    status_ = "mark a window first";
  } else if (!is_number) {
    status_ = "a depth is a number";
  } else {
    remember();
    facades_[current_].edit.depth = is_empty ? std::optional<double>() : depth;
  }
  return Action::Draw;
}

WindowEditor::Action WindowEditor::grabDepth() {
  if (facades_.empty()) return Action::Nothing;
  grabbed_depth_ = facades_[current_].depth();
  depth_moved_ = false;
  return Action::Nothing;
}

WindowEditor::Action WindowEditor::dragDepth(double texels) {
  if (facades_.empty()) return Action::Nothing;
  if (!depth_moved_) remember();
  depth_moved_ = true;
  FoundFacade& facade = facades_[current_];
  facade.edit.depth = grabbed_depth_ + texels * facade.found.texel;
  return Action::Draw;
}

// --- marks

WindowEditor::Action WindowEditor::addCorner(const Eigen::Vector2d& pixel) {
  if (!photos_[photo_].camera.contains(pixel)) return Action::Nothing;
  corners_.push_back(pixel);
  if (corners_.size() < 4) return Action::Draw;
  FoundFacade facade;
  facade.edit.view = photos_[photo_].name;
  std::copy(corners_.begin(), corners_.end(), facade.edit.quad.begin());
  corners_.clear();
  facade.found = finder_.find(facade.edit);
  if (!facade.found.problem.empty()) {
    status_ = facade.found.problem;
    return Action::Draw;
  }
  remember();
  put(std::move(facade));
  return Action::Draw;
}

WindowEditor::Action WindowEditor::proposeAll() {
  std::vector<FoundFacade> added;
  for (FoundFacade& facade : finder_.find_all()) {
    const bool known = std::any_of(
        facades_.begin(), facades_.end(),
        [&facade](const FoundFacade& other) { return other.found.facade == facade.found.facade; });
    if (!known) added.push_back(std::move(facade));
  }
  status_ = std::to_string(added.size()) + " facades proposed";
  if (added.empty()) return Action::Draw;
  remember();
  for (FoundFacade& facade : added) facades_.push_back(std::move(facade));
  current_ = facades_.size() - 1;
  return Action::Draw;
}

/// A mark within a window of an earlier one takes its place; others, around windows of another
/// size, stay beside it.
void WindowEditor::put(FoundFacade facade) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : facade.edit.quad) middle += 0.25 * corner;
  const std::optional<Grabbed> marked = windowAt(middle);
  if (marked && facades_[marked->facade].found.facade == facade.found.facade) {
    current_ = marked->facade;
    facades_[current_] = std::move(facade);
    return;
  }
  current_ = facades_.size();
  facades_.push_back(std::move(facade));
}

WindowEditor::Action WindowEditor::removeFacade() {
  if (facades_.empty()) return Action::Nothing;
  remember();
  facades_.erase(facades_.begin() + static_cast<std::ptrdiff_t>(current_));
  current_ = 0;
  return Action::Draw;
}

// --- undo

void WindowEditor::remember() {
  past_.push_back(facades_);
  dirty_ = true;
}

WindowEditor::Action WindowEditor::undo() {
  if (!corners_.empty()) {
    corners_.pop_back();
    return Action::Draw;
  }
  if (past_.empty()) {
    status_ = "nothing to undo";
    return Action::Draw;
  }
  facades_ = std::move(past_.back());
  past_.pop_back();
  current_ = std::min(current_, facades_.empty() ? 0 : facades_.size() - 1);
  dirty_ = true;
  return Action::Draw;
}

void WindowEditor::saved(const std::string& status) {
  dirty_ = false;
  status_ = status;
}

// --- windows

std::optional<Eigen::Vector2d> WindowEditor::onFacade(const FoundFacade& facade,
                                                      const Eigen::Vector2d& pixel) const {
  const Camera& camera = photos_[photo_].camera;
  const FacadeFrame& frame = facade.found.frame;
  const auto ray = camera.ray(pixel);
  if (!ray) return std::nullopt;
  const double slope = frame.normal().dot(*ray);
  if (!(slope < 0.0)) return std::nullopt;
  const Eigen::Vector3d eye = camera.center();
  const double distance = frame.normal().dot(frame.origin - eye) / slope;
  if (!(distance > 0.0)) return std::nullopt;
  return frame.local(eye + distance * *ray);
}

std::optional<WindowEditor::Grabbed> WindowEditor::windowAt(const Eigen::Vector2d& pixel) const {
  for (std::size_t f = 0; f < facades_.size(); ++f) {
    const FoundFacade& facade = facades_[f];
    if (!shows(facade.found, photo_)) continue;
    const auto place = onFacade(facade, pixel);
    if (!place) continue;
    for (std::size_t w = 0; w < facade.found.windows.size(); ++w) {
      const Eigen::AlignedBox2d rectangle = facade.rectangle(facade.found.windows[w]);
      if (rectangle.contains(*place)) return Grabbed{f, w, *place, pixel, rectangle};
    }
  }
  return std::nullopt;
}

WindowChange& WindowEditor::changeOf(FoundFacade& facade, const FacadeWindow& window) {
  std::vector<WindowChange>& changes = facade.edit.changes;
  const auto found =
      std::find_if(changes.begin(), changes.end(),
                   [&window](const WindowChange& change) { return change.isOf(window); });
  if (found != changes.end()) return *found;
  changes.push_back({window.row, window.column, {}, {}});
  return changes.back();
}

WindowEditor::Action WindowEditor::grab(const Eigen::Vector2d& pixel) {
  status_.clear();
  grabbed_ = corners_.empty() ? windowAt(pixel) : std::nullopt;  // a mark may cross windows
  if (!grabbed_) return addCorner(pixel);
  current_ = grabbed_->facade;
  return Action::Draw;
}

WindowEditor::Action WindowEditor::drag(const Eigen::Vector2d& pixel) {
  if (!grabbed_) return Action::Nothing;
  if (!grabbed_->moved && (pixel - grabbed_->pixel).norm() <= kSlip) return Action::Nothing;
  const auto place = onFacade(facades_[grabbed_->facade], pixel);
  if (!place) return Action::Nothing;
  if (!grabbed_->moved) remember();
  grabbed_->moved = true;
  FoundFacade& facade = facades_[grabbed_->facade];
  Eigen::AlignedBox2d moved = grabbed_->rectangle;
  moved.translate(*place - grabbed_->start);
  changeOf(facade, facade.found.windows[grabbed_->window]).rectangle = moved;
  return Action::Draw;
}

WindowEditor::Action WindowEditor::release() {
  if (!grabbed_) return Action::Nothing;
  if (!grabbed_->moved) {
    remember();
    FoundFacade& facade = facades_[grabbed_->facade];
    const FacadeWindow& window = facade.found.windows[grabbed_->window];
    const bool kept = facade.isKept(window);
    changeOf(facade, window).keep = !kept;
  }
  grabbed_.reset();
  return Action::Draw;
}

WindowEdit WindowEditor::edit() const {
  WindowEdit edit;
  for (const FoundFacade& facade : facades_) edit.facades.push_back(facade.edit);
  return edit;
}

std::vector<std::size_t> WindowEditor::related() const {
  std::vector<std::size_t> photos;
  if (facades_.empty()) {
    photos.resize(photos_.size());
    std::iota(photos.begin(), photos.end(), std::size_t{0});
    return photos;
  }
  for (const int photo : facades_[current_].found.photos) {
    photos.push_back(static_cast<std::size_t>(photo));
  }
  return photos;
}

const std::vector<std::pair<std::string, std::string>>& editorHelp() {
  static const std::vector<std::pair<std::string, std::string>> help = {
      {"n p", "next, previous photo; a click on the strip goes to one"},
      {"click", "four corners around a window find those like it"},
      {"", "on a window: keep it (green), drop it (red)"},
      {"drag", "moves a window"},
      {"a", "propose windows on all facades"},
      {"f", "next facade"},
      {"0.3 Enter", "depth of its panes; Enter alone: as the photos show"},
      {"right drag", "the same by hand"},
      {"wheel", "larger, smaller; middle drag moves the photo"},
      {"x", "remove the facade's windows"},
      {"c", "clear corners and what was typed"},
      {"u", "undo"},
      {"t", "strip of photos on, off"},
      {"s", "save"},
      {"q", "close"},
      {"h", "this help"}};
  return help;
}

}  // namespace storey::windows
