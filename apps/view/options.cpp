// SPDX-License-Identifier: BSD-3-Clause
#include "view/options.h"

#include <boost/program_options.hpp>
#include <cstdint>
#include <iostream>
#include <vector>

#include "io/failure.h"
#include "io/scan.h"

namespace storey::view {
namespace {

namespace po = boost::program_options;

constexpr std::uint64_t kMinPixels = 400;   // below, the writing cannot be read
constexpr std::uint64_t kMaxPixels = 4096;  // twice as many are rendered: what every OpenGL can do

const std::vector<std::string> kStageNames = {"confidence", "directions", "slices",  "normals",
                                              "labels",     "regions",    "refined", "floorplans",
                                              "model",      "overlay",    "slice"};
const std::vector<std::string> kViewNames = {"iso", "top", "front"};  // in the order of View

[[noreturn]] void usageError(const std::string& reason) {
  throw io::Failure(io::Usage, "", reason, "see storey_view --help");
}

po::options_description describe(Options& o) {
  po::options_description all(
      "usage: storey_view DIRECTORY --pictures [--size WxH]\n"
      "       storey_view DIRECTORY --picture FILE.png --stage STAGE [options]\n\n"
      "Draws what storey_reconstruct left in a directory, to PNG files. Stages but the model need\n"
      "what its --intermediate writes. Needs a display, of which nothing is seen; on a machine\n"
      "without one: xvfb-run -a -s '-screen 0 1600x1200x24' storey_view ...\n\n"
      "options");
  all.add_options()("help,h", "print this and exit")("version", "print the version and exit")(
      "directory", po::value(&o.directory), "the output directory of storey_reconstruct")(
      "pictures", po::bool_switch(&o.pictures),
      "write a picture of every stage into the directory; stages without files are left out")(
      "picture", po::value(&o.picture), "write one picture to this file")(
      "stage", po::value<std::string>(),
      "confidence, directions, slices, normals, labels, regions, refined, floorplans, model, "
      "overlay or slice")("slice", po::value<int>(),
                          "number of the slice for --stage slice, from 0 at the bottom [the one "
                          "nearest the middle that has a floorplan]")(
      "view", po::value<std::string>(),
      "iso = from the south-east above, top, front = from the south [iso; slice: top]")(
      "size", po::value<std::string>()->default_value("1600x1200"),
      "width and height in pixels, 400 to 4096");
  return all;
}

std::size_t choose(const std::string& option, const std::string& value,
                   const std::vector<std::string>& names) {
  std::string expected;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (value == names[i]) return i;
    expected += (i == 0 ? "" : ", ") + names[i];
  }
  usageError("--" + option + " is '" + value + "', expected one of " + expected);
}

PictureSize parseSize(const std::string& text) {
  const std::size_t x = text.find('x');
  const std::string_view all = text;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  const auto valid = [](std::uint64_t n) { return n >= kMinPixels && n <= kMaxPixels; };
  if (x == std::string::npos || !io::parseUnsigned(all.substr(0, x), width) ||
      !io::parseUnsigned(all.substr(x + 1), height) || !valid(width) || !valid(height)) {
    usageError("--size is '" + text + "', expected WxH with numbers from 400 to 4096");
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

void parseChoices(const po::variables_map& given, Options& options) {
  if (options.directory.empty()) usageError("no directory given");
  if (options.pictures == !options.picture.empty()) {
    usageError("give either --pictures or --picture FILE.png");
  }
  options.size = parseSize(given["size"].as<std::string>());
  for (const char* const name : {"stage", "slice", "view"}) {
    if (options.pictures && given.count(name) != 0) {
      usageError(std::string("--") + name + " goes with --picture, not with --pictures");
    }
  }
  if (options.pictures) return;
  if (given.count("stage") == 0) usageError("--picture needs a --stage");
  options.stage =
      static_cast<Stage>(choose("stage", given["stage"].as<std::string>(), kStageNames));
  if (given.count("view") != 0) {
    options.view = static_cast<View>(choose("view", given["view"].as<std::string>(), kViewNames));
  }
  if (given.count("slice") != 0) options.slice = given["slice"].as<int>();
  const bool plan = options.stage == Stage::Slice;
  if (options.slice && !plan) usageError("--slice goes with --stage slice");
  if (options.slice && *options.slice < 0) usageError("--slice counts from 0");
  if (plan && options.view && *options.view != View::Top) {
    usageError("a slice is drawn in plan: --view top");
  }
}

}  // namespace

bool parseOptions(int argc, char** argv, Options& options) {
  const po::options_description all = describe(options);
  po::positional_options_description positional;
  positional.add("directory", 1);
  po::variables_map given;
  try {
    // No guessing of shortened names: --picture would stand for --pictures.
    const int style =
        po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::store(
        po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
        given);
    if (given.count("help") != 0) {
      std::cout << all << '\n';
      return false;
    }
    if (given.count("version") != 0) {
      std::cout << "storey " << STOREY_VERSION << '\n';
      return false;
    }
    po::notify(given);
  } catch (const po::error& error) {
    usageError(error.what());
  }
  parseChoices(given, options);
  return true;
}

}  // namespace storey::view
