// SPDX-License-Identifier: BSD-3-Clause
#include "view/viewer_state.h"

#include <algorithm>

namespace storey::view {
namespace {

// The digit of the key for a stage.
int digitOf(Stage stage) {
  const int number = infoOf(stage).number;
  return number <= 9 ? number : 0;
}

}  // namespace

ViewerState::ViewerState(std::vector<Entry> entries, Stage start, std::optional<int> step)
    : entries_(std::move(entries)), overlay_(start == Stage::Overlay) {
  const Stage wanted = overlay_ ? Stage::Model : start;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].stage == wanted) current_ = i;
    if (entries_[i].steps > 0) stepOf(entries_[i]) = static_cast<int>(entries_[i].steps / 2);
  }
  if (step) setStep(*step);
}

ViewerState::Action ViewerState::press(char key) {
  if (key >= '0' && key <= '9') return goToNumber(key - '0');
  switch (key) {
    case 'n':
      return goTo((current_ + 1) % entries_.size());
    case 'p':
      return goTo((current_ + entries_.size() - 1) % entries_.size());
    case '+':
    case '-':
      return step() && setStep(*step() + (key == '+' ? 1 : -1)) ? Action::Draw : Action::Nothing;
    case 'c':
      return nextColours();
    case 'o':
      overlay_ = !overlay_;
      return canOverlay(stage()) ? Action::Draw : Action::Nothing;
    case 'i':
      return look(View::Free);
    case 't':
      return look(View::Top);
    case 'f':
      return look(View::Front);
    case 'h':
      help_ = !help_;
      return Action::Annotate;
    case 'w':
      return Action::Save;
    case 'q':
      return Action::Close;
    default:
      return Action::Nothing;
  }
}

bool ViewerState::setStep(int step) {
  if (entry().steps == 0) return false;
  const int last = static_cast<int>(entry().steps) - 1;
  int& current = stepOf(entry());
  const int before = current;
  current = std::clamp(step, 0, last);
  return current != before;
}

std::optional<int> ViewerState::step() const {
  if (entry().steps == 0) return std::nullopt;
  return stage() == Stage::Cells ? block_ : slice_;
}

ViewerState::Action ViewerState::goTo(std::size_t entry) {
  if (entry == current_) return Action::Nothing;
  current_ = entry;
  return Action::Draw;
}

ViewerState::Action ViewerState::goToNumber(int digit) {
  for (std::size_t ahead = 1; ahead <= entries_.size(); ++ahead) {
    const std::size_t i = (current_ + ahead) % entries_.size();
    if (digitOf(entries_[i].stage) == digit) return goTo(i);
  }
  return Action::Nothing;
}

// From any stage on to the model, then through its colours.
ViewerState::Action ViewerState::nextColours() {
  const Stage next = stage() == Stage::Model     ? Stage::Support
                     : stage() == Stage::Support ? Stage::Deviation
                                                 : Stage::Model;
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.stage == next; });
  if (found == entries_.end()) return Action::Nothing;
  return goTo(static_cast<std::size_t>(found - entries_.begin()));
}

ViewerState::Action ViewerState::look(View view) {
  view_ = view;
  return Action::Aim;
}

const std::vector<std::pair<std::string, std::string>>& keyHelp() {
  static const std::vector<std::pair<std::string, std::string>> help = {
      {"n  p", "next, previous stage"},
      {"0 - 9", "stages of this number, in turn"},
      {"+  -", "next, previous slice or block"},
      {"c", "model by kind, support, deviation"},
      {"o", "cloud over walls, plans and model"},
      {"i  t  f", "isometric, from the top, from the front"},
      {"w", "write a picture into the directory"},
      {"h", "this help"},
      {"q", "quit"},
      {"mouse", "left turns, middle moves, wheel zooms"}};
  return help;
}

}  // namespace storey::view
