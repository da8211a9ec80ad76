// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/facade_sight.h>
#include <storey/surface/detail/image_pyramid.h>
#include <storey/surface/facade_texturing.h>

#include <array>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// A photo made ready for sampling.
struct TexturePhoto {
  Camera camera;
  Eigen::Vector3d center;
  ImagePyramid pyramid;
};

/// A facade's raster of texels, in square blocks.
struct TextureGrid {
  std::size_t facade = 0;
  FacadeFrame frame;
  FacadeOutline outline;
  double texel = 0.0;
  int width = 0, height = 0;  ///< texels
  int columns = 0, rows = 0;  ///< blocks

  TextureGrid(std::size_t index, const FacadeFrame& f, const FacadeOutline& o, double size);
  std::size_t numBlocks() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t block(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  /// In the frame, of a place in texels from the upper left corner.
  Eigen::Vector2d place(double x, double y) const { return {x * texel, frame.height - y * texel}; }
  Eigen::Vector3d point(double x, double y) const {
    const Eigen::Vector2d p = place(x, y);
    return frame.point(p.x(), p.y());
  }
};

constexpr int kBlockTexels = 8;  ///< side of a block
constexpr int kCells = 4;        ///< of a block, 2 x 2, in which photos are compared

/// How a photo shows a place of a facade.
struct Sighting {
  Eigen::Vector2d pixel;
  double pixels_per_length;  ///< in the direction that is shown smallest
  double cosine;             ///< between the facade's normal and the line of sight
};

/// Nothing if the place is not in the image or seen from behind or at a grazing angle. Facades in
/// between are not looked for.
bool sight(const TexturePhoto& photo, const FacadeFrame& frame, const Eigen::Vector3d& point,
           Sighting& sighting);

/// How a photo shows a block.
struct BlockView {
  int photo = -1;
  float quality = 0.0f;  ///< in (0, 1], of angle and resolution
  std::array<bool, kCells> shown{};
  std::array<Eigen::Array3f, kCells> colors{};  ///< of the shown cells
  float contrast = 0.0f;                        ///< of the block and those about it, grey levels
  float deviation = 0.0f;                       ///< from what most photos show, 1: the limit
  bool hidden = false;  ///< something that is not the facade is in front of it

  int numShown() const;
};

/// All photos that show something of each block, by their index. Blocks wholly off the facade have
/// none.
std::vector<std::vector<BlockView>> findViews(const TextureGrid& grid, const FacadeSight& sight,
                                              const std::vector<TexturePhoto>& photos);

/// What the photo that sees it best resolves, in the median over a facade; 0 if none sees it.
double resolvedTexel(const FacadeFrame& frame, const FacadeOutline& outline, std::size_t facade,
                     const FacadeSight& sight, const std::vector<TexturePhoto>& photos);

}  // namespace storey::detail
