// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/drawing.h"
#include "view/stage_list.h"

namespace storey::view {

/// What a window shows, and what keys make of that. Knows nothing of windows.
class ViewerState {
 public:
  /// A stage that can be gone to.
  struct Entry {
    Stage stage = Stage::Model;
    std::string missing;    ///< the file that it cannot be drawn without; empty: all are there
    std::size_t steps = 0;  ///< slices or blocks that it shows one by one, or 0
  };

  /// What has to be done after a key.
  enum class Action {
    Nothing,
    Draw,      ///< another drawing
    Aim,       ///< the same drawing from `view()`
    Annotate,  ///< other writing around it
    Save,      ///< a picture of what is shown
    Close
  };

  /// \param entries one or more, in the order of the method
  /// \param start   the one to begin with; `Stage::Overlay` is the model with the cloud over it
  /// \param step    slice or block to begin with; none: the middle one
  ViewerState(std::vector<Entry> entries, Stage start, std::optional<int> step);

  /// n, p: next and previous stage; digits: the stages of a step of the method in turn, 0 those
  /// beyond nine; + and -: slice or block; c: colours of the model; o: cloud over it;
  /// i, t, f: view; w, h, q: save, help, close. Others do nothing.
  Action press(char key);

  /// Goes to a slice or block. \return whether it is another one
  bool setStep(int step);

  const std::vector<Entry>& entries() const { return entries_; }
  const Entry& entry() const { return entries_[current_]; }
  Stage stage() const { return entry().stage; }
  /// Slice or block; none for stages that show all at once.
  std::optional<int> step() const;
  bool overlay() const { return overlay_; }
  bool help() const { return help_; }
  View view() const { return isPlan(stage()) ? View::Top : view_; }

 private:
  Action goTo(std::size_t entry);
  Action goToNumber(int digit);
  Action nextColours();
  Action look(View view);
  int& stepOf(const Entry& entry) { return entry.stage == Stage::Cells ? block_ : slice_; }

  std::vector<Entry> entries_;
  std::size_t current_ = 0;
  int slice_ = 0;
  int block_ = 0;
  bool overlay_ = false;
  bool help_ = false;
  View view_ = View::Free;
};

/// What each key does, for the help: key and text.
const std::vector<std::pair<std::string, std::string>>& keyHelp();

}  // namespace storey::view
