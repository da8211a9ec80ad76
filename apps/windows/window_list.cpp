// SPDX-License-Identifier: BSD-3-Clause
#include "windows/window_list.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/output_file.h"

namespace storey::windows {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json toJson(const CutWindows& facade, const io::CameraSet& cameras,
            const Eigen::Isometry3d& to_file) {
  const WindowGrid& grid = facade.grid;
  Json photos = Json::array();
  for (const int photo : grid.photos) {
    photos.push_back(viewName(cameras.photos[static_cast<std::size_t>(photo)]));
  }
  Json windows = Json::array();
  for (std::size_t i = 0; i < grid.windows.size(); ++i) {
    const FacadeWindow& w = grid.windows[i];
    windows.push_back({{"row", w.row},
                       {"column", w.column},
                       {"rectangle", {w.min.x(), w.min.y(), w.max.x(), w.max.y()}},
                       {"confidence", w.confidence},
                       {"state", stateOf(facade, i)}});
  }
  return {{"facade", grid.facade},
          {"origin", toJson(to_file * grid.frame.origin)},
          {"right", toJson(to_file.linear() * grid.frame.right)},
          {"up", toJson(to_file.linear() * grid.frame.up)},
          {"width", grid.frame.width},
          {"height", grid.frame.height},
          {"texel", grid.texel},
          {"photos", photos},
          {"depth", facade.depth},
          {"depth_in_photos", grid.depth_known ? Json(grid.depth) : Json()},
          {"windows", windows}};
}

void print(const CutWindows& facade) {
  const WindowGrid& grid = facade.grid;
  std::printf("%6s %6s %10s %10s %10s %10s %10s\n", "row", "column", "left", "foot", "width",
              "height", "confidence");
  for (std::size_t i = 0; i < grid.windows.size(); ++i) {
    const FacadeWindow& w = grid.windows[i];
    const Eigen::Vector2d size = w.max - w.min;
    std::printf("%6d %6d %10.4g %10.4g %10.4g %10.4g %10.2f %s\n", w.row, w.column, w.min.x(),
                w.min.y(), size.x(), size.y(), w.confidence, stateOf(facade, i));
  }
  std::printf("facade %zu, %zu photos: %zu windows, %td cut, depth %.4g%s\n", grid.facade,
              grid.photos.size(), grid.windows.size(),
              std::count(facade.cut.begin(), facade.cut.end(), true), facade.depth,
              facade.depth != 0.0 ? ""
              : grid.depth_known  ? " (painted)"
                                  : " (not known: --depth)");
}

}  // namespace

const char* stateOf(const CutWindows& facade, std::size_t window) {
  if (facade.cut[window]) return "cut";
  if (facade.grid.windows[window].doubtful) return "doubtful";
  return facade.depth == 0.0 ? "no depth" : "does not fit";
}

void writeWindows(const std::string& path, const std::vector<CutWindows>& facades,
                  const io::CameraSet& cameras, const Eigen::Isometry3d& to_file) {
  Json list = Json::array();
  for (const CutWindows& facade : facades) list.push_back(toJson(facade, cameras, to_file));
  io::OutputFile file(path);
  file.write(Json{{"facades", list}}.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

void printWindows(const std::vector<CutWindows>& facades) {
  for (const CutWindows& facade : facades) print(facade);
}

}  // namespace storey::windows
