// SPDX-License-Identifier: BSD-3-Clause
// The window of the viewer, driven by the events that a user's keys and mouse make. Starts a
// virtual display for itself where there is none.
#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkOutputWindow.h>

#include <cstdlib>

#include "view/stages.h"
#include "view/viewer_window.h"
#include "view/virtual_display.h"
#include "view_files.h"

namespace storey::view {
namespace {

constexpr PictureSize kSize{800, 600};

// Keeps what VTK has to complain about.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New() { return new Complaints; }
  void DisplayText(const char* text) override { texts += text; }
  std::string texts;
};

class ViewerWindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display and no xvfb-run";
    box_.writeStages();
    box_.writePlans();
    reconstruction_ = std::make_unique<Reconstruction>(box_.path());
    std::vector<ViewerState::Entry> entries;
    for (const StageInfo& info : allStages()) {
      if (info.stage == Stage::Overlay) continue;
      entries.push_back({info.stage, missingFile(*reconstruction_, info.stage),
                         countSteps(*reconstruction_, info.stage)});
    }
    ViewerState state(std::move(entries), Stage::Model, std::nullopt);
    window_ = std::make_unique<ViewerWindow>(*reconstruction_, std::move(state), kSize);
    vtkObject::GlobalWarningDisplayOn();
    vtkOutputWindow::SetInstance(complaints_);
  }

  void TearDown() override {
    window_.reset();
    vtkOutputWindow::SetInstance(nullptr);
    EXPECT_EQ(complaints_->texts, "");
  }

  void key(char code) {
    vtkRenderWindowInteractor& interactor = window_->interactor();
    interactor.SetKeyEventInformation(0, 0, code);
    interactor.InvokeEvent(vtkCommand::KeyPressEvent);
    interactor.InvokeEvent(vtkCommand::CharEvent);
    interactor.InvokeEvent(vtkCommand::KeyReleaseEvent);
  }

  void mouse(double x, double y, unsigned long event) {
    const int* const size = window_->interactor().GetRenderWindow()->GetSize();
    window_->interactor().SetEventInformation(static_cast<int>(x * size[0]),
                                              static_cast<int>(y * size[1]));
    window_->interactor().InvokeEvent(event);
  }

  void drag(double x0, double y0, double x1, double y1) {
    mouse(x0, y0, vtkCommand::MouseMoveEvent);
    mouse(x0, y0, vtkCommand::LeftButtonPressEvent);
    mouse(x1, y1, vtkCommand::MouseMoveEvent);
    mouse(x1, y1, vtkCommand::LeftButtonReleaseEvent);
    mouse(0.1, 0.5, vtkCommand::MouseMoveEvent);  // nothing there to light up
  }

  /// Bytes of a picture that the key for it writes.
  std::string picture() {
    ++num_pictures_;
    key('w');
    return test::readAll(box_.file("view_0" + std::to_string(num_pictures_) + ".png"));
  }

  test::BoxReconstruction box_;
  std::unique_ptr<Reconstruction> reconstruction_;
  std::unique_ptr<ViewerWindow> window_;
  vtkNew<Complaints> complaints_;
  int num_pictures_ = 0;
};

TEST_F(ViewerWindowTest, KeysChangeStageColoursOverlayAndHelpAndWhatIsSeen) {
  std::vector<std::string> pictures = {picture()};
  for (const char code : {'o', 'c', 'n', 'h'}) {
    key(code);
    pictures.push_back(picture());
  }
  for (const std::string& picture : pictures) {
    ASSERT_EQ(picture.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(std::count(pictures.begin(), pictures.end(), picture), 1);
  }
  EXPECT_EQ(window_->state().stage(), Stage::Deviation);
}

TEST_F(ViewerWindowTest, EveryStageIsShownAndThoseWithoutFilesAreSaid) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < window_->state().entries().size(); ++i) {
    key('n');
    missing += window_->state().entry().missing.empty() ? 0 : 1;
  }
  EXPECT_GT(missing, 0u);  // the box has no confidence
  EXPECT_EQ(window_->state().stage(), Stage::Model);
}

TEST_F(ViewerWindowTest, TheSliderMovesTheSlice) {
  while (window_->state().stage() != Stage::Slice) key('9');
  EXPECT_EQ(window_->state().step(), 1);
  const std::string before = picture();
  drag(0.76, 0.07, 0.957, 0.07);  // from the middle of the slider to its end
  EXPECT_EQ(window_->state().step(), 2);
  EXPECT_TRUE(picture() != before);
  drag(0.94, 0.07, 0.563, 0.07);
  EXPECT_EQ(window_->state().step(), 0);
  key('+');
  EXPECT_TRUE(picture() == before);  // the slider stands where the key has put the slice
}

TEST_F(ViewerWindowTest, TheMouseTurnsTheModelAndAKeyTurnsItBack) {
  const std::string before = picture();
  drag(0.4, 0.5, 0.5, 0.6);
  EXPECT_TRUE(picture() != before);
  key('i');
  EXPECT_TRUE(picture() == before);
}

TEST_F(ViewerWindowTest, AKeyClosesIt) {
  key('q');
  window_->run();  // returns
}

}  // namespace
}  // namespace storey::view

int main(int argc, char** argv) {
  storey::view::restartOnVirtualDisplay(argv);  // returns if there is no xvfb-run
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
