// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/camera.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "windows/found_facade.h"

namespace storey::windows {

/// A photo as the editor sees it.
struct EditorPhoto {
  std::string name;  ///< as `FacadeEdit::view` has it
  Camera camera;     ///< in the frame of the grids
};

/// What finds windows. Only the grid without changes is asked for.
struct WindowFinder {
  std::function<WindowGrid(const FacadeEdit&)> find;
  std::function<std::vector<FoundFacade>()> find_all;
};

/// What a user edits, and what keys and mouse make of it. Knows nothing of windows on a screen;
/// the mouse is in pixels of the photo shown.
class WindowEditor {
 public:
  enum class Action { Nothing, Draw, Save, Close };

  /// \param photos one or more
  /// \param start  what is there to begin with
  WindowEditor(std::vector<EditorPhoto> photos, WindowFinder finder,
               std::vector<FoundFacade> start = {});

  /// n, p: photo; f: facade; a: propose all; x: remove the facade; c: clear corners; u: undo;
  /// digits, point, minus, backspace, enter: depth; t: strip; h: help; s: save; q: close.
  Action press(char key);

  /// The left button. A click beside all windows is a corner of a mark, the fourth finds the
  /// windows; a click on a window keeps it or drops it; a drag moves it.
  Action grab(const Eigen::Vector2d& pixel);
  Action drag(const Eigen::Vector2d& pixel);
  Action release();

  /// Changes the facade's depth by so many texels of its image, from where `grabDepth` was called.
  Action grabDepth();
  Action dragDepth(double texels);

  Action goTo(std::size_t photo);

  /// Says that what there is now is on disk.
  void saved(const std::string& status);
  void say(const std::string& status) { status_ = status; }

  WindowEdit edit() const;
  const std::vector<EditorPhoto>& photos() const { return photos_; }
  const std::vector<FoundFacade>& facades() const { return facades_; }
  std::size_t photo() const { return photo_; }
  /// The facade that keys are about; none if there is none.
  const FoundFacade* facade() const { return facades_.empty() ? nullptr : &facades_[current_]; }
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  /// Photos that show the current facade, all if there is none.
  std::vector<std::size_t> related() const;
  const std::string& typed() const { return typed_; }
  const std::string& status() const { return status_; }
  bool strip() const { return strip_; }
  bool help() const { return help_; }

 private:
  struct Grabbed {
    std::size_t facade, window;
    Eigen::Vector2d start;  // in the facade's frame
    Eigen::Vector2d pixel;
    Eigen::AlignedBox2d rectangle;
    bool moved = false;
  };

  std::optional<Grabbed> windowAt(const Eigen::Vector2d& pixel) const;
  std::optional<Eigen::Vector2d> onFacade(const FoundFacade& facade,
                                          const Eigen::Vector2d& pixel) const;
  Action addCorner(const Eigen::Vector2d& pixel);
  Action proposeAll();
  Action removeFacade();
  Action undo();
  Action type(char key);
  Action setDepth();
  Action leave();
  void put(FoundFacade facade);
  void remember();
  WindowChange& changeOf(FoundFacade& facade, const FacadeWindow& window);

  std::vector<EditorPhoto> photos_;
  WindowFinder finder_;
  std::vector<FoundFacade> facades_;
  std::vector<std::vector<FoundFacade>> past_;  // for undo
  std::vector<Eigen::Vector2d> corners_;
  std::optional<Grabbed> grabbed_;
  double grabbed_depth_ = 0.0;
  bool depth_moved_ = false;
  std::size_t photo_ = 0;
  std::size_t current_ = 0;
  std::string typed_;
  std::string status_;
  bool strip_ = true;
  bool help_ = false;
  bool dirty_ = false;
  bool warned_ = false;
};

/// What each key and button does, for the help.
const std::vector<std::pair<std::string, std::string>>& editorHelp();

}  // namespace storey::windows
