// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/texture_views.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kMinCosine = 0.1;  // 6 degrees from grazing: little but smear beyond

/// Middle of a block's cell, in texels.
Eigen::Vector2d cellMiddle(int column, int row, int cell) {
  return kBlockTexels *
         Eigen::Vector2d(column + 0.25 + 0.5 * (cell % 2), row + 0.25 + 0.5 * (cell / 2));
}

/// Mean colour of a cell about a sighting: 2 x 2 samples, for a photo that looks at an angle has a
/// cell's pixels in an oblong, which no one sample covers.
Eigen::Array3f cellColor(const TextureGrid& grid, const TexturePhoto& photo,
                         const Eigen::Vector3d& point, const Sighting& sighting) {
  constexpr double kHalfStep = 0.125 * kBlockTexels;  // texels: a quarter of a cell
  const double length = kHalfStep * grid.texel;
  const auto beside = photo.camera.project(point + length * grid.frame.right);
  const auto above = photo.camera.project(point + length * grid.frame.up);
  const double pixels = 2.0 * length * sighting.pixels_per_length;
  if (!beside || !above) return photo.pyramid.sample(sighting.pixel, pixels);
  const Eigen::Vector2d across = *beside - sighting.pixel;
  const Eigen::Vector2d upwards = *above - sighting.pixel;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (const double u : {-1.0, 1.0}) {
    for (const double v : {-1.0, 1.0}) {
      sum += photo.pyramid.sample(sighting.pixel + u * across + v * upwards, pixels);
    }
  }
  return 0.25f * sum;
}

/// Cells of a block that are on the facade; all of them if the facade only grazes the block; none
/// if it misses it.
std::array<bool, kCells> cellsOnFacade(const TextureGrid& grid, int column, int row) {
  std::array<bool, kCells> on{};
  bool any = false;
  for (int cell = 0; cell < kCells; ++cell) {
    const Eigen::Vector2d middle = cellMiddle(column, row, cell);
    any |= on[static_cast<std::size_t>(cell)] =
        isInside(grid.outline, grid.place(middle.x(), middle.y()));
  }
  for (int i = 0; !any && i < kBlockTexels * kBlockTexels; ++i) {
    const int x = column * kBlockTexels + i % kBlockTexels;
    const int y = row * kBlockTexels + i / kBlockTexels;
    if (isInside(grid.outline, grid.place(x + 0.5, y + 0.5))) {
      on.fill(true);
      break;
    }
  }
  return on;
}

BlockView viewBlock(const TextureGrid& grid, const FacadeSight& facades, const TexturePhoto& photo,
                    const std::array<bool, kCells>& on, int column, int row) {
  BlockView view;
  int num_on = 0;
  for (int cell = 0; cell < kCells; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    if (!on[c]) continue;
    ++num_on;
    const Eigen::Vector2d middle = cellMiddle(column, row, cell);
    const Eigen::Vector3d point = grid.point(middle.x(), middle.y());
    Sighting sighting;
    if (!sight(photo, grid.frame, point, sighting)) continue;
    if (facades.isBlocked(photo.center, point, grid.facade)) continue;
    view.shown[c] = true;
    const double pixels = sighting.pixels_per_length * grid.texel;
    view.colors[c] = cellColor(grid, photo, point, sighting);
    view.quality += static_cast<float>(sighting.cosine * std::min(1.0, pixels));
  }
  view.quality /= static_cast<float>(std::max(num_on, 1));
  return view;
}

}  // namespace

TextureGrid::TextureGrid(std::size_t index, const FacadeFrame& f, const FacadeOutline& o,
                         double size)
    : facade(index), frame(f), outline(o), texel(size) {
  width = std::max(1, static_cast<int>(std::ceil(frame.width / texel)));
  height = std::max(1, static_cast<int>(std::ceil(frame.height / texel)));
  columns = (width + kBlockTexels - 1) / kBlockTexels;
  rows = (height + kBlockTexels - 1) / kBlockTexels;
}

int BlockView::numShown() const {
  return static_cast<int>(std::count(shown.begin(), shown.end(), true));
}

bool sight(const TexturePhoto& photo, const FacadeFrame& frame, const Eigen::Vector3d& point,
           Sighting& sighting) {
  const Eigen::Vector3d to_eye = photo.center - point;
  const double distance = to_eye.norm();
  sighting.cosine = to_eye.dot(frame.normal()) / distance;
  if (!(sighting.cosine > kMinCosine)) return false;
  const auto pixel = photo.camera.project(point);
  if (!pixel || !photo.camera.contains(*pixel)) return false;
  sighting.pixel = *pixel;
  sighting.pixels_per_length = photo.camera.focal.mean() / distance * sighting.cosine;
  return true;
}

std::vector<std::vector<BlockView>> findViews(const TextureGrid& grid, const FacadeSight& facades,
                                              const std::vector<TexturePhoto>& photos) {
  std::vector<std::vector<BlockView>> views(grid.numBlocks());
#pragma omp parallel for schedule(dynamic, 1)
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      auto& here = views[grid.block(column, row)];
      const std::array<bool, kCells> on = cellsOnFacade(grid, column, row);
      if (std::none_of(on.begin(), on.end(), [](bool b) { return b; })) continue;
      for (std::size_t k = 0; k < photos.size(); ++k) {
        BlockView view = viewBlock(grid, facades, photos[k], on, column, row);
        view.photo = static_cast<int>(k);
        if (view.numShown() > 0) here.push_back(view);
      }
    }
  }
  return views;
}

double resolvedTexel(const FacadeFrame& frame, const FacadeOutline& outline, std::size_t facade,
                     const FacadeSight& facades, const std::vector<TexturePhoto>& photos) {
  constexpr int kSamples = 16;  // in each direction
  std::vector<double> texels;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const Eigen::Vector2d place((i % kSamples + 0.5) / kSamples * frame.width,
                                (i / kSamples + 0.5) / kSamples * frame.height);
    if (!isInside(outline, place)) continue;
    const Eigen::Vector3d point = frame.point(place.x(), place.y());
    double best = 0.0;
    for (const TexturePhoto& photo : photos) {
      Sighting sighting;
      const bool sharper =
          sight(photo, frame, point, sighting) && sighting.pixels_per_length > best;
      if (sharper && !facades.isBlocked(photo.center, point, facade)) {
        best = sighting.pixels_per_length;
      }
    }
    if (best > 0.0) texels.push_back(1.0 / best);
  }
  if (texels.empty()) return 0.0;
  const auto middle = texels.begin() + static_cast<std::ptrdiff_t>(texels.size() / 2);
  std::nth_element(texels.begin(), middle, texels.end());
  return *middle;
}

}  // namespace storey::detail
