// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

#include <vector>

#include "synth/photos/photo_scene.h"

namespace storey::synth {

/// How faithful textures are to what the facades were painted with, in decibels (PSNR) over the
/// texels of one state of all facades together. The one factor for each channel that no method can
/// know, the exposure of all photos, is fitted to the seen texels first.
/// \param textures of the faces of the scene's model, or of the same with windows cut: panes lie
///        behind their wall; reveals are left out
double faithfulness(const PhotoScene& scene, const std::vector<FacadeTexture>& textures,
                    TexelState state = TexelState::Seen);

/// Share of the texels on facades that are marked as seen though a ray to no camera is clear, or
/// the other way round. \param scene without occluders: the model does not know of them
double wrongMask(const PhotoScene& scene, const std::vector<Camera>& cameras,
                 const std::vector<FacadeTexture>& textures);

/// Occluders that were taken for paint.
struct PaintedOccluders {
  std::size_t clear = 0;  ///< texels that three photos see past everything
  std::size_t wrong = 0;  ///< of these, with something else on them
  double share() const {
    return clear > 0 ? static_cast<double>(wrong) / static_cast<double>(clear) : 0.0;
  }
};

/// \param scene with occluders
/// \param bare  textures from the same cameras without occluders, of the same exposures
PaintedOccluders paintedOccluders(const PhotoScene& scene, const std::vector<Camera>& cameras,
                                  const std::vector<FacadeTexture>& textures,
                                  const std::vector<FacadeTexture>& bare);

/// Cuts all painted windows into the model of a scene, to the depth that they are rendered with.
void cutPaintedWindows(const PhotoScene& scene, double depth, PolyhedralModel& model);

/// Makes a rectangle in the middle of each wall unseen, as a large tree in front of it would: three
/// tenths of its width and height.
void hideMiddles(const PhotoScene& scene, std::vector<FacadeTexture>& textures);

/// Gives what is unseen the mean of what was seen: what any filling must be better than.
void fillWithMean(FacadeTexture& texture);

}  // namespace storey::synth
