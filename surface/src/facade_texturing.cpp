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
                               const std::vector<TexturePhoto>& photos, double texel_size,
                               double max_texels) {
  std::vector<double> sizes(frames.size(), texel_size);
  if (texel_size == 0.0) {
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
  const double growth = std::sqrt(std::max(1.0, texels / max_texels));
  for (double& size : sizes) size *= growth;
  return sizes;
}

}  // namespace

double FacadeTexture::seenShare() const {
  const auto seen = std::count(states.begin(), states.end(), TexelState::Seen);
  const auto outside = std::count(states.begin(), states.end(), TexelState::Outside);
  const auto all = static_cast<std::ptrdiff_t>(states.size()) - outside;
  return seen == 0 ? 0.0 : static_cast<double>(seen) / static_cast<double>(all);
}

Eigen::Vector2d FacadeTexture::coordinates(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d place = frame.local(point);
  return {place.x() / (image.width * texel),
          1.0 - (frame.height - place.y()) / (image.height * texel)};
}

bool FacadeTexturing::inputValid() const {
  if (facades_.empty()) {
    PCL_ERROR("[storey::FacadeTexturing] there is no model.\n");
    return false;
  }
  const bool unit = std::abs(vertical_.norm() - 1.0) < 1e-6;
  if (!unit || !(texel_size_ >= 0.0) || !(max_texels_ >= 1.0)) {
    PCL_ERROR(
        "[storey::FacadeTexturing] the vertical is to be of length 1, the texel size >= 0 and the "
        "most texels >= 1; they are %g, %g and %g.\n",
        vertical_.norm(), texel_size_, max_texels_);
    return false;
  }
  for (const FacadePhoto& photo : photos_) {
    if (photo.image.width == photo.camera.width && photo.image.height == photo.camera.height &&
        !photo.image.empty()) {
      continue;
    }
    PCL_ERROR("[storey::FacadeTexturing] an image has %d x %d pixels, its camera %d x %d.\n",
              photo.image.width, photo.image.height, photo.camera.width, photo.camera.height);
    return false;
  }
  return true;
}

bool FacadeTexturing::texture(std::vector<FacadeTexture>& textures) const {
  textures.clear();
  if (!inputValid()) return false;
  const std::vector<TexturePhoto> prepared = prepare(photos_);
  const FacadeSight sight(facades_);
  std::vector<FacadeFrame> frames;
  std::vector<FacadeOutline> outlines;
  for (const Facade& facade : facades_) {
    frames.push_back(frameOf(facade, vertical_));
    outlines.push_back(frames.back().outline(facade));
  }
  const std::vector<double> texels =
      texelSizes(frames, outlines, sight, prepared, texel_size_, max_texels_);

  std::vector<TextureGrid> grids;
  std::vector<std::vector<std::vector<detail::BlockView>>> views;
  for (std::size_t f = 0; f < facades_.size(); ++f) {
    grids.emplace_back(f, frames[f], outlines[f], texels[f]);
    views.push_back(detail::findViews(grids[f], sight, prepared));
  }
  const std::vector<Eigen::Array3f> gains = detail::levelExposures(views, prepared.size());
  for (std::size_t f = 0; f < facades_.size(); ++f) {
    detail::findHidden(grids[f], gains, views[f]);
    const std::vector<int> selected = detail::selectViews(grids[f], views[f]);
    const std::vector<Eigen::Array3f> corrections =
        detail::levelSeams(grids[f], gains, views[f], selected);
    textures.push_back(
        detail::composeTexture(grids[f], sight, prepared, gains, views[f], selected, corrections));
    if (fill_unseen_) detail::fillUnseen(textures.back());
  }
  return true;
}

}  // namespace storey
