// SPDX-License-Identifier: BSD-3-Clause
// What the window editor makes of keys and mouse, and the record that it leaves.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "editor_fixture.h"
#include "io/failure.h"
#include "temporary_files.h"
#include "windows/editor_overlay.h"
#include "windows/window_editor.h"

namespace storey::windows {
namespace {

using test::EditedWall;
using Action = WindowEditor::Action;

class WindowEditorTest : public testing::Test {
 protected:
  WindowEditorTest() : editor_(EditedWall::photos(), EditedWall::finder()) {}

  Action click(double x, double y) {
    const Action action = editor_.grab(EditedWall::pixel(x, y));
    return editor_.release() == Action::Nothing ? action : Action::Draw;
  }

  void drag(double x0, double y0, double x1, double y1) {
    editor_.grab(EditedWall::pixel(x0, y0));
    editor_.drag(EditedWall::pixel(0.5 * (x0 + x1), 0.5 * (y0 + y1)));
    editor_.drag(EditedWall::pixel(x1, y1));
    editor_.release();
  }

  /// About the lower left window.
  void mark() {
    click(0.9, 0.9);
    click(2.1, 0.9);
    click(2.1, 2.1);
    click(0.9, 2.1);
  }

  void type(const std::string& keys) {
    for (const char key : keys) editor_.press(key);
  }

  const FoundFacade& facade() const { return editor_.facades().at(0); }
  const FacadeWindow& window(std::size_t i) const { return facade().found.windows.at(i); }

