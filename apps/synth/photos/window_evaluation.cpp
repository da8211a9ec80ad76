// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/window_evaluation.h"

#include <algorithm>
#include <cmath>

namespace storey::synth {
namespace {

constexpr double kLeastOverlap = 0.5;  // of the union
constexpr double kSlack = 0.05;        // of the window, between it and the mark

double overlap(const FacadeWindow& a, const PaintedWindow& b) {
  const Eigen::Vector2d common = (a.max.cwiseMin(b.max) - a.min.cwiseMax(b.min)).cwiseMax(0.0);
  const double both = common.prod();
  return both / ((a.max - a.min).prod() + (b.max - b.min).prod() - both);
}

/// A window with its slack in a photo; nothing if a corner is hidden.
std::optional<std::array<Eigen::Vector2d, 4>> cornersIn(const PhotoScene& scene,
                                                        const Camera& camera, std::size_t facade,
                                                        const PaintedWindow& window) {
  const Eigen::Vector2d slack = kSlack * (window.max - window.min);
  const Eigen::Vector2d a = window.min - slack;
  const Eigen::Vector2d b = window.max + slack;
  const std::array<Eigen::Vector2d, 4> ring = {a, Eigen::Vector2d(b.x(), a.y()), b,
                                               Eigen::Vector2d(a.x(), b.y())};
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d point = scene.frames()[facade].point(ring[i].x(), ring[i].y());
    if (!scene.isClear(camera, facade, point)) return std::nullopt;
    corners[i] = *camera.project(point);
  }
  return corners;
}

}  // namespace

void compareWindows(const WindowGrid& grid, const std::vector<PaintedWindow>& painted,
                    WindowMeasures& measures) {
  measures.painted += static_cast<int>(painted.size());
  for (const FacadeWindow& window : grid.windows) {
    if (window.doubtful) continue;
    ++measures.found;
    for (const PaintedWindow& truth : painted) {
      if (overlap(window, truth) < kLeastOverlap) continue;
      ++measures.right;
      const double off = std::max((window.min - truth.min).cwiseAbs().maxCoeff(),
                                  (window.max - truth.max).cwiseAbs().maxCoeff());
      measures.corners.push_back(off / grid.texel);
    }
  }
}

std::optional<WindowMark> markWindow(const PhotoScene& scene, const std::vector<Camera>& cameras,
                                     std::size_t facade) {
  std::optional<WindowMark> mark;
  double largest = 0.0;
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    for (const PaintedWindow& window : scene.paints()[facade].windows()) {
      const auto corners = cornersIn(scene, cameras[k], facade, window);
      if (!corners) continue;
      const Eigen::Vector2d u = (*corners)[2] - (*corners)[0];
      const Eigen::Vector2d v = (*corners)[3] - (*corners)[1];
      const double area = std::abs(u.x() * v.y() - u.y() * v.x());
      if (area <= largest) continue;
      largest = area;
      mark = WindowMark{k, *corners};
    }
  }
  return mark;
}

}  // namespace storey::synth
