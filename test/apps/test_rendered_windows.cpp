// SPDX-License-Identifier: BSD-3-Clause
// Windows found in photos of generated buildings against those that were painted.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "synth/buildings.h"
#include "synth/photos/photo_scene.h"

namespace storey::synth {
namespace {

struct Rendered {
  PolyhedralModel model;
  PhotoScene scene;
  std::vector<FacadePhoto> photos;

  Rendered(const char* name, const PhotoOptions& options)
      : model(extrudeFloorplans(makeBuilding(name).layers)), scene(model, options) {
    for (const Camera& camera : scene.placeCameras()) {
      photos.push_back({camera, scene.photograph(camera, static_cast<int>(photos.size()))});
    }
  }
};

struct Score {
  int found = 0;
  int right = 0;
  int painted = 0;
  double worst_corner = 0.0;
};

double overlap(const FacadeWindow& a, const PaintedWindow& b) {
  const Eigen::Vector2d common =
      (a.max.cwiseMin(b.max) - a.min.cwiseMax(b.min)).cwiseMax(0.0);
  const double both = common.prod();
  return both / ((a.max - a.min).prod() + (b.max - b.min).prod() - both);
}

Score scoreOf(const WindowGrid& grid, const std::vector<PaintedWindow>& truth) {
  Score score;
  score.painted = static_cast<int>(truth.size());
  for (const FacadeWindow& window : grid.windows) {
    if (window.doubtful) continue;
    ++score.found;
    for (const PaintedWindow& painted : truth) {
      if (overlap(window, painted) < 0.5) continue;
      ++score.right;
      const double off = std::max((window.min - painted.min).cwiseAbs().maxCoeff(),
                                  (window.max - painted.max).cwiseAbs().maxCoeff());
      score.worst_corner = std::max(score.worst_corner, off / grid.texel);
    }
  }
  return score;
}

/// A mark about the window of a facade that a photo shows largest, drawn loosely.
bool markOn(const Rendered& rendered, std::size_t facade, WindowMark& mark) {
  double largest = 0.0;
  const FacadeFrame& frame = rendered.scene.frames()[facade];
  for (std::size_t k = 0; k < rendered.photos.size(); ++k) {
    for (const PaintedWindow& w : rendered.scene.paints()[facade].windows()) {
      const Eigen::Vector2d slack = 0.05 * (w.max - w.min);
      const Eigen::Vector2d a = w.min - slack;
      const Eigen::Vector2d b = w.max + slack;
      const std::array<Eigen::Vector2d, 4> ring = {a, Eigen::Vector2d(b.x(), a.y()), b,
                                                   Eigen::Vector2d(a.x(), b.y())};
      WindowMark here;
      here.photo = k;
      here.corners.fill(Eigen::Vector2d::Zero());
      bool clear = true;
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector3d point = frame.point(ring[i].x(), ring[i].y());
        clear = clear && rendered.scene.isClear(rendered.photos[k].camera, facade, point);
        if (clear) here.corners[i] = *rendered.photos[k].camera.project(point);
      }
      if (!clear) continue;
      const Eigen::Vector2d u = here.corners[2] - here.corners[0];
      const Eigen::Vector2d v = here.corners[3] - here.corners[1];
      const double area = std::abs(u.x() * v.y() - u.y() * v.x());
      if (area <= largest) continue;
      largest = area;
      mark = here;
    }
  }
  return largest > 0.0;
}

TEST(RenderedWindows, Explore) {
  for (const char* name : {"hexagon", "two_towers"}) {
    for (const double recess : {0.3}) {
      PhotoOptions options;
      options.views = 10;
      options.width = 1024;
      options.recess = recess;
      options.occluders = 6;
      if (std::getenv("PITCH")) options.window_pitch = std::atof(std::getenv("PITCH"));
      const Rendered rendered(name, options);
      for (std::size_t f = 0; f < rendered.scene.facades().size(); ++f) {
        const auto& truth = rendered.scene.paints()[f].windows();
        WindowMark mark;
        if ((f != 2 && f != 6 && f != 7) || truth.size() < 8 || !markOn(rendered, f, mark)) continue;
        const std::clock_t start = std::clock();
        const WindowGrid grid = detectWindows(rendered.scene.facades(), rendered.photos, mark);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        const Score s = scoreOf(grid, truth);
        std::printf("%s %zu: painted %d, windows %zu found %d right %d corner %.2f texels (%.3f) views %zu depth %.3f of %.1f known %d, %.1f s %s\n",
                    name, f, s.painted, grid.windows.size(), s.found, s.right, s.worst_corner, grid.texel,
                    grid.photos.size(), grid.depth, recess, grid.depth_known, seconds,
                    grid.problem.c_str());
      }
    }
  }
}

}  // namespace
}  // namespace storey::synth
