// SPDX-License-Identifier: BSD-3-Clause
#include "synth/buildings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "synth/outlines.h"

namespace storey::synth {
namespace {

constexpr double kDegree = M_PI / 180.0;

// Faces are counted in the comments: an inset adds one wall an edge and the cap around them, a
// moved edge one wall and one cap, a cut corner two walls and one cap.

/// A tower on a regular decagon. Faces: 1 ground + 10 walls; inset: + 10 + 1; one edge moved: + 2;
/// one corner cut: + 3; top: + 1. Together 28.
std::vector<Stage> towerOfTenDirections() {
  const Outline base = regularOutline(10, 12.4, 0.0);
  const Outline shaft = inset(base, 2.9);
  const Outline crown = cutCorner(moveEdge(shaft, 0, 1.2), 5, 2.3, 2.9);
  return turned({{21.3, {{base, {}}}}, {44.6, {{shaft, {}}}}, {62.0, {{crown, {}}}}},
                7.0 * kDegree);
}

/// The rhombus at a corner of an outline, with sides along its two edges.
Outline cornerLeg(const Outline& outline, std::size_t corner, double before, double after) {
  const std::size_t n = outline.size();
  const Eigen::Vector2d at = outline[corner];
  const Eigen::Vector2d to_last = before * (outline[(corner + n - 1) % n] - at).normalized();
  const Eigen::Vector2d to_next = after * (outline[(corner + 1) % n] - at).normalized();
  return {at, at + to_next, at + to_next + to_last, at + to_last};
}

/// Four legs carry a hexagon, inset, split by a street, each half changed again. Faces: 4 grounds +
/// 8 inner walls of legs + 1 ceiling + 6 walls; inset: + 6 + 1; street: + 2 walls + 1 floor;
/// two roofs: + 2; inset of one tower: + 4 + 1; two corners cut of the other: + 6. Together 42.
std::vector<Stage> fourLegs() {
  const Outline body = regularOutline(6, 13.0, 0.0);
  const Outline upper = inset(body, 2.2);
  const Outline east = clipConvex(upper, {-1.0, 0.0}, -1.7);
  const Outline west = clipConvex(upper, {1.0, 0.0}, -1.7);
  std::size_t west_side = 0;  // the edge of the western tower that faces west
  for (std::size_t i = 0; i < west.size(); ++i) {
    const Eigen::Vector2d along = west[(i + 1) % west.size()] - west[i];
    if (std::abs(along.x()) < 1e-9 && along.y() < 0.0) {
      west_side = i;
    }
  }
  const Outline cut_once = cutCorner(west, (west_side + 1) % west.size(), 2.1, 2.6);
  const Outline cut_twice =
      cutCorner(cut_once, west_side + (west_side + 1 == west.size() ? 2 : 0), 2.4, 1.9);
  std::vector<Part> legs;
  for (const std::size_t corner : {0, 1, 3, 4}) {
    legs.push_back({cornerLeg(body, corner, 4.5, 5.2), {}});
  }
  return turned({{13.4, legs},
                 {29.7, {{body, {}}}},
                 {41.2, {{upper, {}}}},
                 {52.6, {{east, {}}, {west, {}}}},
                 {64.0, {{inset(east, 1.6), {}}, {cut_twice, {}}}}},
                11.0 * kDegree);
}

/// A rectangle with two opposite corners cut at 45 degrees. Faces: 1 ground + 6 walls; inset:
/// + 6 + 1; one edge moved and one corner cut: + 2 + 3; one edge moved: + 2; top: + 1. Together 22.
std::vector<Stage> chamferedBlock() {
  const std::vector<double> angles = {0.0, 0.25 * M_PI, 0.5 * M_PI, M_PI, 1.25 * M_PI, 1.5 * M_PI};
  const Outline base = convexOutline(angles, {13.0, 13.5, 10.5, 13.0, 13.5, 10.5});
  const Outline block = inset(base, 2.1);
  const Outline notched = cutCorner(moveEdge(block, 0, 1.5), 3, 3.2, 2.7);
  // The cut corner put two edges behind edge 2, so the last edge is number 7.
  const Outline crown = moveEdge(notched, 7, 1.4);
  return turned(
      {{14.7, {{base, {}}}}, {26.2, {{block, {}}}}, {37.6, {{notched, {}}}}, {46.0, {{crown, {}}}}},
      23.0 * kDegree);
}

std::vector<Stage> towersOnPodium() {
  return {{8.0, {{rectangle(-20.0, -10.0, 20.0, 10.0), {}}}},
          {34.0, {{rectangle(-17.0, -7.0, -5.0, 7.0), {}}, {rectangle(5.0, -7.0, 17.0, 7.0), {}}}}};
}

std::vector<Stage> wideTop() {
  return {{12.0, {{rectangle(-8.0, -8.0, 8.0, 8.0), {}}}},
          {22.0, {{rectangle(-11.0, -8.0, 11.0, 10.5), {}}}}};
}

std::vector<Stage> movedStorey() {
  const Outline plan = rectangle(-10.0, -7.0, 10.0, 7.0);
  return {{12.0, {{plan, {}}}}, {24.0, {{shifted(plan, {0.5, 0.0}), {}}}}};
}

std::vector<Stage> simpleStages(const std::string& name) {
  if (name == "box") {
    return {{24.0, {{rectangle(-10.0, -7.0, 10.0, 7.0), {}}}}};
  }
  if (name == "l_shape") {
    return {{20.0, {{cutCorner(rectangle(-12.0, -12.0, 12.0, 12.0), 2, 13.0, 11.0), {}}}}};
  }
  if (name == "courtyard") {
    return {{18.0, {{rectangle(-15.0, -12.0, 15.0, 12.0), {rectangle(-7.0, -5.0, 6.0, 5.0)}}}}};
  }
  if (name == "two_towers") {
    return towersOnPodium();
  }
  if (name == "hexagon") {
    return {{26.0, {{regularOutline(6, 11.0, 0.1), {}}}}};
  }
  if (name == "overhang") {
    return wideTop();
  }
  if (name == "shifted") {
    return movedStorey();
  }
  if (name == "cylinder") {
    return {{30.0, {{regularOutline(64, 13.0, 0.0), {}}}}};
  }
  return {};
}

}  // namespace

const std::vector<NamedBuilding>& namedBuildings() {
  static const std::vector<NamedBuilding> kNames = {
      {"syn1", "tower, 10 wall directions, 3 floorplan types, 28 polygons, 933,455 points"},
      {"syn2", "four legs, body, two towers: 6 directions, 5 types, 42 polygons, 1,578,415 points"},
      {"syn3", "chamfered block: 6 directions, 4 types, 22 polygons, 1,865,931 points"},
      {"box", "a box"},
      {"l_shape", "an L"},
      {"courtyard", "a rectangle around a courtyard"},
      {"two_towers", "two towers on a podium"},
      {"hexagon", "a regular hexagon"},
      {"overhang", "an upper storey wider than the lower one"},
      {"shifted", "a storey moved by 0.5"},
      {"cylinder", "64 facets around a circle"},
      {"random:SEED", "drawn at random, the same for the same SEED"}};
  return kNames;
}

Building makeBuilding(const std::string& name) {
  const std::string prefix = "random:";
  if (name.rfind(prefix, 0) == 0) {
    std::uint64_t seed = 0;
    const char* const end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + prefix.size(), end, seed);
    const bool valid = parsed.ec == std::errc() && parsed.ptr == end;
    return valid ? Building{name, randomBuilding(seed)} : Building{name, {}};
  }
  if (name == "syn1") {
    return {name, stackStages(towerOfTenDirections()), 933455};
  }
  if (name == "syn2") {
    return {name, stackStages(fourLegs()), 1578415};
  }
  if (name == "syn3") {
    return {name, stackStages(chamferedBlock()), 1865931};
  }
  return {name, stackStages(simpleStages(name))};
}

std::size_t countDirections(const std::vector<FloorplanLayer>& layers, double tolerance) {
  std::vector<Eigen::Vector2d> normals;
  const auto add = [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d along =
          (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).normalized();
      const Eigen::Vector2d normal(along.y(), -along.x());
      const bool known = std::any_of(normals.begin(), normals.end(), [&](const auto& other) {
        return (other - normal).norm() < tolerance;
      });
      if (!known) {
        normals.push_back(normal);
      }
    }
  };
  for (const FloorplanLayer& layer : layers) {
    for (const FloorplanComponent& component : layer.plan.components) {
      add(component.outer);
      std::for_each(component.holes.begin(), component.holes.end(), add);
    }
  }
  return normals.size();
}

}  // namespace storey::synth
