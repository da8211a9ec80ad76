// SPDX-License-Identifier: BSD-3-Clause
// Windows of a facade from photos, cut into a model.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "export/formats.h"
#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "windows/windowed_model.h"

namespace {

namespace cli = storey::cli;
namespace exports = storey::exports;
namespace io = storey::io;
namespace windows = storey::windows;

struct Request {
  std::string model;
  std::string cameras;
  std::string images;
  std::string view;
  std::array<Eigen::Vector2d, 4> quad;
  std::optional<double> depth;
  std::string output;
  const exports::Format* format = nullptr;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line("storey_windows",
                        {"MODEL CAMERAS IMAGES --view NAME --quad X1,Y1,...,X4,Y4 -o OUT"},
                        "Finds all windows of a facade from a quadrilateral around one of them on "
                        "a photo, and cuts them into the closed model (.ply, .obj). Doubtful ones "
                        "are listed but not cut.");
  std::string quad;
  double depth = 0.0;
  line.argument("model", r.model, "closed model, .ply or .obj");
  line.argument("cameras", r.cameras,
                "cameras in the model's coordinates: COLMAP, Bundler or PMVS");
  line.argument("images", r.images, "folder of the photos");
  line.text("view", r.view, "the photo that is drawn on: its name, or its number in CAMERAS");
  line.text("quad", quad, "corners of the quadrilateral, pixels from the upper left corner");
  line.number("depth", depth, cli::kAnyNumber,
              "of the panes behind the wall, negative: before it, in the model's unit; not given: "
              "what the photos show, 0 being painted windows, which are not cut");
  line.text("output,o", r.output, "model to write: .ply, .obj, .city.json, .glb, .stl or .vtk");
  if (!line.parse(argc, argv)) return false;
  if (r.images.empty() || r.view.empty() || quad.empty() || r.output.empty()) {
    line.fail("a model, its cameras, the folder of the images, --view, --quad and -o are needed");
  }
  const auto corners = windows::parseQuad(quad);
  if (!corners) line.fail("--quad is to be eight numbers, x1,y1,...,x4,y4");
  r.quad = *corners;
  if (line.given("depth")) r.depth = depth;
  r.format = exports::formatOfFile(r.output);
  if (r.format == nullptr) line.fail("the extension of -o " + r.output + " is of no known format");
  return true;
}

void print(const windows::CutWindows& found) {
  const storey::WindowGrid& grid = found.grid;
  std::printf("%6s %6s %10s %10s %10s %10s %10s %s\n", "row", "column", "left", "foot", "width",
              "height", "confidence", "");
  for (std::size_t i = 0; i < grid.windows.size(); ++i) {
    const storey::FacadeWindow& w = grid.windows[i];
    const Eigen::Vector2d size = w.max - w.min;
    std::printf("%6d %6d %10.4g %10.4g %10.4g %10.4g %10.2f %s\n", w.row, w.column, w.min.x(),
                w.min.y(), size.x(), size.y(), w.confidence,
                found.cut[i] ? "cut" : (w.doubtful ? "doubtful" : "not cut"));
  }
  std::printf(
      "facade %zu, %zu photos: %zu windows, %td cut, depth %.4g%s\n", grid.facade,
      grid.photos.size(), grid.windows.size(), std::count(found.cut.begin(), found.cut.end(), true),
      found.depth,
      found.depth == 0.0 ? (grid.depth_known ? " (painted)" : " (not known: --depth)") : "");
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) return io::Ok;
  windows::SolidModel solid = windows::readSolid(request.model);
  io::CameraSet cameras = io::readCameras(request.cameras);
  io::findImages(request.images, cameras);
  storey::WindowMark mark;
  mark.photo = windows::findView(request.cameras, cameras, request.view);
  mark.corners = request.quad;
  std::vector<storey::FacadePhoto> photos;
  for (const io::Photo& photo : cameras.photos) {
    photos.push_back({photo.camera, io::readImage(photo)});
  }
  const windows::CutWindows found = windows::addWindows(photos, mark, request.depth, solid);
  if (!found.grid.problem.empty()) {
    throw io::Failure(io::BadInput, cameras.photos[mark.photo].image, found.grid.problem,
                      "draw the quadrilateral around a window on one wall");
  }
  request.format->write(request.output, {solid.model, solid.to_file, solid.crs});
  print(found);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_windows", [&] { return run(argc, argv); });
}
