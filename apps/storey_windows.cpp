// SPDX-License-Identifier: BSD-3-Clause
// Windows from photos, cut into a model.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "export/formats.h"
#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "windows/editor_window.h"
#include "windows/window_edit.h"
#include "windows/window_list.h"
#include "windows/windowed_model.h"

namespace {

namespace cli = storey::cli;
namespace exports = storey::exports;
namespace io = storey::io;
namespace windows = storey::windows;

enum class Form { None, Mark, Auto, Replay, Edit };

struct Request {
  std::string model;
  std::string cameras;
  std::string images;
  Form form = Form::None;
  windows::FacadeEdit mark;  // of form Mark
  std::string edit_file;     // of form Replay; of form Edit, what to go on with
  std::optional<double> depth;
  std::string output;
  const exports::Format* format = nullptr;
};

void chooseForm(const cli::CommandLine& line, bool automatic, bool edit, const std::string& quad,
                Request& r) {
  const bool marked = !r.mark.view.empty() || !quad.empty();
  const bool edited = edit || !r.edit_file.empty();
  if ((marked ? 1 : 0) + (automatic ? 1 : 0) + (edited ? 1 : 0) != 1) {
    line.fail("one of --view with --quad, --auto, --edit or --edit-file is needed");
  }
  if (edited && r.depth) line.fail("--depth goes with --quad or --auto; edits have their own");
  r.form = edit ? Form::Edit : Form::Replay;
  if (automatic) r.form = Form::Auto;
  if (marked) r.form = Form::Mark;
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
  bool edit = false;
  line.argument("model", r.model, "closed model, .ply or .obj");
  line.argument("cameras", r.cameras,
                "cameras in the model's coordinates: COLMAP, Bundler or PMVS");
  line.argument("images", r.images, "folder of the photos");
  line.text("view", r.mark.view, "the photo that is drawn on: its name, or its number in CAMERAS");
  line.text("quad", quad, "corners of the quadrilateral, pixels from the upper left corner");
  line.flag("auto", automatic, "find what repeats on each wall, without any mark");
  line.flag("edit", edit, "find and change windows in an editor");
  line.text("edit-file", r.edit_file,
            "do again what was done in the editor (windows_edit.json); with --edit: go on with it");
  line.number("depth", depth, cli::kAnyNumber,
              "of the panes behind the wall, negative: before it, in the model's unit; not given: "
              "what the photos show, 0 being painted windows, which are not cut");
  line.text("output,o", r.output, "model to write: .ply, .obj, .city.json, .glb, .stl or .vtk");
  if (!line.parse(argc, argv)) return false;
  if (r.images.empty() || r.output.empty()) {
    line.fail("a model, its cameras, the folder of the images, and -o are needed");
  }
  if (line.given("depth")) r.depth = depth;
  chooseForm(line, automatic, edit, quad, r);
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

/// What the program has read.
struct Inputs {
  windows::SolidModel solid;
  io::CameraSet cameras;
  std::vector<storey::FacadePhoto> photos;
};

Inputs read(const Request& request) {
  Inputs inputs;
  inputs.solid = windows::readSolid(request.model);
  inputs.cameras = io::readCameras(request.cameras);
  io::findImages(request.images, inputs.cameras);
  inputs.photos = readPhotos(inputs.cameras);
  return inputs;
}

std::string beside(const std::string& output, const char* name) {
  return std::filesystem::path(output).replace_filename(name).string();
}

std::vector<windows::FoundFacade> findAll(const Request& request,
                                          const windows::WindowSearch& search) {
  std::vector<windows::FoundFacade> found = search.findAll();
  if (found.empty()) {
    throw io::Failure(io::BadInput, request.model, "shows no windows that repeat in the photos",
                      "mark one with --view and --quad");
  }
  for (windows::FoundFacade& facade : found) facade.edit.depth = request.depth;
  return found;
}

/// Cuts what is found into a copy of the model and writes all files.
std::vector<windows::CutWindows> write(const Request& request, const Inputs& inputs,
                                       const std::vector<windows::FoundFacade>& found) {
  windows::SolidModel solid = inputs.solid;
  std::vector<windows::CutWindows> facades;
  for (const windows::FoundFacade& facade : found) {
    facades.push_back(windows::cutInto(solid, facade));
  }
  request.format->write(request.output, {solid.model, solid.to_file, solid.crs});
  windows::writeWindows(beside(request.output, "windows.json"), facades, inputs.cameras,
                        solid.to_file);
  return facades;
}

void edit(const Request& request, const Inputs& inputs, const windows::WindowSearch& search) {
  std::vector<windows::EditorPhoto> photos;
  for (std::size_t k = 0; k < inputs.cameras.photos.size(); ++k) {
    photos.push_back({windows::viewName(inputs.cameras.photos[k]), search.camera(k)});
  }
  std::vector<windows::FoundFacade> start;
  if (!request.edit_file.empty()) {
    start = search.findEach(request.edit_file, windows::readEdit(request.edit_file));
  }
  const windows::WindowFinder finder = {
      [&search](const windows::FacadeEdit& facade) { return search.find(facade); },
      [&search] { return search.findAll(); }};
  const auto save = [&](const windows::WindowEdit& made) {
    const std::string record = beside(request.output, "windows_edit.json");
    windows::writeEdit(record, made);  // first: whatever else fails, it is not lost
    write(request, inputs, search.findEach(record, made));
    return "written: " + request.output + ", " + record;
  };
  windows::EditorWindow(windows::WindowEditor(std::move(photos), finder, std::move(start)),
                        inputs.photos, save, {})
      .run();
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) return io::Ok;
  const Inputs inputs = read(request);
  const windows::WindowSearch search(inputs.solid, request.cameras, inputs.cameras, inputs.photos);
  std::vector<windows::FoundFacade> found;
  switch (request.form) {
    case Form::Edit:
      edit(request, inputs, search);
      return io::Ok;
    case Form::Auto:
      found = findAll(request, search);
      break;
    case Form::Replay:
      found = search.findEach(request.edit_file, windows::readEdit(request.edit_file));
      break;
    default:
      found = search.findEach(request.images, {{request.mark}});
  }
  windows::printWindows(write(request, inputs, found));
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_windows", [&] { return run(argc, argv); });
}
