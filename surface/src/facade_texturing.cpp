// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/exposure_levelling.h>
#include <storey/surface/detail/hidden_views.h>
#include <storey/surface/detail/seam_levelling.h>
#include <storey/surface/detail/texture_composition.h>
#include <storey/surface/detail/texture_fill.h>
#include <storey/surface/detail/texture_views.h>
#include <storey/surface/detail/view_selection.h>
#include <storey/surface/facade_texturing.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

using detail::FacadeSight;
using detail::TextureGrid;
using detail::TexturePhoto;

bool isValid(const std::vector<FacadePhoto>& photos, const FacadeTexturingOptions& options) {
  const bool unit = std::abs(options.vertical.norm() - 1.0) < 1e-6;
  if (!unit || !(options.texel >= 0.0) || !(options.max_texels >= 1.0)) {
    PCL_ERROR(
        "[storey::textureFacades] vertical is to be of length 1, texel >= 0 and max_texels "
        ">= 1; they are %g, %g and %g.\n",
        options.vertical.norm(), options.texel, options.max_texels);
    return false;
  }
  for (const FacadePhoto& photo : photos) {
    if (photo.image.width == photo.camera.width && photo.image.height == photo.camera.height &&
        !photo.image.empty()) {
      continue;
    }
    PCL_ERROR("[storey::textureFacades] an image has %d x %d pixels, its camera %d x %d.\n",
              photo.image.width, photo.image.height, photo.camera.width, photo.camera.height);
    return false;
  }
  return true;
}

std::vector<TexturePhoto> prepare(const std::vector<FacadePhoto>& photos) {
  std::vector<TexturePhoto> prepared;
  for (const FacadePhoto& photo : photos) {
    prepared.push_back({photo.camera, photo.camera.center(), detail::ImagePyramid(photo.image)});
  }
  return prepared;
}

/// Side of a texel on each facade. Facades that no photo sees get the coarsest of the others.
std::vector<double> texelSizes(const std::vector<FacadeFrame>& frames,
                               const std::vector<FacadeOutline>& outlines, const FacadeSight& sight,
                               const std::vector<TexturePhoto>& photos,
                               const FacadeTexturingOptions& options) {
  std::vector<double> sizes(frames.size(), options.texel);
  if (options.texel == 0.0) {
    double longest = 0.0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      sizes[f] = detail::resolvedTexel(frames[f], outlines[f], f, sight, photos);
      longest = std::max({longest, frames[f].width, frames[f].height});
    }
    constexpr double kTexelsUnseen = 64.0;  // along the longest side, if nothing was seen at all
    const double coarsest = *std::max_element(sizes.begin(), sizes.end());
    const double unseen = coarsest > 0.0 ? coarsest : longest / kTexelsUnseen;
    std::replace(sizes.begin(), sizes.end(), 0.0, unseen);
  }
  double texels = 0.0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    texels += frames[f].width / sizes[f] * frames[f].height / sizes[f];
  }
  const double growth = std::sqrt(std::max(1.0, texels / options.max_texels));
  for (double& size : sizes) size *= growth;
  return sizes;
}

}  // namespace

double FacadeTexture::seenShare() const {
  const auto seen = std::count(states.begin(), states.end(), TexelState::Seen);
  const auto unseen = std::count(states.begin(), states.end(), TexelState::Unseen);
  return seen == 0 ? 0.0 : static_cast<double>(seen) / static_cast<double>(seen + unseen);
}

Eigen::Vector2d FacadeTexture::coordinates(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d place = frame.local(point);
  return {place.x() / (image.width * texel),
          1.0 - (frame.height - place.y()) / (image.height * texel)};
}

std::vector<FacadeTexture> textureFacades(const std::vector<Facade>& facades,
                                          const std::vector<FacadePhoto>& photos,
                                          const FacadeTexturingOptions& options) {
  if (!isValid(photos, options) || facades.empty()) return {};
  const std::vector<TexturePhoto> prepared = prepare(photos);
  const FacadeSight sight(facades);
  std::vector<FacadeFrame> frames;
  std::vector<FacadeOutline> outlines;
  for (const Facade& facade : facades) {
    frames.push_back(frameOf(facade, options.vertical));
    outlines.push_back(frames.back().outline(facade));
  }
  const std::vector<double> texels = texelSizes(frames, outlines, sight, prepared, options);

  std::vector<TextureGrid> grids;
  std::vector<std::vector<std::vector<detail::BlockView>>> views;
  for (std::size_t f = 0; f < facades.size(); ++f) {
    grids.emplace_back(f, frames[f], outlines[f], texels[f]);
    views.push_back(detail::findViews(grids[f], sight, prepared));
  }
  const std::vector<Eigen::Array3f> gains = detail::levelExposures(views, prepared.size());
  std::vector<FacadeTexture> textures;
  for (std::size_t f = 0; f < facades.size(); ++f) {
    detail::findHidden(grids[f], gains, views[f]);
    const std::vector<int> selected = detail::selectViews(grids[f], views[f]);
    const std::vector<Eigen::Array3f> corrections =
        detail::levelSeams(grids[f], gains, views[f], selected);
    textures.push_back(
        detail::composeTexture(grids[f], sight, prepared, gains, views[f], selected, corrections));
    if (options.fill) detail::fillUnseen(textures.back());
  }
  return textures;
}

}  // namespace storey
