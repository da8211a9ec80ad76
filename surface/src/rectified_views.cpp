// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/rectified_views.h>

#include <algorithm>

namespace storey::detail {
namespace {

constexpr int kStep = 4;  // texels between the places at which facades in between are looked for

/// Fills the square of side kStep about one such place.
void rectifySquare(const TextureGrid& grid, const TexturePhoto& photo, int left, int top,
                   RectifiedView& view) {
  for (int y = top; y < std::min(top + kStep, grid.height); ++y) {
    for (int x = left; x < std::min(left + kStep, grid.width); ++x) {
      const Eigen::Vector2d place = grid.place(x + 0.5, y + 0.5);
      Sighting sighting;
      if (!isInside(grid.outline, place)) continue;
      if (!sight(photo, grid.frame, grid.frame.point(place.x(), place.y()), sighting)) continue;
      const auto texel = static_cast<std::size_t>(y * grid.width + x);
      const double size = sighting.pixels_per_length * grid.texel;
      view.colors[texel] = photo.pyramid.sample(sighting.pixel, size);
      view.seen[texel] = 1;
    }
  }
}

RectifiedView rectify(const TextureGrid& grid, const FacadeSight& facades,
                      const TexturePhoto& photo) {
  const auto num_texels = static_cast<std::size_t>(grid.width * grid.height);
  RectifiedView view;
  view.colors.assign(num_texels, Eigen::Array3f::Zero());
  view.seen.assign(num_texels, 0);
  std::vector<double> sharpness;
  for (int y = 0; y < grid.height; y += kStep) {
    for (int x = 0; x < grid.width; x += kStep) {
      const Eigen::Vector3d middle = grid.point(x + 0.5 * kStep, y + 0.5 * kStep);
      Sighting sighting;
      if (!sight(photo, grid.frame, middle, sighting)) continue;
      if (facades.isBlocked(photo.center, middle, grid.facade)) continue;
      rectifySquare(grid, photo, x, y, view);
      sharpness.push_back(sighting.pixels_per_length * grid.texel);
    }
  }
  if (sharpness.empty()) return view;
  const auto middle = sharpness.begin() + static_cast<std::ptrdiff_t>(sharpness.size() / 2);
  std::nth_element(sharpness.begin(), middle, sharpness.end());
  view.sharpness = *middle;
  return view;
}

}  // namespace

std::vector<RectifiedView> rectifyViews(const TextureGrid& grid, const FacadeSight& facades,
                                        const std::vector<TexturePhoto>& photos) {
  constexpr double kLeastShare = 0.05;      // of the facade
  constexpr double kLeastSharpness = 0.33;  // of the sharpest: edges of windows are lost beyond
  std::vector<RectifiedView> all(photos.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(photos.size()); ++k) {
    const auto photo = static_cast<std::size_t>(k);
    all[photo] = rectify(grid, facades, photos[photo]);
    all[photo].photo = static_cast<int>(k);
  }
  std::vector<RectifiedView> views;
  for (RectifiedView& view : all) {
    const auto seen = static_cast<double>(std::count(view.seen.begin(), view.seen.end(), 1));
    if (seen >= kLeastShare * grid.width * grid.height) views.push_back(std::move(view));
  }
  double sharpest = 0.0;
  for (const RectifiedView& view : views) sharpest = std::max(sharpest, view.sharpness);
  const auto blurred = [&](const RectifiedView& view) {
    return view.sharpness < kLeastSharpness * sharpest;
  };
  views.erase(std::remove_if(views.begin(), views.end(), blurred), views.end());
  return views;
}

}  // namespace storey::detail
