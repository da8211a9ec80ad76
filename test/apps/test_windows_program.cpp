// SPDX-License-Identifier: BSD-3-Clause
// storey_windows as a user runs it, on photos of a generated building.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "export/formats.h"
#include "synth/buildings.h"
#include "synth/photos/photo_files.h"
#include "temporary_files.h"

namespace storey::test {
namespace {

struct Outcome {
  int status = -1;
  std::string message;
};

class WindowsProgram : public testing::Test {
 protected:
  /// Rendered once: all tests but read it.
  static void SetUpTestSuite() {
    directory_ = std::make_unique<TemporaryDirectory>();
    const PolyhedralModel model = extrudeFloorplans(synth::makeBuilding("box").layers);
    exports::findFormat("ply")->write(directory_->file("model.ply"), {model});
    synth::PhotoOptions options;
    options.views = 6;
    options.width = 320;
    options.window_pitch = 7.0;
    options.recess = 0.7;
    options.occluders = 0;
    synth::writePhotos(directory_->path(), model, options, {});
  }

  static void TearDownTestSuite() { directory_.reset(); }

  /// With MODEL CAMERAS IMAGES before the arguments.
  static Outcome run(const std::string& arguments, const std::string& prefix = "") {
    const TemporaryDirectory scratch;
    const std::string command = prefix + std::string(STOREY_WINDOWS) + " " +
                                directory_->file("model.ply") + " " + directory_->file("sparse") +
                                " " + directory_->file("images") + " " + arguments + " >" +
                                scratch.file("out") + " 2>" + scratch.file("err");
    const int result = std::system(command.c_str());
    return {WIFEXITED(result) ? WEXITSTATUS(result) : -1, readAll(scratch.file("err"))};
  }

  /// One line, that status, and no model.
  void expectFailure(int status, const std::string& arguments, const std::string& prefix = "") {
    const std::string before = readAll(directory_->file("model.ply"));
    const Outcome outcome = run(arguments + " -o " + output_.file("out.ply"), prefix);
    EXPECT_EQ(outcome.status, status) << arguments << ": " << outcome.message;
    EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
    EXPECT_FALSE(std::filesystem::exists(output_.file("out.ply"))) << arguments;
    EXPECT_TRUE(readAll(directory_->file("model.ply")) == before);
  }

  std::string record(const std::string& facades) {
    const std::string path = output_.file("windows_edit.json");
    std::ofstream(path) << R"({"format": "storey_windows edit 1", "facades": [)" << facades << "]}";
    return path;
  }

  static std::unique_ptr<TemporaryDirectory> directory_;
  TemporaryDirectory output_;
};

std::unique_ptr<TemporaryDirectory> WindowsProgram::directory_;

TEST_F(WindowsProgram, OneFormIsToBeChosen) {
  for (const char* const arguments :
       {"", "--quad 1,1,9,1,9,9,1,9", "--view 0", "--view 0 --quad 1,2,3",
        "--quad 1,1,9,1,9,9,1,9 --auto", "--auto --edit", "--auto --edit-file a.json",
        "--edit-file a.json --depth 1", "--edit --depth 1"}) {
    expectFailure(2, arguments);
  }
}

TEST_F(WindowsProgram, MistakesAreNamed) {
  expectFailure(66, "--edit-file " + output_.file("none.json"));
  expectFailure(65, "--edit-file " + record("3"));
  expectFailure(65, "--edit-file " + record(R"({"facade": 999})"));
  expectFailure(65,
                "--edit-file " + record(R"({"view": "none", "quad": [1, 1, 9, 1, 9, 9, 1, 9]})"));
  expectFailure(65,
                "--edit-file " + record(R"({"facade": 0, "windows": [{"row": 90, "column": 0}]})"));
  expectFailure(65, "--view view_00.png --quad 1,1,9,1,9,9,1,9");      // sky
  expectFailure(65, "--view view_00.png --quad 9,9,99,99,99,9,9,99");  // crosses itself
  expectFailure(75, "--edit", "env -u DISPLAY ");
}

TEST_F(WindowsProgram, ARecordGivesTheSameBytesAsTheProposal) {
  const std::string out = output_.file("auto.ply");
  const Outcome outcome = run("--auto -o " + out);
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const std::string list = readAll(output_.file("windows.json"));
  const auto facades = nlohmann::json::parse(list)["facades"];
  ASSERT_EQ(facades.size(), 4u);  // the walls
  std::string edits;
  for (const auto& facade : facades) {
    edits += (edits.empty() ? "" : ", ") + (R"({"facade": )" + facade["facade"].dump() + "}");
    const auto& windows = facade["windows"];
    EXPECT_TRUE(std::all_of(windows.begin(), windows.end(),
                            [](const auto& window) { return window["state"] == "cut"; }));
  }
  ASSERT_EQ(run("--edit-file " + record(edits) + " -o " + output_.file("again.ply")).status, 0);
  EXPECT_TRUE(readAll(out) == readAll(output_.file("again.ply")));
  EXPECT_TRUE(list == readAll(output_.file("windows.json")));
  const std::string prefix = "OMP_NUM_THREADS=1 ";
  ASSERT_EQ(run("--auto -o " + output_.file("one.ply"), prefix).status, 0);
  EXPECT_TRUE(readAll(out) == readAll(output_.file("one.ply")));
}

TEST_F(WindowsProgram, ADroppedWindowIsNotCut) {
  ASSERT_EQ(run("--auto -o " + output_.file("auto.ply")).status, 0);
  const auto facade = nlohmann::json::parse(readAll(output_.file("windows.json")))["facades"][0];
  const auto& window = facade["windows"][0];
  const std::string drop = R"({"facade": )" + facade["facade"].dump() +
                           R"(, "windows": [{"row": )" + window["row"].dump() + R"(, "column": )" +
                           window["column"].dump() + R"(, "keep": false}]})";
  ASSERT_EQ(run("--edit-file " + record(drop) + " -o " + output_.file("out.ply")).status, 0);
  const auto edited = nlohmann::json::parse(readAll(output_.file("windows.json")))["facades"];
  ASSERT_EQ(edited.size(), 1u);
  EXPECT_EQ(edited[0]["windows"].size() + 1, facade["windows"].size());
}

}  // namespace
}  // namespace storey::test
