// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/flat_face.h>
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace storey {
namespace {

using detail::GridPoint;

/// The wall in plan, on the model's lattice.
struct WallPlan {
  GridPoint a, b;  ///< ends of its chord
  /// Its vertices' `orient` from the chord: rounding keeps none of them exactly on it.
  std::int64_t low = 0;
  std::int64_t high = 0;
  GridPoint shift;  ///< from wall to pane
};

std::int64_t toIndex(double value, double grid) { return std::llround(value / grid); }

WallPlan planOf(const PolyhedralModel& model, const PolyhedralFace& face,
                const Eigen::Vector3d& shift) {
  std::vector<GridPoint> points;
  for (const int v : face.outer) {
    const Eigen::Vector3d& vertex = model.vertices[static_cast<std::size_t>(v)];
    points.push_back({toIndex(vertex.x(), model.grid), toIndex(vertex.y(), model.grid)});
  }
  WallPlan plan;
  std::tie(plan.a, plan.b) = detail::findChord(points);
  for (const GridPoint& p : points) {
    plan.low = std::min(plan.low, detail::orient(plan.a, plan.b, p));
    plan.high = std::max(plan.high, detail::orient(plan.a, plan.b, p));
  }
  plan.shift = {toIndex(shift.x(), model.grid), toIndex(shift.y(), model.grid)};
  return plan;
}

/// The lattice point near a place that lies between the wall's vertices across the wall, or as near
/// to that as there is one; of several the nearest.
GridPoint onWall(const WallPlan& plan, const Eigen::Vector3d& place, double grid) {
  constexpr std::int64_t kReach = 6;  // grid units: some point is 1 / 12 off any line
  const GridPoint middle = {toIndex(place.x(), grid), toIndex(place.y(), grid)};
  GridPoint best = middle;
  auto least = std::make_pair(std::numeric_limits<std::int64_t>::max(), std::int64_t{0});
  for (std::int64_t y = -kReach; y <= kReach; ++y) {
    for (std::int64_t x = -kReach; x <= kReach; ++x) {
      const GridPoint p = middle + GridPoint{x, y};
      const std::int64_t across = detail::orient(plan.a, plan.b, p);
      const std::int64_t off = std::max({std::int64_t{0}, plan.low - across, across - plan.high});
      const auto cost = std::make_pair(off, x * x + y * y);
      if (cost >= least) continue;
      least = cost;
      best = p;
    }
  }
  return best;
}

/// Adds a window's vertices and faces to the model, and its hole to the wall.
class WindowCutter {
 public:
  WindowCutter(PolyhedralModel& model, std::size_t face, const WallPlan& plan, bool from_outside,
               bool inwards)
      : model_(model), face_(face), plan_(plan), from_outside_(from_outside), inwards_(inwards) {}

  void cut(const FacadeFrame& frame, const FacadeWindow& window) {
    GridPoint left = onWall(plan_, frame.point(window.min.x(), window.min.y()), model_.grid);
    GridPoint right = onWall(plan_, frame.point(window.max.x(), window.min.y()), model_.grid);
    if (!from_outside_) std::swap(left, right);
    const std::int64_t foot = toIndex(frame.point(0.0, window.min.y()).z(), model_.grid);
    const std::int64_t head = toIndex(frame.point(0.0, window.max.y()).z(), model_.grid);
    const auto ring = [&](const GridPoint& shift) {  // counter-clockwise seen from outside
      return std::vector<int>{addVertex(left + shift, foot), addVertex(right + shift, foot),
                              addVertex(right + shift, head), addVertex(left + shift, head)};
    };
    const std::vector<int> wall = ring({0, 0});
    const std::vector<int> pane = ring(plan_.shift);
    model_.faces[face_].inner.push_back({wall[0], wall[3], wall[2], wall[1]});
    addFace(pane, FaceLabel::Wall, WindowPart::Pane);
    const FaceLabel sill = inwards_ ? FaceLabel::Roof : FaceLabel::Ceiling;
    const FaceLabel lintel = inwards_ ? FaceLabel::Ceiling : FaceLabel::Roof;
    const FaceLabel labels[] = {sill, FaceLabel::Wall, lintel, FaceLabel::Wall};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      addFace({wall[i], wall[next], pane[next], pane[i]}, labels[i], WindowPart::Reveal);
    }
  }

 private:
  int addVertex(const GridPoint& plan, std::int64_t height) {
    model_.vertices.emplace_back(static_cast<double>(plan.x) * model_.grid,
                                 static_cast<double>(plan.y) * model_.grid,
                                 static_cast<double>(height) * model_.grid);
    if (!model_.covariances.empty()) {  // no points tell of it
      const Eigen::Vector3d unknown =
          Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
      model_.covariances.emplace_back(unknown.asDiagonal());
    }
    return static_cast<int>(model_.vertices.size()) - 1;
  }

  void addFace(const std::vector<int>& ring, FaceLabel label, WindowPart part) {
    PolyhedralFace face;
    face.outer = ring;
    face.label = label;
    face.window = part;
    face.shell = model_.faces[face_].shell;
    model_.faces.push_back(face);
  }

  PolyhedralModel& model_;
  std::size_t face_;
  const WallPlan& plan_;
  bool from_outside_;
  bool inwards_;
};

/// Cuts windows[first, last), all or, if the model would not be valid, each half on its own.
template <typename Cut>
void cutValid(PolyhedralModel& model, std::size_t first, std::size_t last, const Cut& cut,
              std::vector<bool>& done) {
  if (first == last) return;
  PolyhedralModel candidate = model;
  for (std::size_t i = first; i < last; ++i) cut(candidate, i);
  if (checkModel(candidate).ok()) {
    model = std::move(candidate);
    std::fill(done.begin() + static_cast<std::ptrdiff_t>(first),
              done.begin() + static_cast<std::ptrdiff_t>(last), true);
    return;
  }
  if (last - first == 1) return;
  const std::size_t middle = (first + last) / 2;
  cutValid(model, first, middle, cut, done);
  cutValid(model, middle, last, cut, done);
}

}  // namespace

std::vector<bool> cutWindows(PolyhedralModel& model, std::size_t face, const FacadeFrame& frame,
                             const std::vector<FacadeWindow>& windows, double depth) {
  constexpr double kLeastDepth = 4.0;  // grid units
  std::vector<bool> done(windows.size(), false);
  if (face >= model.faces.size() || model.faces[face].label != FaceLabel::Wall ||
      !checkModel(model).ok()) {
    PCL_ERROR("[storey::cutWindows] the model is not valid, or its face %zu is no wall.\n", face);
    return done;
  }
  if (!(std::abs(depth) >= kLeastDepth * model.grid)) return done;
  const bool from_outside = facadesOf(model)[face].normal.dot(frame.normal()) > 0.0;
  const WallPlan plan = planOf(model, model.faces[face], -depth * frame.normal());
  const auto cut = [&](PolyhedralModel& into, std::size_t i) {
    WindowCutter(into, face, plan, from_outside, from_outside == (depth > 0.0))
        .cut(frame, windows[i]);
  };
  cutValid(model, 0, windows.size(), cut, done);
  return done;
}

}  // namespace storey
