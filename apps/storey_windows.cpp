// SPDX-License-Identifier: BSD-3-Clause
// Windows from photos, cut into a model.
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "export/formats.h"
#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "windows/window_edit.h"
#include "windows/window_list.h"
#include "windows/windowed_model.h"

namespace {

namespace cli = storey::cli;
namespace exports = storey::exports;
namespace io = storey::io;
namespace windows = storey::windows;

enum class Form { None, Mark, Auto, Replay };

struct Request {
  std::string model;
  std::string cameras;
  std::string images;
  Form form = Form::None;
  windows::FacadeEdit mark;  // of form Mark
  std::string edit_file;     // of form Replay
  std::optional<double> depth;
  std::string output;
  const exports::Format* format = nullptr;
};

/// What is found on a facade, and what is to become of it.
using Found = std::pair<windows::FacadeEdit, storey::WindowGrid>;

void chooseForm(const cli::CommandLine& line, bool automatic, const std::string& quad, Request& r) {
  const bool marked = !r.mark.view.empty() || !quad.empty();
  const int forms = (marked ? 1 : 0) + (automatic ? 1 : 0) + (r.edit_file.empty() ? 0 : 1);
  if (forms != 1) line.fail("either --view with --quad, or --auto, or --edit-file is needed");
  r.form = marked ? Form::Mark : (automatic ? Form::Auto : Form::Replay);
  if (r.form == Form::Replay && r.depth) line.fail("--depth is in the file of --edit-file");
  if (r.form != Form::Mark) return;
  const auto corners = windows::parseQuad(quad);
  if (r.mark.view.empty()) line.fail("--quad needs the photo that it is on, --view");
  if (!corners) line.fail("--quad is to be eight numbers, x1,y1,...,x4,y4");
  r.mark.quad = *corners;
  r.mark.depth = r.depth;
}

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line(
      "storey_windows",
      {"MODEL CAMERAS IMAGES --view NAME --quad X1,Y1,...,X4,Y4 -o OUT",
       "MODEL CAMERAS IMAGES --auto -o OUT", "MODEL CAMERAS IMAGES --edit-file FILE -o OUT"},
      "Finds windows in photos and cuts them into the closed model (.ply, .obj): "
      "those of a facade from a quadrilateral around one of them, or those of "
      "all facades on which they repeat. windows.json beside OUT lists them; "
      "doubtful ones are not cut.");
  std::string quad;
  double depth = 0.0;
  bool automatic = false;
  line.argument("model", r.model, "closed model, .ply or .obj");
  line.argument("cameras", r.cameras,
                "cameras in the model's coordinates: COLMAP, Bundler or PMVS");
  line.argument("images", r.images, "folder of the photos");
  line.text("view", r.mark.view, "the photo that is drawn on: its name, or its number in CAMERAS");
  line.text("quad", quad, "corners of the quadrilateral, pixels from the upper left corner");
  line.flag("auto", automatic, "find what repeats on each wall, without any mark");
  line.text("edit-file", r.edit_file, "do again what was done in the editor (windows_edit.json)");
  line.number("depth", depth, cli::kAnyNumber,
              "of the panes behind the wall, negative: before it, in the model's unit; not given: "
              "what the photos show, 0 being painted windows, which are not cut");
  line.text("output,o", r.output, "model to write: .ply, .obj, .city.json, .glb, .stl or .vtk");
  if (!line.parse(argc, argv)) return false;
  if (r.images.empty() || r.output.empty()) {
    line.fail("a model, its cameras, the folder of the images, and -o are needed");
  }
  if (line.given("depth")) r.depth = depth;
  chooseForm(line, automatic, quad, r);
  r.format = exports::formatOfFile(r.output);
  if (r.format == nullptr) line.fail("the extension of -o " + r.output + " is of no known format");
  return true;
}

std::vector<storey::FacadePhoto> readPhotos(const io::CameraSet& cameras) {
  std::vector<storey::FacadePhoto> photos;
  for (const io::Photo& photo : cameras.photos) {
    photos.push_back({photo.camera, io::readImage(photo)});
  }
  return photos;
}

std::vector<Found> findAll(const Request& request, const windows::WindowSearch& search) {
  std::vector<Found> found = search.findAll();
  if (found.empty()) {
    throw io::Failure(io::BadInput, request.model, "shows no windows that repeat in the photos",
                      "mark one with --view and --quad");
  }
  for (Found& facade : found) facade.first.depth = request.depth;
  return found;
}

/// A grid for each facade of an edit.
/// \param path of what the edit is from, for messages
std::vector<Found> find(const std::string& path, const windows::WindowEdit& edit,
                        const windows::WindowSearch& search) {
  std::vector<Found> found;
  for (const windows::FacadeEdit& facade : edit.facades) {
    storey::WindowGrid grid = search.find(facade);
    const std::string of = facade.isMarked() ? "view " + facade.view : "its facade";
    if (!grid.problem.empty()) {
      throw io::Failure(io::BadInput, path, of + ": " + grid.problem,
                        "draw the quadrilateral around a window on one wall");
    }
    try {
      found.emplace_back(facade, windows::changed(std::move(grid), facade.changes));
    } catch (const std::invalid_argument& error) {
      throw io::Failure(io::BadInput, path, of + ": " + error.what(),
                        "edit the model and photos that it was made with");
    }
  }
  return found;
}

std::vector<Found> find(const Request& request, const windows::WindowSearch& search) {
  if (request.form == Form::Auto) return findAll(request, search);
  if (request.form == Form::Mark) return find(request.images, {{request.mark}}, search);
  return find(request.edit_file, windows::readEdit(request.edit_file), search);
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) return io::Ok;
  windows::SolidModel solid = windows::readSolid(request.model);
  io::CameraSet cameras = io::readCameras(request.cameras);
  io::findImages(request.images, cameras);
  const windows::WindowSearch search(solid, request.cameras, cameras, readPhotos(cameras));
  std::vector<windows::CutWindows> facades;
  for (Found& found : find(request, search)) {
    facades.push_back(windows::cutInto(solid, std::move(found.second), found.first.depth));
  }
  const auto list = std::filesystem::path(request.output).replace_filename("windows.json");
  request.format->write(request.output, {solid.model, solid.to_file});
  windows::writeWindows(list.string(), facades, cameras, solid.to_file);
  windows::printWindows(facades);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_windows", [&] { return run(argc, argv); });
}
