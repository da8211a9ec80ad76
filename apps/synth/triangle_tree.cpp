// SPDX-License-Identifier: BSD-3-Clause
#include "synth/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace storey::synth {
namespace {

constexpr std::size_t kLeafSize = 4;

/// Where a ray enters a box; infinite if it misses it.
double entry(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
             const Eigen::Vector3d& direction) {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      const bool beside = from[axis] < box.min()[axis] || from[axis] > box.max()[axis];
      if (beside) return std::numeric_limits<double>::infinity();
      continue;
    }
    const double a = (box.min()[axis] - from[axis]) / direction[axis];
    const double b = (box.max()[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

/// Where a ray meets a triangle (Moeller and Trumbore); infinite if it does not.
double meeting(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
               const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double infinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d across = direction.cross(ac);
  const double volume = ab.dot(across);
  if (volume == 0.0) return infinite;
  const Eigen::Vector3d from_a = from - a;
  const double u = from_a.dot(across) / volume;
  const Eigen::Vector3d turned = from_a.cross(ab);
  const double v = direction.dot(turned) / volume;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return infinite;
  const double distance = ac.dot(turned) / volume;
  return distance > 0.0 ? distance : infinite;
}

}  // namespace

TriangleTree::TriangleTree(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    Eigen::AlignedBox3d box(mesh_.corner(t, 0));
    box.extend(mesh_.corner(t, 1)).extend(mesh_.corner(t, 2));
    boxes.push_back(box);
  }
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) {
    build(0, order_.size(), boxes);
  }
}

std::size_t TriangleTree::build(std::size_t first, std::size_t last,
                                const std::vector<Eigen::AlignedBox3d>& boxes) {
  const std::size_t id = nodes_.size();
  nodes_.push_back({Eigen::AlignedBox3d(), first, last, 0});
  for (std::size_t i = first; i < last; ++i) {
    nodes_[id].box.extend(boxes[order_[i]]);
  }
  if (last - first > kLeafSize) {
    Eigen::Index axis = 0;
    nodes_[id].box.sizes().maxCoeff(&axis);
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
      const double center_a = boxes[a].center()[axis];
      const double center_b = boxes[b].center()[axis];
      return std::make_pair(center_a, a) < std::make_pair(center_b, b);
    });
    build(first, middle, boxes);
    nodes_[id].right = build(middle, last, boxes);
  }
  return id;
}

void TriangleTree::search(std::size_t node, const Eigen::Vector3d& point, double& best) const {
  const Node& here = nodes_[node];
  if (here.box.exteriorDistance(point) >= best) {
    return;
  }
  if (here.right == 0) {
    for (std::size_t i = here.first; i < here.last; ++i) {
      const std::size_t t = order_[i];
      best = std::min(best, distanceToTriangle(point, mesh_.corner(t, 0), mesh_.corner(t, 1),
                                               mesh_.corner(t, 2)));
    }
    return;
  }
  std::size_t near = node + 1;
  std::size_t far = here.right;
  if (nodes_[far].box.squaredExteriorDistance(point) <
      nodes_[near].box.squaredExteriorDistance(point)) {
    std::swap(near, far);
  }
  search(near, point, best);
  search(far, point, best);
}

double TriangleTree::distance(const Eigen::Vector3d& point, double reach) const {
  double best = reach;
  if (!nodes_.empty()) {
    search(0, point, best);
  }
  return best < reach ? best : kAnywhere;
}

std::vector<double> TriangleTree::distances(const std::vector<Eigen::Vector3d>& points,
                                            double reach) const {
  std::vector<double> result(points.size());
  const auto count = static_cast<std::ptrdiff_t>(points.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    result[static_cast<std::size_t>(i)] = distance(points[static_cast<std::size_t>(i)], reach);
  }
  return result;
}

void TriangleTree::search(std::size_t node, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& direction, Hit& best) const {
  const Node& here = nodes_[node];
  if (!(entry(here.box, from, direction) < best.distance)) {
    return;
  }
  if (here.right > 0) {
    search(node + 1, from, direction, best);
    search(here.right, from, direction, best);
    return;
  }
  for (std::size_t i = here.first; i < here.last; ++i) {
    const std::size_t t = order_[i];
    const double distance =
        meeting(from, direction, mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2));
    if (distance < best.distance) best = {t, distance};
  }
}

std::optional<TriangleTree::Hit> TriangleTree::firstHit(const Eigen::Vector3d& from,
                                                        const Eigen::Vector3d& direction) const {
  Hit best;
  if (!nodes_.empty()) {
    search(0, from, direction, best);
  }
  if (best.distance == std::numeric_limits<double>::infinity()) {
    return std::nullopt;
  }
  return best;
}

}  // namespace storey::synth
