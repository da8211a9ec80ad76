// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/marked_facade.h>
#include <storey/surface/detail/window_depth.h>
#include <storey/surface/detail/window_proposal.h>
#include <storey/surface/detail/window_search.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

using detail::RectifiedView;
using detail::TextureGrid;

/// Size of the raster's texels: what the photos resolve, but no more texels than wanted.
double texelSize(const FacadeFrame& frame, double resolved, double max_texels) {
  return std::max(resolved, std::sqrt(frame.width * frame.height / max_texels));
}

}  // namespace

struct WindowDetection::Photos {
  detail::FacadeSight sight;
  std::vector<detail::TexturePhoto> photos;
};

struct WindowDetection::Raster {
  TextureGrid grid;
  std::vector<RectifiedView> views;
};

WindowDetection::WindowDetection(std::vector<Facade> facades,
                                 const std::vector<FacadePhoto>& photos,
                                 const WindowDetectionOptions& options)
    : facades_(std::move(facades)), options_(options) {
  auto prepared = std::make_unique<Photos>(Photos{detail::FacadeSight(facades_), {}});
  for (const FacadePhoto& photo : photos) {
    prepared->photos.push_back(
        {photo.camera, photo.camera.center(), detail::ImagePyramid(photo.image)});
  }
  photos_ = std::move(prepared);
}

WindowDetection::~WindowDetection() = default;

WindowDetection::Raster WindowDetection::rasterOf(std::size_t facade) const {
  const FacadeFrame frame = frameOf(facades_[facade], options_.vertical);
  const FacadeOutline outline = frame.outline(facades_[facade]);
  const double resolved =
      detail::resolvedTexel(frame, outline, facade, photos_->sight, photos_->photos);
  Raster raster{{facade, frame, outline, texelSize(frame, resolved, options_.max_texels)}, {}};
  raster.views = detail::rectifyViews(raster.grid, photos_->sight, photos_->photos);
  return raster;
}

WindowGrid WindowDetection::resultOf(const Raster& raster, std::vector<FacadeWindow> windows,
                                     const char* problem) const {
  WindowGrid result;
  result.facade = raster.grid.facade;
  result.frame = raster.grid.frame;
  result.texel = raster.grid.texel;
  for (const RectifiedView& view : raster.views) result.photos.push_back(view.photo);
  result.windows = std::move(windows);
  if (result.windows.empty()) {
    result.problem = problem;
    return result;
  }
  const detail::WindowDepth depth =
      detail::findDepth(raster.grid, photos_->sight, photos_->photos, raster.views, result.windows);
  result.depth = depth.depth;
  result.depth_known = depth.known;
  return result;
}

WindowGrid WindowDetection::detect(const WindowMark& mark) const {
  WindowGrid none;
  if (mark.photo >= photos_->photos.size()) {
    none.problem = "there is no such photo";
    return none;
  }
  const detail::MarkedFacade marked =
      detail::findMarked(facades_, photos_->photos[mark.photo].camera, mark, options_.vertical);
  none.problem = marked.problem;
  if (!marked.problem.empty()) return none;
  const Raster raster = rasterOf(marked.facade);
  if (raster.views.empty()) return resultOf(raster, {}, "no photo shows enough of the facade");
  return resultOf(raster,
                  detail::searchMarked(raster.grid, raster.views, mark.photo, marked.outline),
                  "nothing on the facade looks like what the quadrilateral marks");
}

WindowGrid WindowDetection::propose(std::size_t facade) const {
  constexpr double kUpright = 0.1;  // of a wall's normal, along the vertical
  WindowGrid none;
  none.facade = facade;
  none.problem = "is no wall";
  if (facade >= facades_.size()) return none;
  if (std::abs(facades_[facade].normal.dot(options_.vertical)) > kUpright) return none;
  const Raster raster = rasterOf(facade);
  const detail::WindowProposal proposal = detail::proposeGrid(raster.grid, raster.views);
  if (!proposal.problem.empty()) return resultOf(raster, {}, proposal.problem.c_str());
  return resultOf(raster,
                  detail::searchFrom(raster.grid, raster.views, proposal.bands, proposal.scores),
                  "nothing on it repeats as windows do");
}

}  // namespace storey
