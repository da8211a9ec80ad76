// SPDX-License-Identifier: BSD-3-Clause
// storey_view DIRECTORY: what storey_reconstruct left in a directory, in a window or in pictures.
#include <algorithm>
#include <cstdio>

#include "cli/command_line.h"
#include "export/report_page.h"
#include "io/failure.h"
#include "view/options.h"
#include "view/render.h"
#include "view/stages.h"
#include "view/viewer_window.h"
#include "view/virtual_display.h"

namespace storey::view {
namespace {

struct Picture {
  const char* file;
  Stage stage;
  View view;
};

// In the order of the method; numbers as those of the files that they show.
constexpr Picture kPictures[] = {{"01_upright.png", Stage::Upright, View::Isometric},
                                 {"02_confidence.png", Stage::Confidence, View::Isometric},
                                 {"02_classes.png", Stage::Classes, View::Isometric},
                                 {"03_directions.png", Stage::Directions, View::Isometric},
                                 {"04_slices.png", Stage::Slices, View::Isometric},
                                 {"05_normals.png", Stage::Normals, View::Isometric},
                                 {"06_labels.png", Stage::Labels, View::Isometric},
                                 {"08_refined.png", Stage::Refined, View::Isometric},
                                 {"07_regions.png", Stage::Regions, View::Isometric},
                                 {"09_slice.png", Stage::Slice, View::Top},
                                 {"09_segments.png", Stage::Segments, View::Top},
                                 {"09_walls.png", Stage::Walls, View::Isometric},
                                 {"09_cells.png", Stage::Cells, View::Top},
                                 {"09_floorplans.png", Stage::Floorplans, View::Isometric},
                                 {"10_types.png", Stage::Types, View::Isometric},
                                 {"11_model.png", Stage::Model, View::Isometric},
                                 {"11_model_top.png", Stage::Model, View::Top},
                                 {"11_support.png", Stage::Support, View::Isometric},
                                 {"11_deviation.png", Stage::Deviation, View::Isometric},
                                 {"12_windows.png", Stage::Windows, View::Isometric},
                                 {"13_textured.png", Stage::Textured, View::Isometric},
                                 {"12_overlay.png", Stage::Overlay, View::Isometric}};

void writeAll(const Reconstruction& reconstruction, const PictureSize& size) {
  const PictureWriter writer(size);
  std::vector<std::string> written;
  std::string left_out;
  for (const Picture& picture : kPictures) {
    if (!missingFile(reconstruction, picture.stage).empty()) {
      left_out += std::string(left_out.empty() ? "" : ", ") + picture.file;
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
  if (!left_out.empty()) {
    std::fprintf(stderr, "left out, for there is nothing of these stages: %s\n", left_out.c_str());
  }
  if (reconstruction.has("report.html")) {
    exports::addPictures(reconstruction.file("report.html"), written);
  }
}

void writeOne(const Reconstruction& reconstruction, const Options& options) {
  const std::string missing = missingFile(reconstruction, options.stage);
  if (!missing.empty()) {
    throw io::Failure(io::MissingInput, reconstruction.file(missing), "is not there",
                      "run storey_reconstruct with --intermediate");
  }
  const View own = isPlan(options.stage) ? View::Top : View::Isometric;
  const Drawing drawing =
      makeDrawing(reconstruction, options.stage, options.view.value_or(own), options.slice);
  PictureWriter(options.size).write(options.picture, drawing);
}

void showAll(const Reconstruction& reconstruction, const Options& options) {
  std::vector<ViewerState::Entry> entries;
  for (const StageInfo& info : allStages()) {
    if (info.stage == Stage::Overlay) continue;  // a key lays the cloud over the model
    entries.push_back({info.stage, missingFile(reconstruction, info.stage),
                       countSteps(reconstruction, info.stage)});
  }
  ViewerState state(std::move(entries), options.stage, options.slice);
  ViewerWindow(reconstruction, std::move(state), options.size).run();
}

int run(int argc, char** argv) {
  Options options;
  if (!parseOptions(argc, argv, options)) return io::Ok;
  if (options.pictures || !options.picture.empty()) restartOnVirtualDisplay(argv);
  const Reconstruction reconstruction(options.directory);
  if (options.pictures) {
    writeAll(reconstruction, options.size);
  } else if (!options.picture.empty()) {
    writeOne(reconstruction, options);
  } else {
    showAll(reconstruction, options);
  }
  return io::Ok;
}

}  // namespace
}  // namespace storey::view

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_view", [&] { return storey::view::run(argc, argv); });
}
