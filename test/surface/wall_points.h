// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <cmath>
#include <random>
#include <vector>

/// Points on the walls of stacks of floorplans, for the tests of what is fitted to them.
namespace storey::test {

/// Isotropic noise on positions; normals are exact.
class WallSampler {
 public:
  WallSampler(double noise, unsigned seed) : noise_(0.0, noise), random_(seed) {}

  /// Adds `count` points of the wall over a -> b, the building on its left, between two heights.
  void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double z_min, double z_max,
               std::size_t count, FitPoints& points) {
    const Eigen::Vector2d along = (b - a).normalized();
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d p = a + unit(random_) * (b - a);
      const double z = z_min + unit(random_) * (z_max - z_min);
      points.positions.emplace_back(static_cast<float>(p.x() + noise_(random_)),
                                    static_cast<float>(p.y() + noise_(random_)),
                                    static_cast<float>(z + noise_(random_)));
      points.normals.emplace_back(static_cast<float>(along.y()), static_cast<float>(-along.x()),
                                  0.0F);
    }
  }

  /// All walls of the layers, `density` points per unit of area.
  void addLayers(const std::vector<FloorplanLayer>& layers, double density, FitPoints& points) {
    for (const FloorplanLayer& layer : layers) {
      for (const FloorplanComponent& component : layer.plan.components) {
        addRing(component.outer, layer, density, points);
        for (const FloorplanRing& hole : component.holes) addRing(hole, layer, density, points);
      }
    }
  }

  std::mt19937& random() { return random_; }

 private:
  void addRing(const FloorplanRing& ring, const FloorplanLayer& layer, double density,
               FitPoints& points) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring.vertices[i];
      const Eigen::Vector2d& b = ring.vertices[(i + 1) % ring.size()];
      const double area = (b - a).norm() * (layer.z_max - layer.z_min);
      // A Poisson number, as in a real cloud: heights are fitted to the density.
      std::poisson_distribution<std::size_t> count(density * area);
      addWall(a, b, layer.z_min, layer.z_max, count(random_), points);
    }
  }

  std::normal_distribution<double> noise_;
  std::mt19937 random_;
};

}  // namespace storey::test
