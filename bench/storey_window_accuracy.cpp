// SPDX-License-Identifier: BSD-3-Clause
// How well windows are found in photos of generated buildings: with a mark on each facade, and
// without any. Prints tables in Markdown; a line for each facade goes to stderr.
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "bench/markdown.h"
#include "cli/command_line.h"
#include "synth/photos/rendered_building.h"
#include "synth/photos/window_evaluation.h"

namespace {

using storey::bench::fixed;
namespace synth = storey::synth;

/// A building, and how deep its windows are.
struct Case {
  std::string building;
  double recess = 0.0;
};

/// What one way of finding windows is worth on one building.
struct Row {
  synth::WindowMeasures windows;
  double depth_error = 0.0;  // worst of the facades whose depth was told
  std::size_t depths = 0;    // told
  std::size_t facades = 0;
  bool valid = false;
  double seconds = 0.0;  // of processor time, for all facades
};

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void addFacade(const synth::Rendered& rendered, const Case& of, std::size_t facade,
               const storey::WindowGrid& grid, storey::PolyhedralModel& model, Row& row) {
  const auto& painted = rendered.scene.paints()[facade].windows();
  const int found_before = row.windows.found;
  const int right_before = row.windows.right;
  synth::compareWindows(grid, painted, row.windows);
  double worst = 0.0;
  for (std::size_t i = static_cast<std::size_t>(right_before); i < row.windows.corners.size();
       ++i) {
    worst = std::max(worst, row.windows.corners[i]);
  }
  std::fprintf(stderr,
               "%s %g facade %zu: %zu painted, %d found, %d right, corners %.2f, depth %.3f%s %s\n",
               of.building.c_str(), of.recess, facade, painted.size(),
               row.windows.found - found_before, row.windows.right - right_before, worst,
               grid.depth, grid.depth_known ? "" : " unknown", grid.problem.c_str());
  if (grid.windows.empty()) return;
  ++row.facades;
  if (grid.depth_known) {
    ++row.depths;
    row.depth_error = std::max(row.depth_error, std::abs(grid.depth - of.recess));
  }
  std::vector<storey::FacadeWindow> clear;
  for (const storey::FacadeWindow& window : grid.windows) {
    if (!window.doubtful) clear.push_back(window);
  }
  storey::cutWindows(model, facade, grid.frame, clear, of.recess);
}

/// With a mark on each facade, or with none at all.
Row measure(const synth::Rendered& rendered, const Case& of, bool marked) {
  const std::vector<storey::Camera> cameras = rendered.scene.placeCameras();
  Row row;
  storey::PolyhedralModel model = rendered.model;
  const double start = processorSeconds();
  const storey::WindowDetection detection(rendered.scene.facades(), rendered.photos);
  row.seconds = processorSeconds() - start;
  for (std::size_t f = 0; f < rendered.scene.facades().size(); ++f) {
    const auto mark = markWindow(rendered.scene, cameras, f);
    if (marked && !mark) {
      row.windows.painted += static_cast<int>(rendered.scene.paints()[f].windows().size());
      continue;
    }
    const double begin = processorSeconds();
    const storey::WindowGrid grid = marked ? detection.detect(*mark) : detection.propose(f);
    row.seconds += processorSeconds() - begin;
    addFacade(rendered, of, f, grid, model, row);
  }
  row.valid = checkModel(model).ok();
  return row;
}

void addRow(const Case& of, const char* form, const Row& row, storey::bench::Table& table) {
  std::vector<double> corners = row.windows.corners;
  std::sort(corners.begin(), corners.end());
  const auto quantile = [&](double share) {
    if (corners.empty()) return std::string("-");
    const auto last = static_cast<double>(corners.size() - 1);
    return fixed(corners[static_cast<std::size_t>(share * last)], 2);
  };
  table.add({of.building, fixed(of.recess, 1), form, std::to_string(row.windows.painted),
             fixed(row.windows.precision(), 3), fixed(row.windows.recall(), 3), quantile(0.5),
             quantile(1.0), storey::bench::ofCount(row.depths, row.facades),
             fixed(row.depth_error, 3), row.valid ? "yes" : "no",
             fixed(row.seconds / std::max(1.0, static_cast<double>(row.facades)), 1)});
}

int run(int argc, char** argv) {
  std::vector<std::string> buildings;
  synth::PhotoOptions options;
  options.views = 10;
  options.width = 800;
  options.occluders = 6;
  storey::cli::CommandLine line("storey_window_accuracy", {"[BUILDING...] [options]"},
                                "How well windows are found in rendered photos of buildings.");
  line.arguments("buildings", buildings, "names that storey_synth knows");
  line.whole("views", options.views, 2, "photos of each building");
  line.whole("photo-width", options.width, 16, "pixels");
  if (!line.parse(argc, argv)) return 0;
  if (buildings.empty()) buildings = {"box", "l_shape", "hexagon", "overhang", "random:8"};
  storey::bench::Table table({"building", "depth", "form", "windows", "precision", "recall",
                              "corners, median", "worst", "depths told", "worst depth", "valid",
                              "s a facade"});
  for (const std::string& building : buildings) {
    for (const double recess : {0.0, 0.3}) {
      options.recess = recess;
      const synth::Rendered rendered(building.c_str(), options);
      for (const bool marked : {true, false}) {
        const Case of{building, recess};
        addRow(of, marked ? "mark" : "auto", measure(rendered, of, marked), table);
      }
    }
  }
  table.print();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_window_accuracy", [&] { return run(argc, argv); });
}
