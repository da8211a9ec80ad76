// SPDX-License-Identifier: BSD-3-Clause
#include "view/options.h"

#include <cstdint>

#include "cli/command_line.h"
#include "io/scan.h"

namespace storey::view {
namespace {

constexpr std::uint64_t kMinPixels = 400;   // below, the writing cannot be read
constexpr std::uint64_t kMaxPixels = 4096;  // twice as many are rendered: what every OpenGL can do

std::vector<cli::Choice<Stage>> stageChoices() {
  std::vector<cli::Choice<Stage>> choices;
  for (const StageInfo& info : allStages()) choices.push_back({info.name, info.stage});
  return choices;
}

std::string stageNames() {
  std::string names;
  for (const StageInfo& info : allStages()) {
    if (!names.empty()) names += &info == &allStages().back() ? " or " : ", ";
    names += info.name;
  }
  return names;
}

// What the command line gives before it is checked.
struct Given {
  std::string size = "1600x1200";
  View view = View::Isometric;
  int slice = 0;
};

PictureSize parseSize(const cli::CommandLine& line, const std::string& text) {
  const std::size_t x = text.find('x');
  const std::string_view all = text;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  const auto valid = [](std::uint64_t n) { return n >= kMinPixels && n <= kMaxPixels; };
  if (x == std::string::npos || !io::parseUnsigned(all.substr(0, x), width) ||
      !io::parseUnsigned(all.substr(x + 1), height) || !valid(width) || !valid(height)) {
    line.fail("--size is '" + text + "', expected WxH with numbers from 400 to 4096");
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

void checkChoices(const cli::CommandLine& line, const Given& given, Options& options) {
  if (options.directory.empty()) line.fail("no directory given");
  if (options.pictures && !options.picture.empty()) {
    line.fail("give either --pictures or --picture FILE.png");
  }
  options.size = parseSize(line, given.size);
  for (const char* const name : {"stage", "slice", "view"}) {
    if (options.pictures && line.given(name)) {
      line.fail(std::string("--") + name + " goes with one stage, not with --pictures");
    }
  }
  if (options.pictures) return;
  if (!options.picture.empty() && !line.given("stage")) line.fail("--picture needs a --stage");
  if (line.given("view")) options.view = given.view;
  if (line.given("slice")) options.slice = given.slice;
  const bool plan = isPlan(options.stage);
  if (options.slice && !plan) line.fail("--slice goes with --stage slice, segments or cells");
  if (plan && options.view && *options.view != View::Top) {
    line.fail("slices and cells are drawn in plan: --view top");
  }
}

}  // namespace

bool parseOptions(int argc, char** argv, Options& options) {
  Given given;
  cli::CommandLine line(
      "storey_view",
      {"DIRECTORY [--stage STAGE] [options]", "DIRECTORY --pictures [--size WxH]",
       "DIRECTORY --picture FILE.png --stage STAGE [options]"},
      "Shows what storey_reconstruct left in a directory: in a window, where h lists the keys, or\n"
      "in PNG files. Stages but the model need what its --intermediate writes. Pictures are drawn\n"
      "out of sight; a machine without a display needs xvfb-run (package xvfb) for them.");
  line.argument("directory", options.directory, "the output directory of storey_reconstruct");
  line.flag("pictures", options.pictures,
            "write a picture of every stage into the directory; stages without files are left out");
  line.text("picture", options.picture, "write one picture to this file");
  line.choice("stage", options.stage, stageChoices(), stageNames());
  line.whole(
      "slice", given.slice, 0,
      "number of the slice for --stage slice or segments, or of the block for --stage "
      "cells, from 0 at the bottom [the slice nearest the middle that has a floorplan, the middle "
      "block]");
  line.choice<View>("view", given.view,
                    {{"iso", View::Isometric}, {"top", View::Top}, {"front", View::Front}},
                    "iso = from the south-east above, top, front = from the south [iso; slices "
                    "and cells: top]");
  line.text("size", given.size, "width and height in pixels, 400 to 4096");
  if (!line.parse(argc, argv)) return false;
  checkChoices(line, given, options);
  return true;
}

}  // namespace storey::view
