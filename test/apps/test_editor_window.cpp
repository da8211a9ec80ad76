// SPDX-License-Identifier: BSD-3-Clause
// The window of the editor, driven by the events that a user's keys and mouse make. Starts a
// virtual display for itself where there is none.
#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkObject.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "editor_fixture.h"
#include "temporary_files.h"
#include "view/png.h"
#include "view/virtual_display.h"
#include "windows/editor_window.h"

namespace storey::windows {
namespace {

using test::EditedWall;

class EditorWindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display and no xvfb-run";
    std::vector<FacadePhoto> photos;
    for (const EditorPhoto& photo : EditedWall::photos()) {
      RgbImage image(EditedWall::kWidth, EditedWall::kHeight);
      for (std::size_t i = 0; i < image.channels.size(); ++i) {
        image.channels[i] = static_cast<std::uint8_t>(60 + i / 3 % 64);
      }
      photos.push_back({photo.camera, std::move(image)});
    }
    const auto save = [this](const WindowEdit& edit) -> std::string {
      if (full_) throw std::runtime_error("the disk is full");
      saved_ = edit;
      ++num_saved_;
      return "written";
    };
    window_ =
        std::make_unique<EditorWindow>(WindowEditor(EditedWall::photos(), EditedWall::finder()),
                                       photos, save, view::PictureSize{900, 700});
  }

  void key(char code) {
    window_->interactor().SetKeyEventInformation(0, 0, code);
    window_->interactor().InvokeEvent(vtkCommand::KeyPressEvent);
    window_->interactor().InvokeEvent(vtkCommand::CharEvent);
    window_->interactor().InvokeEvent(vtkCommand::KeyReleaseEvent);
  }

  void mouse(const Eigen::Vector2d& at, unsigned long event) {
    window_->interactor().SetEventInformation(static_cast<int>(std::floor(at.x())),
                                              static_cast<int>(std::floor(at.y())));
    window_->interactor().InvokeEvent(event);
  }

  /// Where the window shows a place of the wall in the photo.
  Eigen::Vector2d at(double x, double y) const {
    return window_->photoView().toWindow(EditedWall::pixel(x, y));
  }

  void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
            unsigned long press = vtkCommand::LeftButtonPressEvent,
            unsigned long release = vtkCommand::LeftButtonReleaseEvent) {
    mouse(from, press);
    if (to != from) mouse(to, vtkCommand::MouseMoveEvent);
    mouse(to, release);
  }

  void click(double x, double y) { drag(at(x, y), at(x, y)); }

  void mark() {
    click(0.9, 0.9);
    click(2.1, 0.9);
    click(2.1, 2.1);
    click(0.9, 2.1);
  }

  std::string picture() {
    const std::string path = directory_.file("window.png");
    view::writePng(path, window_->window(), 1);
    return test::readAll(path);
  }

  const WindowEditor& editor() const { return window_->editor(); }

  test::TemporaryDirectory directory_;
  std::unique_ptr<EditorWindow> window_;
  WindowEdit saved_;
  int num_saved_ = 0;
  bool full_ = false;
};

TEST_F(EditorWindowTest, ClicksMarkAndTheWindowsAreDrawn) {
  const std::string before = picture();
  mark();
  ASSERT_EQ(editor().facades().size(), 1u);
  EXPECT_LT((editor().facades()[0].edit.quad[0] - EditedWall::pixel(0.9, 0.9)).norm(),
            1.5 / window_->photoView().scale);  // a pixel of the window
  const std::string found = picture();
  EXPECT_TRUE(found != before);
  click(1.5, 1.5);
  EXPECT_TRUE(picture() != found);
  key('u');
  EXPECT_TRUE(picture() == found);
}

TEST_F(EditorWindowTest, DragsMoveAWindowItsDepthAndThePhoto) {
  mark();
  drag(at(3.5, 1.5), at(3.8, 1.4));
  const FoundFacade& facade = editor().facades()[0];
  const double pixel = 1.5 / (80.0 * window_->photoView().scale);
  EXPECT_LT((facade.rectangle(facade.found.windows[1]).min() - Eigen::Vector2d(3.3, 0.9)).norm(),
            2.0 * pixel);
  drag({300.0, 400.0}, {400.0, 400.0}, vtkCommand::RightButtonPressEvent,
       vtkCommand::RightButtonReleaseEvent);
  EXPECT_GT(editor().facades()[0].depth(), 0.25);
  const Eigen::Vector2d corner = window_->photoView().corner;
  drag({300.0, 400.0}, {350.0, 430.0}, vtkCommand::MiddleButtonPressEvent,
       vtkCommand::MiddleButtonReleaseEvent);
  EXPECT_GT(corner.x(), window_->photoView().corner.x());
  const Eigen::Vector2d under = window_->photoView().toPhoto({300.5, 400.5});
  mouse({300.0, 400.0}, vtkCommand::MouseWheelForwardEvent);
  EXPECT_LT((window_->photoView().toPhoto({300.5, 400.5}) - under).norm(), 1e-6);
}

TEST_F(EditorWindowTest, TheStripGoesToAPhoto) {
  mark();
  // The second of two thumbnails, whose widths are four thirds of their heights.
  const double unit = 700.0 / 1200.0 < 900.0 / 1600.0 ? 700.0 / 1200.0 : 900.0 / 1600.0;
  drag({(1.5 * 205.0 + 16.0) * unit, 125.0 * unit}, {(1.5 * 205.0 + 16.0) * unit, 125.0 * unit});
  EXPECT_EQ(editor().photo(), 1u);
  const std::string with = picture();
  key('t');
  EXPECT_FALSE(editor().strip());
  EXPECT_TRUE(picture() != with);
}

TEST_F(EditorWindowTest, SavingGivesWhatWasEditedAndFailuresAreSaid) {
  mark();
  full_ = true;
  key('s');
  EXPECT_EQ(editor().status(), "the disk is full");
  key('q');  // warns
  EXPECT_EQ(num_saved_, 0);
  full_ = false;
  key('s');
  EXPECT_EQ(num_saved_, 1);
  ASSERT_EQ(saved_.facades.size(), 1u);
  EXPECT_EQ(saved_.facades[0].quad, editor().facades()[0].edit.quad);
  key('q');
  window_->run();  // returns
}

TEST_F(EditorWindowTest, ShowsItsKeys) {
  const std::string before = picture();
  key('h');
  EXPECT_TRUE(picture() != before);
  key('h');
  EXPECT_TRUE(picture() == before);
}

}  // namespace
}  // namespace storey::windows

int main(int argc, char** argv) {
  storey::view::restartOnVirtualDisplay(argv);  // returns if there is no xvfb-run
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
