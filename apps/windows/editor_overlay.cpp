// SPDX-License-Identifier: BSD-3-Clause
#include "windows/editor_overlay.h"

#include <algorithm>
#include <optional>

namespace storey::windows {
namespace {

/// The part of a segment within a rectangle (Liang and Barsky).
std::optional<Segment> clip(const Segment& segment, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d along = segment.second - segment.first;
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double before = box.min()[axis] - segment.first[axis];
    const double behind = box.max()[axis] - segment.first[axis];
    if (along[axis] == 0.0) {
      if (before > 0.0 || behind < 0.0) return std::nullopt;
      continue;
    }
    enter = std::max(enter, std::min(before / along[axis], behind / along[axis]));
    leave = std::min(leave, std::max(before / along[axis], behind / along[axis]));
  }
  if (enter >= leave) return std::nullopt;
  return Segment{segment.first + enter * along, segment.first + leave * along};
}

/// Collects lines of a photo.
class Overlay {
 public:
  Overlay(const Camera& camera, const PhotoView& view) : camera_(camera), view_(view) {
    const Eigen::Vector2d top_left = view.toWindow({0.0, 0.0});
    const Eigen::Vector2d bottom_right =
        view.toWindow({static_cast<double>(camera.width), static_cast<double>(camera.height)});
    shown_.min() = view.low.cwiseMax(Eigen::Vector2d(top_left.x(), bottom_right.y()));
    shown_.max() = view.high.cwiseMin(Eigen::Vector2d(bottom_right.x(), top_left.y()));
  }

  void add(OverlayLines& lines, const Segment& pixels) const {
    const auto inside = clip({view_.toWindow(pixels.first), view_.toWindow(pixels.second)}, shown_);
    if (inside) lines.segments.push_back(*inside);
  }

  void add(OverlayLines& lines, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const auto from = camera_.project(a);
    const auto to = camera_.project(b);
    if (from && to) add(lines, {*from, *to});
  }

 private:
  const Camera& camera_;
  const PhotoView& view_;
  Eigen::AlignedBox2d shown_;  // of the photo, in the window
};

std::vector<Eigen::Vector3d> cornersOf(const FacadeFrame& frame, const Eigen::AlignedBox2d& box,
                                       double depth) {
  std::vector<Eigen::Vector3d> corners;
  const Eigen::Vector2d& a = box.min();
  const Eigen::Vector2d& b = box.max();
  for (const Eigen::Vector2d& corner :
       {a, Eigen::Vector2d(b.x(), a.y()), b, Eigen::Vector2d(a.x(), b.y())}) {
    corners.push_back(frame.point(corner.x(), corner.y()) - depth * frame.normal());
  }
  return corners;
}

void addFacade(const Overlay& overlay, const FoundFacade& facade, bool current,
               std::vector<OverlayLines>& all) {
  OverlayLines kept{Mark::Kept, current, {}};
  OverlayLines doubtful{Mark::Doubtful, current, {}};
  OverlayLines dropped{Mark::Dropped, current, {}};
  OverlayLines pane{Mark::Pane, current, {}};
  for (const FacadeWindow& window : facade.found.windows) {
    const Eigen::AlignedBox2d box = facade.rectangle(window);
    const auto front = cornersOf(facade.found.frame, box, 0.0);
    const auto back = cornersOf(facade.found.frame, box, facade.depth());
    const bool is_kept = facade.isKept(window);
    OverlayLines& lines = is_kept ? kept : (facade.isDropped(window) ? dropped : doubtful);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      overlay.add(lines, front[i], front[next]);
      if (!is_kept || facade.depth() == 0.0) continue;
      overlay.add(pane, back[i], back[next]);
      overlay.add(pane, front[i], back[i]);
    }
    if (facade.isDropped(window)) {
      overlay.add(dropped, front[0], front[2]);
      overlay.add(dropped, front[1], front[3]);
    }
  }
  for (OverlayLines* lines : {&pane, &kept, &doubtful, &dropped}) {
    if (!lines->segments.empty()) all.push_back(std::move(*lines));
  }
}

}  // namespace

void PhotoView::zoom(double factor, const Eigen::Vector2d& at) {
  const Eigen::Vector2d fixed = toPhoto(at);
  scale *= factor;
  corner += fixed - toPhoto(at);
}

PhotoView PhotoView::whole(const Camera& camera, const Eigen::Vector2d& low,
                           const Eigen::Vector2d& high) {
  PhotoView view;
  const Eigen::Vector2d room = (high - low).cwiseMax(1.0);
  const Eigen::Vector2d size(camera.width, camera.height);
  view.scale = room.cwiseQuotient(size).minCoeff();
  view.low = low;
  view.high = low + room;
  view.corner = 0.5 * (size - room / view.scale);
  return view;
}

std::vector<OverlayLines> overlayOf(const WindowEditor& editor, std::size_t photo,
                                    const PhotoView& view) {
  const Overlay overlay(editor.photos()[photo].camera, view);
  std::vector<OverlayLines> all;
  for (const FoundFacade& facade : editor.facades()) {
    const std::vector<int>& photos = facade.found.photos;
    const bool shown =
        std::find(photos.begin(), photos.end(), static_cast<int>(photo)) != photos.end();
    if (shown) addFacade(overlay, facade, &facade == editor.facade(), all);
  }
  if (photo != editor.photo() || editor.corners().empty()) return all;
  constexpr double kArm = 7.0;  // pixels of the window
  OverlayLines corners{Mark::Corner, true, {}};
  const Eigen::Vector2d* before = nullptr;
  for (const Eigen::Vector2d& corner : editor.corners()) {
    const double arm = kArm / view.scale;
    overlay.add(corners, {corner - Eigen::Vector2d(arm, 0.0), corner + Eigen::Vector2d(arm, 0.0)});
    overlay.add(corners, {corner - Eigen::Vector2d(0.0, arm), corner + Eigen::Vector2d(0.0, arm)});
    if (before != nullptr) overlay.add(corners, {*before, corner});
    before = &corner;
  }
  all.push_back(std::move(corners));
  return all;
}

}  // namespace storey::windows
