// SPDX-License-Identifier: BSD-3-Clause
// storey_view as a user runs it. Without a display it draws on one that xvfb-run makes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "view_files.h"

namespace storey::test {
namespace {

struct Outcome {
  int status = -1;
  std::string message;
};

Outcome runView(const std::string& arguments, const std::string& prefix = "") {
  const TemporaryDirectory scratch;
  const std::string command = prefix + std::string(STOREY_VIEW) + " " + arguments + " >" +
                              scratch.file("out") + " 2>" + scratch.file("err");
  const int result = std::system(command.c_str());
  return {WIFEXITED(result) ? WEXITSTATUS(result) : -1, readAll(scratch.file("err"))};
}

bool haveVirtualDisplay() {
  return std::system("command -v xvfb-run >/dev/null && command -v Xvfb >/dev/null") == 0;
}

bool havePictures() { return std::getenv("DISPLAY") != nullptr || haveVirtualDisplay(); }

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

TEST(ViewProgram, WrongCommandLinesGiveOneLineAndStatus2) {
  const BoxReconstruction box;
  for (const char* const arguments :
       {"", "--pictures", "DIR --slice 1", "DIR --pictures --picture a.png", "DIR --picture a.png",
        "DIR --picture a.png --stage nothing", "DIR --picture a.png --stage model --view behind",
        "DIR --picture a.png --stage model --slice 1", "DIR --pictures --stage model",
        "DIR --picture a.png --stage slice --slice -1", "DIR --pictures --size 100x100",
        "DIR --picture a.png --stage slice --view iso", "DIR --pictures --size 800",
        "DIR --pictures --size 800x600x2", "DIR --pictures --siz 800x600", "DIR DIR --pictures"}) {
    std::string with_directory = arguments;
    for (std::size_t at; (at = with_directory.find("DIR")) != std::string::npos;) {
      with_directory.replace(at, 3, box.path());
    }
    const Outcome outcome = runView(with_directory);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
  }
}

TEST(ViewProgram, HelpIsNoError) { EXPECT_EQ(runView("--help").status, 0); }

TEST(ViewProgram, MissingInputsGiveStatus66AndTheirName) {
  const BoxReconstruction box;
  const TemporaryDirectory empty;
  EXPECT_EQ(runView("/nonexistent/directory --pictures").status, 66);
  EXPECT_EQ(runView(box.file("report.json") + " --pictures").status, 66);
  EXPECT_EQ(runView(empty.path() + " --pictures").status, 66);
  const Outcome outcome =
      runView(box.path() + " --picture " + box.file("a.png") + " --stage confidence");
  EXPECT_EQ(outcome.status, 66);
  EXPECT_NE(outcome.message.find("02_confidence.pcd"), std::string::npos) << outcome.message;
}

TEST(ViewProgram, WithoutADisplayItSaysWhatToDo) {
  const BoxReconstruction box;
  const std::string without = "env -u DISPLAY -u WAYLAND_DISPLAY PATH=/nonexistent ";
  const Outcome outcome =
      runView(box.path() + " --picture " + box.file("a.png") + " --stage model", without);
  if (outcome.status == 0) GTEST_SKIP() << "this VTK needs no display";
  EXPECT_EQ(outcome.status, 75);
  EXPECT_NE(outcome.message.find("xvfb"), std::string::npos) << outcome.message;
  EXPECT_FALSE(std::filesystem::exists(box.file("a.png")));
  const Outcome window = runView(box.path(), without);
  EXPECT_EQ(window.status, 75);
  EXPECT_NE(window.message.find("--pictures"), std::string::npos) << window.message;
}

TEST(ViewProgram, ADisplayWithoutOpenGlIsToldBeforeItEndsTheProgram) {
  if (!haveVirtualDisplay()) GTEST_SKIP() << "no xvfb-run";
  const BoxReconstruction box;
  for (const char* const screen : {"640x480x24 -extension GLX", "640x480x8"}) {
    const Outcome outcome =
        runView(box.path() + " --picture " + box.file("a.png") + " --stage model",
                std::string("xvfb-run -a -s '-screen 0 ") + screen + " -noreset' ");
    EXPECT_EQ(outcome.status, 75) << screen << outcome.message;
    EXPECT_FALSE(std::filesystem::exists(box.file("a.png")));
  }
}

TEST(ViewProgram, PicturesArePngOfTheSizeAskedForAndTheSameEachTime) {
  if (!havePictures()) GTEST_SKIP() << "no display and no xvfb-run";
  const BoxReconstruction box;
  const auto draw = [&](const std::string& name, const std::string& view) {
    const Outcome outcome = runView(box.path() + " --picture " + box.file(name) +
                                    " --stage model --size 500x400 --view " + view);
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    return readAll(box.file(name));
  };
  const std::string png = draw("a.png", "iso");
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(bigEndian(png, 16), 500u);
  EXPECT_EQ(bigEndian(png, 20), 400u);
  EXPECT_EQ(draw("b.png", "iso"), png);
  EXPECT_NE(draw("c.png", "top"), png);  // an empty picture would be the same from everywhere
}

TEST(ViewProgram, AllPicturesAreWrittenForWhichThereAreFiles) {
  if (!havePictures()) GTEST_SKIP() << "no display and no xvfb-run";
  const BoxReconstruction box;
  box.writeStages();
  std::ofstream(box.file("report.html")) << "<!--pictures--><!--/pictures-->";
  const Outcome outcome = runView(box.path() + " --pictures --size 400x400");
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  const std::string page = readAll(box.file("report.html"));
  for (const char* const name : {"04_slices", "05_normals", "08_refined", "09_slice",
                                 "09_floorplans", "11_model", "11_model_top", "12_overlay"}) {
    EXPECT_TRUE(std::filesystem::exists(box.file(name + std::string(".png")))) << name;
    EXPECT_NE(page.find(std::string("alt=\"") + name + "\""), std::string::npos) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(box.file("02_confidence.png")));
  EXPECT_NE(outcome.message.find("02_confidence.png"), std::string::npos) << outcome.message;
}

}  // namespace
}  // namespace storey::test
