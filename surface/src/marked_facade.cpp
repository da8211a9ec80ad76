// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/marked_facade.h>

#include <cmath>
#include <limits>
#include <optional>

namespace storey::detail {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Of the turns at the four corners of a simple quadrilateral at most one goes the other way; of
/// one that crosses itself, two.
bool isSimple(const std::array<Eigen::Vector2d, 4>& corners) {
  int turns = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& at = corners[(i + 1) % 4];
    const double turn = cross(at - corners[i], corners[(i + 2) % 4] - at);
    if (turn == 0.0 || !std::isfinite(turn)) return false;
    turns += turn > 0.0 ? 1 : -1;
  }
  return turns != 0;
}

/// Where a ray meets a facade from its front.
std::optional<double> distanceTo(const Facade& facade, const FacadeFrame& frame,
                                 const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const double slope = facade.normal.dot(direction);
  if (!(slope < 0.0)) return std::nullopt;
  const double distance = facade.normal.dot(frame.origin - from) / slope;
  const bool on =
      distance > 0.0 && isInside(frame.outline(facade), frame.local(from + distance * direction));
  return on ? std::optional<double>(distance) : std::nullopt;
}

}  // namespace

MarkedFacade findMarked(const std::vector<Facade>& facades, const Camera& camera,
                        const WindowMark& mark, const Eigen::Vector3d& vertical) {
  constexpr double kUpright = 0.1;  // of a wall's normal, along the vertical
  MarkedFacade marked;
  const auto fail = [&marked](const char* problem) {
    marked.problem = problem;
    return marked;
  };
  if (!isSimple(mark.corners)) return fail("the quadrilateral crosses itself or has no area");
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : mark.corners) {
    if (!camera.contains(corner)) return fail("the quadrilateral is not inside the photo");
    middle += 0.25 * corner;
  }
  const Eigen::Vector3d eye = camera.center();
  const auto ray = camera.ray(middle);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; ray && f < facades.size(); ++f) {
    const auto distance = distanceTo(facades[f], frameOf(facades[f], vertical), eye, *ray);
    if (!distance || *distance >= nearest) continue;
    nearest = *distance;
    marked.facade = f;
  }
  if (!std::isfinite(nearest)) return fail("the quadrilateral shows no facade of the model");
  const Facade& facade = facades[marked.facade];
  if (std::abs(facade.normal.dot(vertical)) > kUpright) {
    return fail("the quadrilateral shows a roof or floor, not a wall");
  }
  marked.frame = frameOf(facade, vertical);
  for (const Eigen::Vector2d& corner : mark.corners) {
    const auto to_corner = camera.ray(corner);
    const auto distance =
        to_corner ? distanceTo(facade, marked.frame, eye, *to_corner) : std::optional<double>();
    if (!distance) return fail("the quadrilateral reaches beyond the facade under its middle");
    marked.outline.push_back(marked.frame.local(eye + *distance * *to_corner));
  }
  return marked;
}

}  // namespace storey::detail
