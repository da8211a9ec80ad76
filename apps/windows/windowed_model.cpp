// SPDX-License-Identifier: BSD-3-Clause
#include "windows/windowed_model.h"

#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "io/failure.h"
#include "io/model_io.h"
#include "synth/polygon_mesh.h"
#include "synth/rebuilt_model.h"
#include "texture/textured_model.h"

namespace storey::windows {
namespace {

/// Photos in the model's frame: what takes its points to the file's goes before the camera.
std::vector<FacadePhoto> inFrame(std::vector<FacadePhoto> photos,
                                 const Eigen::Isometry3d& to_file) {
  for (FacadePhoto& photo : photos) {
    photo.camera.world_to_camera = photo.camera.world_to_camera * to_file;
  }
  return photos;
}

}  // namespace

SolidModel readSolid(const std::string& path) {
  const io::PolygonSoup soup = io::readPolygons(path);
  const Eigen::Vector3d up = synth::upOfModel(soup);
  const synth::PolygonMesh mesh = synth::measurable(soup);
  SolidModel solid;
  solid.crs = soup.crs;
  if (!soup.vertices.empty() && mesh.num_broken == 0) {
    solid.model = synth::rebuildModel(soup, mesh, up);
    solid.to_file = synth::rebuiltToFile(soup, up);
  }
  const ModelCheck check = checkModel(solid.model);
  if (!check.ok()) {
    throw io::Failure(io::BadInput, path, "is no valid solid: " + check.problems.front(),
                      "reconstruct the model again");
  }
  return solid;
}

std::size_t findView(const std::string& path, const io::CameraSet& cameras,
                     const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < cameras.photos.size(); ++k) {
    const io::Photo& photo = cameras.photos[k];
    const std::filesystem::path file = photo.name.empty() ? photo.image : photo.name;
    const bool is_it = file.string() == name || file.filename() == name || file.stem() == name ||
                       std::to_string(photo.index) == name;
    if (is_it) found.push_back(k);
  }
  if (found.size() == 1) return found[0];
  throw io::Failure(io::BadInput, path,
                    (found.empty() ? "has no view '" : "has several views '") + name + "'",
                    "see storey_cameras for their names");
}

std::string viewName(const io::Photo& photo) {
  return photo.name.empty() ? std::to_string(photo.index) : photo.name;
}

std::optional<std::array<Eigen::Vector2d, 4>> parseQuad(const std::string& text) {
  std::array<Eigen::Vector2d, 4> corners;
  const char* at = text.c_str();
  for (int i = 0; i < 8; ++i) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || !std::isfinite(value) || *end != (i < 7 ? ',' : '\0')) return std::nullopt;
    corners[static_cast<std::size_t>(i / 2)][i % 2] = value;
    at = end + 1;
  }
  return corners;
}

WindowSearch::WindowSearch(const SolidModel& solid, std::string cameras_path,
                           const io::CameraSet& cameras, const std::vector<FacadePhoto>& photos)
    : cameras_path_(std::move(cameras_path)), cameras_(cameras) {
  const std::vector<FacadePhoto> upright = inFrame(photos, solid.to_file);
  for (const FacadePhoto& photo : upright) cameras_in_frame_.push_back(photo.camera);
  std::vector<Facade> facades = facadesOf(solid.model);
  texture::turnToCameras(upright, facades);
  detection_ = std::make_unique<WindowDetection>(std::move(facades), upright);
}

WindowGrid WindowSearch::find(const FacadeEdit& facade) const {
  if (!facade.isMarked()) return detection_->propose(facade.facade);
  return detection_->detect({findView(cameras_path_, cameras_, facade.view), facade.quad});
}

std::vector<FoundFacade> WindowSearch::findAll() const {
  std::vector<FoundFacade> all;
  for (std::size_t f = 0; f < detection_->facades().size(); ++f) {
    FoundFacade facade;
    facade.edit.facade = f;
    facade.found = find(facade.edit);
    if (!facade.found.windows.empty()) all.push_back(std::move(facade));
  }
  return all;
}

std::vector<FoundFacade> WindowSearch::findEach(const std::string& path,
                                                const WindowEdit& edit) const {
  std::vector<FoundFacade> all;
  for (const FacadeEdit& facade : edit.facades) {
    const FoundFacade found = {facade, find(facade)};
    const std::string of =
        facade.isMarked() ? "view " + facade.view : "facade " + std::to_string(facade.facade);
    if (!found.found.problem.empty()) {
      throw io::Failure(io::BadInput, path, of + ": " + found.found.problem,
                        "draw the quadrilateral around a window on one wall");
    }
    const auto& windows = found.found.windows;
    for (const WindowChange& change : facade.changes) {
      const bool is_there =
          std::any_of(windows.begin(), windows.end(),
                      [&change](const FacadeWindow& window) { return change.isOf(window); });
      if (is_there) continue;
      throw io::Failure(io::BadInput, path,
                        of + ": no window was found in row " + std::to_string(change.row) +
                            ", column " + std::to_string(change.column),
                        "use the model and the photos that were edited");
    }
    all.push_back(found);
  }
  return all;
}

CutWindows cutInto(SolidModel& solid, const FoundFacade& facade) {
  CutWindows result;
  result.grid = facade.changed();
  result.depth = facade.depth();
  result.cut.assign(result.grid.windows.size(), false);
  std::vector<FacadeWindow> clear;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < result.grid.windows.size(); ++i) {
    if (result.grid.windows[i].doubtful) continue;
    clear.push_back(result.grid.windows[i]);
    index.push_back(i);
  }
  if (clear.empty()) return result;
  const std::vector<bool> cut =
      cutWindows(solid.model, result.grid.facade, result.grid.frame, clear, result.depth);
  for (std::size_t i = 0; i < cut.size(); ++i) result.cut[index[i]] = cut[i];
  return result;
}

}  // namespace storey::windows
