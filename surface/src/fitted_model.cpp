// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/fitted_model.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/face_support.h>

#include <algorithm>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kMaxNoiseRatio = 2.0;  // of the walls' residual to the noise they were found with

}  // namespace

double noiseOfWalls(const std::map<int, WallFit>& walls, double guess) {
  std::vector<std::pair<double, std::size_t>> residuals;
  std::size_t points = 0;
  for (const auto& [id, wall] : walls) {
    if (wall.support == 0) continue;
    residuals.emplace_back(wall.residual, wall.support);
    points += wall.support;
  }
  std::sort(residuals.begin(), residuals.end());
  std::size_t below = 0;
  for (const auto& [residual, support] : residuals) {
    below += support;
    if (2 * below >= points) {
      return std::clamp(residual, guess / kMaxNoiseRatio, guess * kMaxNoiseRatio);
    }
  }
  return guess;
}

void turnPoints(const Eigen::Isometry3d& upright, unsigned int threads, FitPoints& points) {
  const auto work = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3f& p = points.positions[i];
      Eigen::Vector3f& n = points.normals[i];
      p = (upright * p.cast<double>()).cast<float>();
      n = (upright.linear() * n.cast<double>()).cast<float>();
    }
  };
  forEachChunk(points.positions.size(), threads, work);
}

void extrudeFits(const std::vector<FloorplanLayer>& layers, const FitPoints& points, double noise,
                 const LayerwiseModelOptions& options, LayerwiseModel& result) {
  result.model = extrudeFloorplans(layers, options.grid);
  result.check = checkModel(result.model);
  if (result.model.empty()) return;
  measureSupport(points, noise, result.model, options.threads);
  propagateDeviations(result.walls, result.levels, result.model);
}

}  // namespace storey::detail
