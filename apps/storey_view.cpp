// SPDX-License-Identifier: BSD-3-Clause
// storey_view DIRECTORY --pictures: pictures of what storey_reconstruct left in a directory.
#include <algorithm>
#include <cstdio>

#include "cli/command_line.h"
#include "export/report_page.h"
#include "io/failure.h"
#include "view/options.h"
#include "view/render.h"
#include "view/stages.h"

namespace storey::view {
namespace {

struct Picture {
  const char* file;
  Stage stage;
  View view;
};

// In the order of the method; numbers as those of the files that they show.
constexpr Picture kPictures[] = {{"02_confidence.png", Stage::Confidence, View::Isometric},
                                 {"03_directions.png", Stage::Directions, View::Isometric},
                                 {"04_slices.png", Stage::Slices, View::Isometric},
                                 {"05_normals.png", Stage::Normals, View::Isometric},
                                 {"06_labels.png", Stage::Labels, View::Isometric},
                                 {"08_refined.png", Stage::Refined, View::Isometric},
                                 {"07_regions.png", Stage::Regions, View::Isometric},
                                 {"09_slice.png", Stage::Slice, View::Top},
                                 {"09_floorplans.png", Stage::Floorplans, View::Isometric},
                                 {"11_model.png", Stage::Model, View::Isometric},
                                 {"11_model_top.png", Stage::Model, View::Top},
                                 {"12_overlay.png", Stage::Overlay, View::Isometric}};

std::string firstMissing(const Reconstruction& reconstruction, Stage stage) {
  for (const std::string& name : filesOf(stage)) {
    if (!reconstruction.has(name)) return name;
  }
  return {};
}

void writeAll(const Reconstruction& reconstruction, const PictureSize& size) {
  const PictureWriter writer(size);
  std::vector<std::string> written;
  for (const Picture& picture : kPictures) {
    const std::string missing = firstMissing(reconstruction, picture.stage);
    if (!missing.empty()) {
      std::fprintf(stderr, "%s left out: there is no %s\n", picture.file, missing.c_str());
      continue;
    }
    const Drawing drawing = makeDrawing(reconstruction, picture.stage, picture.view, std::nullopt);
    writer.write(reconstruction.file(picture.file), drawing);
    written.push_back(reconstruction.file(picture.file));
  }
  if (written.empty()) {
    throw io::Failure(io::MissingInput, reconstruction.file(""), "has nothing to draw",
                      "run storey_reconstruct again");
  }
  if (reconstruction.has("report.html")) {
    exports::addPictures(reconstruction.file("report.html"), written);
  }
}

void writeOne(const Reconstruction& reconstruction, const Options& options) {
  const std::string missing = firstMissing(reconstruction, options.stage);
  if (!missing.empty()) {
    throw io::Failure(io::MissingInput, reconstruction.file(missing), "is not there",
                      "run storey_reconstruct with --intermediate");
  }
  const View own = options.stage == Stage::Slice ? View::Top : View::Isometric;
  const Drawing drawing =
      makeDrawing(reconstruction, options.stage, options.view.value_or(own), options.slice);
  PictureWriter(options.size).write(options.picture, drawing);
}

int run(int argc, char** argv) {
  Options options;
  if (!parseOptions(argc, argv, options)) return io::Ok;
  const Reconstruction reconstruction(options.directory);
  if (options.pictures) {
    writeAll(reconstruction, options.size);
  } else {
    writeOne(reconstruction, options);
  }
  return io::Ok;
}

}  // namespace
}  // namespace storey::view

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_view", [&] { return storey::view::run(argc, argv); });
}