  WindowEditor editor_;
};

TEST_F(WindowEditorTest, FourCornersFindTheWindows) {
  click(0.9, 0.9);
  click(2.1, 0.9);
  click(2.1, 2.1);
  EXPECT_EQ(editor_.corners().size(), 3u);
  EXPECT_TRUE(editor_.facades().empty());
  click(0.9, 2.1);
  ASSERT_EQ(editor_.facades().size(), 1u);
  EXPECT_TRUE(editor_.corners().empty());
  EXPECT_EQ(facade().edit.view, "front.png");
  EXPECT_EQ(facade().edit.quad[1], EditedWall::pixel(2.1, 0.9));
  EXPECT_EQ(editor_.related(), (std::vector<std::size_t>{0, 1}));
}

TEST_F(WindowEditorTest, AMarkThatFindsNothingSaysWhy) {
  click(5.0, 0.5);
  click(6.0, 0.5);
  click(6.0, 1.5);
  click(5.0, 1.5);
  EXPECT_TRUE(editor_.facades().empty());
  EXPECT_EQ(editor_.status(), "nothing looks like it");
  EXPECT_TRUE(editor_.edit().facades.empty());
}

TEST_F(WindowEditorTest, CornersOutsideThePhotoAreNone) {
  EXPECT_EQ(editor_.grab({-1.0, 10.0}), Action::Nothing);
  EXPECT_TRUE(editor_.corners().empty());
}

TEST_F(WindowEditorTest, AnotherPhotoForgetsCorners) {
  click(0.9, 0.9);
  editor_.press('n');
  EXPECT_EQ(editor_.photo(), 1u);
  EXPECT_TRUE(editor_.corners().empty());
  editor_.press('n');
  EXPECT_EQ(editor_.photo(), 0u);
  editor_.press('p');
  EXPECT_EQ(editor_.photo(), 1u);
  EXPECT_EQ(editor_.goTo(2), Action::Nothing);
}

TEST_F(WindowEditorTest, AClickKeepsAndDrops) {
  mark();
  EXPECT_TRUE(facade().isKept(window(0)));
  click(1.5, 1.5);
  EXPECT_TRUE(facade().isDropped(window(0)));
  EXPECT_EQ(facade().changed().windows.size(), 5u);
  click(1.5, 1.5);
  EXPECT_TRUE(facade().isKept(window(0)));
  EXPECT_FALSE(facade().isKept(window(5)));  // doubtful
  EXPECT_FALSE(facade().isDropped(window(5)));
  click(5.5, 3.5);
  EXPECT_TRUE(facade().isKept(window(5)));
  EXPECT_FALSE(facade().changed().windows[5].doubtful);
}

TEST_F(WindowEditorTest, AClickInAnotherPhotoIsOnTheSameWindow) {
  mark();
  editor_.press('n');
  editor_.grab(EditedWall::pixel(0.5, 1.5));  // moved by 1 to the left there
  editor_.release();
  EXPECT_TRUE(facade().isDropped(window(0)));
}

TEST_F(WindowEditorTest, ADragMovesAWindowAndKeepsItsSize) {
  mark();
  drag(3.5, 1.5, 3.8, 1.4);
  const Eigen::AlignedBox2d moved = facade().rectangle(window(1));
  EXPECT_LT((moved.min() - Eigen::Vector2d(3.3, 0.9)).norm(), 1e-9);
  EXPECT_LT((moved.sizes() - Eigen::Vector2d::Ones()).norm(), 1e-9);
  EXPECT_TRUE(facade().isKept(window(1)));  // a drag is no click
  EXPECT_LT((facade().changed().windows[1].min - moved.min()).norm(), 1e-12);
}

TEST_F(WindowEditorTest, AHandThatSlipsClicks) {
  mark();
  editor_.grab(EditedWall::pixel(1.5, 1.5));
  editor_.drag(EditedWall::pixel(1.5, 1.5) + Eigen::Vector2d(1.0, 1.0));
  editor_.release();
  EXPECT_TRUE(facade().isDropped(window(0)));
  EXPECT_FALSE(facade().change(window(0))->rectangle);
}

TEST_F(WindowEditorTest, ADepthIsTyped) {
  type("0.5\r");
  EXPECT_NE(editor_.status(), "");  // of what?
  mark();
  EXPECT_EQ(facade().depth(), 0.25);  // as found
  type("-0.45\b\r");
  EXPECT_EQ(facade().depth(), -0.4);
  type("1.2.3\r");
  EXPECT_NE(editor_.status(), "");
  EXPECT_EQ(facade().depth(), -0.4);
  type("\r");
  EXPECT_EQ(facade().depth(), 0.25);
}

TEST_F(WindowEditorTest, ADepthIsDragged) {
  mark();
  editor_.grabDepth();
  editor_.dragDepth(5.0);
  editor_.dragDepth(10.0);
  EXPECT_NEAR(facade().depth(), 0.25 + 10.0 * 0.01, 1e-12);
  editor_.press('u');  // all of the drag
  EXPECT_EQ(facade().depth(), 0.25);
}

TEST_F(WindowEditorTest, EverythingIsUndoneInTurn) {
  mark();
  click(1.5, 1.5);
  drag(3.5, 1.5, 3.8, 1.4);
  type("0.5\r");
  editor_.press('x');
  EXPECT_TRUE(editor_.facades().empty());
  editor_.press('u');
  EXPECT_EQ(facade().depth(), 0.5);
  editor_.press('u');
  EXPECT_EQ(facade().depth(), 0.25);
  editor_.press('u');
  EXPECT_EQ(facade().rectangle(window(1)).min(), window(1).min);
  editor_.press('u');
  EXPECT_TRUE(facade().isKept(window(0)));
  editor_.press('u');
  EXPECT_TRUE(editor_.facades().empty());
  editor_.press('u');
  EXPECT_NE(editor_.status(), "");
}

TEST_F(WindowEditorTest, ACornerIsUndone) {
  click(0.9, 0.9);
  click(2.1, 0.9);
  editor_.press('u');
  EXPECT_EQ(editor_.corners().size(), 1u);
  editor_.press('c');
  EXPECT_TRUE(editor_.corners().empty());
}

TEST_F(WindowEditorTest, AProposalDoesNotReplaceWhatIsThere) {
  mark();
  click(1.5, 1.5);
  editor_.press('a');
  ASSERT_EQ(editor_.facades().size(), 1u);
  EXPECT_TRUE(facade().edit.isMarked());
  editor_.press('x');
  editor_.press('a');
  ASSERT_EQ(editor_.facades().size(), 1u);
  EXPECT_FALSE(facade().edit.isMarked());
  EXPECT_EQ(facade().edit.facade, 7u);
}

TEST_F(WindowEditorTest, AMarkOfTheSameWindowReplacesTheFirst) {
  mark();
  click(1.5, 1.5);
  click(0.5, 0.5);
  click(2.5, 0.5);
  click(2.5, 2.5);
  click(0.5, 2.5);
  ASSERT_EQ(editor_.facades().size(), 1u);
  EXPECT_EQ(facade().edit.quad[0], EditedWall::pixel(0.5, 0.5));
  EXPECT_TRUE(facade().edit.changes.empty());
}

TEST_F(WindowEditorTest, AMarkElsewhereOnTheFacadeStaysBesideTheFirst) {
  mark();
  click(0.1, 0.1);
  click(0.8, 0.1);
  click(0.8, 0.8);
  click(0.1, 0.8);
  ASSERT_EQ(editor_.facades().size(), 2u);
  EXPECT_EQ(editor_.facade(), &editor_.facades()[1]);
  type("0.7\r");
  editor_.press('f');
  EXPECT_EQ(editor_.facade(), &editor_.facades()[0]);
  EXPECT_EQ(editor_.facade()->depth(), 0.25);
  EXPECT_EQ(editor_.edit().facades[1].depth, 0.7);
}

TEST_F(WindowEditorTest, WhatIsNotSavedIsNotLeftAtOnce) {
  EXPECT_EQ(editor_.press('q'), Action::Close);
  mark();
  EXPECT_EQ(editor_.press('s'), Action::Save);
  EXPECT_EQ(editor_.press('q'), Action::Draw);  // nobody said that it was saved
  EXPECT_NE(editor_.status(), "");
  EXPECT_EQ(editor_.press('q'), Action::Close);
  editor_.saved("written");
  EXPECT_EQ(editor_.press('q'), Action::Close);
}

TEST_F(WindowEditorTest, TheRecordReadsBackAsTheSame) {
  mark();
  click(1.5, 1.5);
  drag(3.5, 1.5, 3.8, 1.4);
  type("0.1\r");
  const test::TemporaryDirectory directory;
  const std::string first = directory.file("windows_edit.json");
  writeEdit(first, editor_.edit());
  const WindowEdit read = readEdit(first);
  ASSERT_EQ(read.facades.size(), 1u);
  EXPECT_EQ(read.facades[0].view, "front.png");
  EXPECT_EQ(read.facades[0].quad, facade().edit.quad);
  EXPECT_EQ(read.facades[0].depth, 0.1);
  const FoundFacade again = {read.facades[0], EditedWall::grid()};
  ASSERT_EQ(again.changed().windows.size(), 5u);
  EXPECT_EQ(again.rectangle(window(1)).min(), facade().rectangle(window(1)).min());
  const std::string second = directory.file("again.json");
  writeEdit(second, read);
  EXPECT_EQ(test::readAll(first), test::readAll(second));
}

TEST(WindowEdits, ThatAreMalformedAreNamedInOneLine) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("windows_edit.json");
  const std::string head = R"({"format": "storey_windows edit 1", "facades": )";
  const std::string quad = R"("view": "a", "quad": [1, 2, 3, 4, 5, 6, 7, 8])";
  const auto window = [&](const std::string& fields) {
    return head + "[{" + quad + R"(, "windows": [{)" + fields + "}]}]}";
  };
  const std::string malformed[] = {
      "",
      "{",
      "[]",
      "{}",
      R"({"format": "other", "facades": []})",
      head + "3}",
      head + "[3]}",
      head + "[{}]}",
      head + R"([{"view": "a"}]})",
      head + R"([{"view": 3, "quad": [1, 2, 3, 4, 5, 6, 7, 8]}]})",
      head + R"([{"view": "", "quad": [1, 2, 3, 4, 5, 6, 7, 8]}]})",
      head + R"([{"view": "a", "quad": [1, 2, 3, 4, 5, 6, 7]}]})",
      head + R"([{"view": "a", "quad": [1, 2, 3, 4, 5, 6, 7, "8"]}]})",
      head + "[{" + quad + R"(, "facade": 3}]})",
      head + R"([{"facade": -3}]})",
      head + R"([{"facade": 0.5}]})",
      head + "[{" + quad + R"(, "depth": "deep"}]})",
      head + "[{" + quad + R"(, "depth": 1e999}]})",
      head + "[{" + quad + R"(, "windows": 3}]})",
      window(R"("row": 0)"),
      window(R"("row": 0.5, "column": 0)"),
      window(R"("row": -1, "column": 0)"),
      window(R"("row": 12345678901, "column": 0)"),
      window(R"("row": 0, "column": 0, "keep": 1)"),
      window(R"("row": 0, "column": 0, "rectangle": [0, 0, 1])"),
      window(R"("row": 0, "column": 0, "rectangle": [0, 0, 1, "x"])"),
      window(R"("row": 0, "column": 0, "rectangle": [1, 0, 0, 1])"),
      window(R"("row": 0, "column": 0}, {"row": 0, "column": 0)"),
  };
  for (const std::string& text : malformed) {
    std::ofstream(path) << text;
    try {
      readEdit(path);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const io::Failure& failure) {
      EXPECT_EQ(failure.status(), io::BadInput) << text;
      const std::string line = failure.what();
      EXPECT_EQ(line.find('\n'), std::string::npos);
      EXPECT_NE(line.find("windows_edit.json"), std::string::npos);
    }
  }
  std::ofstream(path) << window(R"("row": 0, "column": 0)");
  EXPECT_EQ(readEdit(path).facades.size(), 1u);
}

TEST(PhotoViews, ZoomAboutAPlace) {
  PhotoView view = PhotoView::whole(EditedWall::camera(0.0), {0.0, 100.0}, {400.0, 500.0});
  EXPECT_DOUBLE_EQ(view.scale, 0.5);  // 800 pixels in 400
  EXPECT_LT((view.toWindow({400.0, 300.0}) - Eigen::Vector2d(200.0, 300.0)).norm(), 1e-9);
  const Eigen::Vector2d place(150.0, 350.0);
  const Eigen::Vector2d pixel = view.toPhoto(place);
  view.zoom(4.0, place);
  EXPECT_LT((view.toPhoto(place) - pixel).norm(), 1e-9);
  EXPECT_LT(
      (view.toWindow(pixel + Eigen::Vector2d(1.0, 0.0)) - place - Eigen::Vector2d(2.0, 0.0)).norm(),
      1e-9);
}

TEST_F(WindowEditorTest, LinesAreWhereWindowsAreAndEndAtTheEdge) {
  mark();
  type("0\r");  // no panes
  const PhotoView whole = PhotoView::whole(editor_.photos()[0].camera, {0.0, 0.0}, {800.0, 600.0});
  std::vector<OverlayLines> lines = overlayOf(editor_, 0, whole);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].mark, Mark::Kept);
  EXPECT_EQ(lines[0].segments.size(), 5u * 4u);
  EXPECT_EQ(lines[1].mark, Mark::Doubtful);
  const Eigen::Vector2d foot = whole.toWindow(EditedWall::pixel(1.0, 1.0));
  EXPECT_LT((lines[0].segments[0].first - foot).norm(), 1e-9);

  PhotoView part = whole;
  part.zoom(4.0, foot);
  for (const OverlayLines& of : overlayOf(editor_, 0, part)) {
    for (const Segment& segment : of.segments) {
      for (const Eigen::Vector2d& end : {segment.first, segment.second}) {
        EXPECT_GE((end - part.low).minCoeff(), -1e-9);
        EXPECT_GE((part.high - end).minCoeff(), -1e-9);
      }
    }
  }
  type("0.3\r");
  EXPECT_EQ(overlayOf(editor_, 0, whole).size(), 3u);  // and panes
}

}  // namespace
}  // namespace storey::windows
