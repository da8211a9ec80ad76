// SPDX-License-Identifier: BSD-3-Clause
// Textures of generated buildings against what they were painted with.
#include <gtest/gtest.h>
#include <storey/surface/detail/texture_fill.h>
#include <storey/surface/facade_texturing.h>

#include "synth/photos/rendered_building.h"
#include "synth/photos/texture_evaluation.h"

namespace storey::synth {
namespace {

constexpr double kTargetPsnr = 28.0;  // dB

PhotoOptions smallPhotos() {
  PhotoOptions options;
  options.views = 14;
  options.width = 480;
  return options;
}

std::vector<FacadeTexture> texturesOf(const Rendered& rendered) {
  FacadeTexturing texturing;
  texturing.setModel(rendered.model);
  texturing.setPhotos(rendered.photos);
  std::vector<FacadeTexture> textures;
  EXPECT_TRUE(texturing.texture(textures));
  return textures;
}

// Occluders, exposures from 0.8 to 1.25, noise of 2 grey levels.
TEST(RenderedTexturing, IsFaithfulWhereSeen) {
  for (const char* name : {"l_shape", "two_towers"}) {
    const Rendered rendered(name, smallPhotos());
    const auto textures = texturesOf(rendered);
    const double psnr = faithfulness(rendered.scene, textures);
    PhotoOptions options = smallPhotos();
    options.occluders = 0;
    const PhotoScene bare(rendered.model, options);
    const double wrong = wrongMask(bare, bare.placeCameras(), textures);
    EXPECT_GE(psnr, kTargetPsnr) << name;
    EXPECT_LE(wrong, 0.02) << name;
  }
}

// The middles of walls, hidden and filled, are nearer to the paint than one colour would be: its
// windows are dark. Half of its error and more is gone.
TEST(RenderedTexturing, FillingFollowsTheWindows) {
  const Rendered rendered("box", smallPhotos());
  auto textures = texturesOf(rendered);
  hideMiddles(rendered.scene, textures);
  auto plain = textures;
  for (FacadeTexture& t : textures) detail::fillUnseen(t);
  for (FacadeTexture& t : plain) fillWithMean(t);
  EXPECT_GT(faithfulness(rendered.scene, textures, TexelState::Filled),
            faithfulness(rendered.scene, plain, TexelState::Filled) + 3.0);
}

// Windows set back by 0.3 of a building whose windows are known.
TEST(RenderedTexturing, IsFaithfulToWindowsThatAreCut) {
  PhotoOptions options = smallPhotos();
  options.width = 640;
  options.recess = 0.3;
  Rendered rendered("box", options);
  cutPaintedWindows(rendered.scene, options.recess, rendered.model);
  EXPECT_GE(faithfulness(rendered.scene, texturesOf(rendered)), kTargetPsnr);
}

TEST(RenderedTexturing, NoOccluderIsPaintedOnWhereThreePhotosSeePastIt) {
  PhotoOptions options = smallPhotos();
  options.exposure = 0.0;
  options.views = 20;
  options.width = 360;
  for (const char* name : {"box", "l_shape"}) {
    const Rendered rendered(name, options);
    const auto textures = texturesOf(rendered);
    PhotoOptions without = options;
    without.occluders = 0;
    const auto bare = texturesOf(Rendered(name, without));
    const PaintedOccluders painted =
        paintedOccluders(rendered.scene, rendered.scene.placeCameras(), textures, bare);
    EXPECT_GT(painted.clear, 10000u);
    EXPECT_LE(painted.share(), 0.002) << name;
  }
}

}  // namespace
}  // namespace storey::synth
