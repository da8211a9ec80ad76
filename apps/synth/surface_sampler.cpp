// SPDX-License-Identifier: BSD-3-Clause
#include "synth/surface_sampler.h"

#include <algorithm>
#include <utility>

namespace storey::synth {

using Eigen::Vector2d;
using Eigen::Vector3d;

SurfaceSampler::SurfaceSampler(std::vector<FloorplanLayer> layers, SampledFaces faces)
    : layers_(std::move(layers)) {
  for (const FloorplanLayer& layer : layers_) {
    for (const FloorplanComponent& component : layer.plan.components) {
      addWalls(layer, component.outer);
      for (const FloorplanRing& hole : component.holes) {
        addWalls(layer, hole);
      }
    }
  }
  wall_area_ = area_until_.empty() ? 0.0 : area_until_.back();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    addCaps(i, faces);
  }
}

void SurfaceSampler::addWalls(const FloorplanLayer& layer, const FloorplanRing& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& from = ring.vertices[i];
    const Vector2d& to = ring.vertices[(i + 1) % ring.size()];
    walls_.push_back({from, to, layer.z_min, layer.z_max, ring.edges[i].wall});
    const double area = (to - from).norm() * (layer.z_max - layer.z_min);
    area_until_.push_back(area + (area_until_.empty() ? 0.0 : area_until_.back()));
    box_.extend(Vector3d(from.x(), from.y(), layer.z_min));
    box_.extend(Vector3d(from.x(), from.y(), layer.z_max));
    num_walls_ = std::max(num_walls_, ring.edges[i].wall + 1);
  }
}

void SurfaceSampler::addCaps(std::size_t layer, SampledFaces faces) {
  for (const FloorplanComponent& component : layers_[layer].plan.components) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : component.outer.vertices) {
      box.extend(corner);
    }
    for (const bool faces_up : {true, false}) {
      if (faces == SampledFaces::All || (faces_up && faces == SampledFaces::WallsAndRoofs)) {
        caps_.push_back({layer, Floorplan{{component}}, faces_up, box});
        area_until_.push_back(area_until_.back() + box.volume());
      }
    }
  }
}

SurfaceSample SurfaceSampler::drawOnWall(const WallPatch& wall, Random& random) const {
  const double along = random.uniform();
  const double z = random.uniform(wall.z_min, wall.z_max);
  const Vector2d edge = wall.to - wall.from;
  const Vector2d at = wall.from + along * edge;
  SurfaceSample sample;
  sample.edge_length = edge.norm();
  sample.along = along * sample.edge_length;
  sample.position = Vector3d(at.x(), at.y(), z);
  sample.normal = Vector3d(edge.y(), -edge.x(), 0.0) / sample.edge_length;
  sample.wall = wall.wall;
  return sample;
}

bool SurfaceSampler::drawOnCap(const Cap& cap, Random& random, SurfaceSample& sample) const {
  const double u = random.uniform();
  const double v = random.uniform();
  const Vector2d at = cap.box.min() + Vector2d(u, v).cwiseProduct(cap.box.sizes());
  const FloorplanLayer& layer = layers_[cap.layer];
  const bool at_end = cap.faces_up ? cap.layer + 1 == layers_.size() : cap.layer == 0;
  if (!contains(cap.plan, at) ||
      (!at_end && contains(layers_[cap.faces_up ? cap.layer + 1 : cap.layer - 1].plan, at))) {
    return false;
  }
  sample = SurfaceSample();
  sample.position = Vector3d(at.x(), at.y(), cap.faces_up ? layer.z_max : layer.z_min);
  sample.normal = Vector3d(0.0, 0.0, cap.faces_up ? 1.0 : -1.0);
  return true;
}

SurfaceSample SurfaceSampler::draw(Random& random) const {
  SurfaceSample sample;
  while (true) {
    const double at = random.uniform() * area_until_.back();
    const auto found = std::upper_bound(area_until_.begin(), area_until_.end(), at);
    const auto index =
        static_cast<std::size_t>(std::min(found, area_until_.end() - 1) - area_until_.begin());
    if (index < walls_.size()) {
      return drawOnWall(walls_[index], random);
    }
    if (drawOnCap(caps_[index - walls_.size()], random, sample)) {
      return sample;
    }
  }
}

}  // namespace storey::synth
