// SPDX-License-Identifier: BSD-3-Clause
// What keys make of the viewer, without a window.
#include <gtest/gtest.h>

#include <set>

#include "view/viewer_state.h"

namespace storey::view {
namespace {

using Action = ViewerState::Action;

ViewerState allThere(Stage start, std::optional<int> step = std::nullopt) {
  std::vector<ViewerState::Entry> entries;
  for (const StageInfo& info : allStages()) {
    if (info.stage == Stage::Overlay) continue;
    const std::size_t steps = info.stage == Stage::Cells ? 3 : isPlan(info.stage) ? 10 : 0;
    entries.push_back({info.stage, "", steps});
  }
  return ViewerState(std::move(entries), start, step);
}

TEST(StageList, IsInTheOrderOfItsEnumerationAndNamesDiffer) {
  std::set<std::string> names;
  for (const StageInfo& info : allStages()) {
    EXPECT_EQ(&infoOf(info.stage), &info);
    EXPECT_FALSE(info.files.empty());
    names.insert(info.name);
  }
  EXPECT_EQ(names.size(), allStages().size());
}

TEST(ViewerState, NextGoesThroughAllStagesAndPreviousBack) {
  ViewerState state = allThere(Stage::Upright);
  std::vector<Stage> seen;
  for (std::size_t i = 0; i < state.entries().size(); ++i) {
    seen.push_back(state.stage());
    EXPECT_EQ(state.press('n'), Action::Draw);
  }
  EXPECT_EQ(std::set<Stage>(seen.begin(), seen.end()).size(), state.entries().size());
  EXPECT_EQ(state.stage(), Stage::Upright);  // once round
  for (auto stage = seen.rbegin(); stage != seen.rend(); ++stage) {
    state.press('p');
    EXPECT_EQ(state.stage(), *stage);
  }
}

TEST(ViewerState, DigitsReachEveryStageThroughThoseOfItsNumber) {
  const ViewerState all = allThere(Stage::Upright);
  for (const ViewerState::Entry& entry : all.entries()) {
    ViewerState state = allThere(Stage::Upright);
    const int number = infoOf(entry.stage).number;
    const char key = static_cast<char>('0' + (number > 9 ? 0 : number));
    std::size_t presses = 0;
    while (state.stage() != entry.stage && presses < state.entries().size()) {
      state.press(key);
      EXPECT_EQ(infoOf(state.stage()).number > 9, number > 9);
      ++presses;
    }
    EXPECT_EQ(state.stage(), entry.stage) << infoOf(entry.stage).name;
  }
}

TEST(ViewerState, SlicesAreSharedByTheirStagesAndStayInRange) {
  ViewerState state = allThere(Stage::Slice, 8);
  EXPECT_EQ(state.press('+'), Action::Draw);
  EXPECT_EQ(state.step(), 9);
  EXPECT_EQ(state.press('+'), Action::Nothing);
  state.press('n');
  ASSERT_EQ(state.stage(), Stage::Segments);
  EXPECT_EQ(state.step(), 9);
  EXPECT_FALSE(state.setStep(100));
  EXPECT_TRUE(state.setStep(-5));
  EXPECT_EQ(state.step(), 0);
  EXPECT_EQ(state.press('-'), Action::Nothing);
  ViewerState cells = allThere(Stage::Cells);
  EXPECT_EQ(cells.step(), 1);  // the middle one of three
  ViewerState model = allThere(Stage::Model);
  EXPECT_EQ(model.step(), std::nullopt);
  EXPECT_EQ(model.press('+'), Action::Nothing);
}

TEST(ViewerState, ColoursOfTheModelGoInTurn) {
  ViewerState state = allThere(Stage::Confidence);
  for (const Stage stage : {Stage::Model, Stage::Support, Stage::Deviation, Stage::Model}) {
    EXPECT_EQ(state.press('c'), Action::Draw);
    EXPECT_EQ(state.stage(), stage);
  }
}

TEST(ViewerState, TheCloudIsLaidOverWhatItCanBe) {
  ViewerState state = allThere(Stage::Overlay);
  EXPECT_EQ(state.stage(), Stage::Model);
  EXPECT_TRUE(state.overlay());
  EXPECT_EQ(state.press('o'), Action::Draw);
  EXPECT_FALSE(state.overlay());
  state.press('2');
  EXPECT_EQ(state.press('o'), Action::Nothing);  // a cloud already
}

TEST(ViewerState, PlansAreSeenFromAboveWhateverTheView) {
  ViewerState state = allThere(Stage::Model);
  EXPECT_EQ(state.press('f'), Action::Aim);
  EXPECT_EQ(state.view(), View::Front);
  state.press('9');
  ASSERT_TRUE(isPlan(state.stage()));
  EXPECT_EQ(state.view(), View::Top);
}

TEST(ViewerState, OtherKeysDoNothing) {
  ViewerState state = allThere(Stage::Model);
  for (const char key : {'x', ' ', '\0', 'N', 'e'}) {
    EXPECT_EQ(state.press(key), Action::Nothing) << key;
  }
  EXPECT_EQ(state.press('h'), Action::Annotate);
  EXPECT_TRUE(state.help());
  EXPECT_EQ(state.press('w'), Action::Save);
  EXPECT_EQ(state.press('q'), Action::Close);
}

}  // namespace
}  // namespace storey::view
