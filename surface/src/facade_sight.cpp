// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/facade_sight.h>
#include <storey/surface/facade_texturing.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace storey::detail {
namespace {

constexpr std::size_t kLeafSize = 2;

bool entersBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
               const Eigen::Vector3d& direction, double end) {
  double enter = 0.0;
  double leave = end;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) return false;
      continue;
    }
    const double a = (box.min()[axis] - from[axis]) / direction[axis];
    const double b = (box.max()[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

}  // namespace

FacadeSight::FacadeSight(const std::vector<Facade>& facades) {
  for (const Facade& facade : facades) {
    Flat flat;
    flat.frame = frameOf(facade);
    flat.outline = flat.frame.outline(facade);
    for (const auto& ring : facade.rings) {
      for (const Eigen::Vector3d& corner : ring) flat.box.extend(corner);
    }
    // Level and axis-parallel facades have flat boxes: rounding must not let rays slip past.
    const double margin = 1e-9 * flat.box.sizes().maxCoeff();
    flat.box.min().array() -= margin;
    flat.box.max().array() += margin;
    flats_.push_back(std::move(flat));
  }
  order_.resize(flats_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) build(0, order_.size());
}

std::size_t FacadeSight::build(std::size_t first, std::size_t last) {
  const std::size_t id = nodes_.size();
  nodes_.push_back({Eigen::AlignedBox3d(), first, last, 0});
  for (std::size_t i = first; i < last; ++i) nodes_[id].box.extend(flats_[order_[i]].box);
  if (last - first <= kLeafSize) return id;
  Eigen::Index axis = 0;
  nodes_[id].box.sizes().maxCoeff(&axis);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
    return std::make_pair(flats_[a].box.center()[axis], a) <
           std::make_pair(flats_[b].box.center()[axis], b);
  });
  build(first, middle);
  const std::size_t right = build(middle, last);
  nodes_[id].right = right;
  return id;
}

bool FacadeSight::meets(const Flat& flat, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& direction, double end) const {
  const Eigen::Vector3d normal = flat.frame.normal();
  const double approach = normal.dot(direction);
  if (approach == 0.0) return false;
  const double at = normal.dot(flat.frame.origin - from) / approach;
  return at > 0.0 && at < end && isInside(flat.outline, flat.frame.local(from + at * direction));
}

template <typename Visit>
bool FacadeSight::walk(std::size_t node, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& direction, double end, const Visit& visit) const {
  const Node& here = nodes_[node];
  if (!entersBox(here.box, from, direction, end)) return false;
  if (here.right > 0) {
    return walk(node + 1, from, direction, end, visit) ||
           walk(here.right, from, direction, end, visit);
  }
  for (std::size_t i = here.first; i < here.last; ++i) {
    const std::size_t facade = order_[i];
    if (meets(flats_[facade], from, direction, end) && visit(facade)) return true;
  }
  return false;
}

bool FacadeSight::isBlocked(const Eigen::Vector3d& eye, const Eigen::Vector3d& point,
                            std::size_t own) const {
  constexpr double kBefore = 1.0 - 1e-9;  // of the way: neighbours touch the facade at its edges
  return !nodes_.empty() &&
         walk(0, eye, point - eye, kBefore, [own](std::size_t facade) { return facade != own; });
}

int FacadeSight::countCrossings(const Eigen::Vector3d& from,
                                const Eigen::Vector3d& direction) const {
  int count = 0;
  const auto counting = [&count](std::size_t) {
    ++count;
    return false;
  };
  if (!nodes_.empty()) {
    walk(0, from, direction, std::numeric_limits<double>::infinity(), counting);
  }
  return count;
}

}  // namespace storey::detail

namespace storey {

bool isEnclosed(const std::vector<Facade>& facades, const Eigen::Vector3d& point) {
  // An odd direction, so that no ray runs along an edge of a real building.
  const Eigen::Vector3d direction(0.1372, 0.2089, 0.9683);
  return detail::FacadeSight(facades).countCrossings(point, direction) % 2 == 1;
}

}  // namespace storey
