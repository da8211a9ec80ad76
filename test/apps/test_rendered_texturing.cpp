// SPDX-License-Identifier: BSD-3-Clause
// Textures of generated buildings against what they were painted with.
#include <gtest/gtest.h>
#include <storey/surface/facade_texturing.h>

#include <algorithm>
#include <cmath>

#include "synth/photos/rendered_building.h"

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

/// Sums over the seen texels of all facades.
struct Comparison {
  double squares = 0.0;
  double channels = 0.0;
  double psnr() const { return 10.0 * std::log10(255.0 * 255.0 * channels / squares); }
};

/// Compares after the one factor, for each channel, that no method can know: the exposure of all.
Comparison compare(const PhotoScene& scene, const std::vector<FacadeTexture>& textures) {
  Comparison all;
  for (int c = 0; c < 3; ++c) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t f = 0; f < textures.size(); ++f) {
      const RgbImage truth = scene.orthoImage(f, textures[f].texel);
      for (std::size_t i = 0; i < textures[f].states.size(); ++i) {
        if (textures[f].states[i] != TexelState::Seen) continue;
        const double a = textures[f].image.channels[3 * i + static_cast<std::size_t>(c)];
        const double b = truth.channels[3 * i + static_cast<std::size_t>(c)];
        ab += a * b;
        aa += a * a;
        bb += b * b;
        all.channels += 1.0;
      }
    }
    all.squares += bb - ab * ab / aa;  // least of sum (b - s a)^2 over s
  }
  return all;
}

Eigen::Vector3d middleOf(const FacadeTexture& t, std::size_t i) {
  const auto width = static_cast<std::size_t>(t.image.width);
  return t.frame.point((static_cast<double>(i % width) + 0.5) * t.texel,
                       t.frame.height - (static_cast<double>(i / width) + 0.5) * t.texel);
}

/// Share of the texels on facades whose state is not what a ray to each camera says. `scene` is
/// without occluders: the model does not know of them.
double maskErrors(const Rendered& rendered, const PhotoScene& scene,
                  const std::vector<FacadeTexture>& textures) {
  constexpr double kGrazing = 0.1;  // the cosine below which nothing counts as seen
  std::size_t wrong = 0;
  std::size_t total = 0;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    for (std::size_t i = 0; i < t.states.size(); i += 7) {
      if (t.states[i] == TexelState::Outside) continue;
      const Eigen::Vector3d point = middleOf(t, i);
      bool seen = false;
      for (const FacadePhoto& photo : rendered.photos) {
        const Eigen::Vector3d sight = (photo.camera.center() - point).normalized();
        seen |= sight.dot(t.frame.normal()) > kGrazing && scene.isClear(photo.camera, f, point);
      }
      wrong += seen != (t.states[i] == TexelState::Seen);
      ++total;
    }
  }
  return static_cast<double>(wrong) / static_cast<double>(total);
}

/// Mean difference of the channels of a texel from the one of the 3 x 3 about it in another image
/// that is nearest: seams elsewhere move edges by a texel.
double differenceFrom(const RgbImage& other, const RgbImage& image, int x, int y) {
  double least = 255.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const std::uint8_t* const a = image.at(x, y);
      const std::uint8_t* const b =
          other.at(std::clamp(x + dx, 0, other.width - 1), std::clamp(y + dy, 0, other.height - 1));
      least = std::min(
          least, (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3.0);
    }
  }
  return least;
}

struct Painted {
  std::size_t clear = 0;  ///< texels that three photos see past everything
  std::size_t wrong = 0;  ///< of these, with something else on them
};

/// Compares with the textures of the same photos without occluders, all of one exposure.
Painted occludersPaintedOn(const Rendered& rendered, const std::vector<FacadeTexture>& textures,
                           const std::vector<FacadeTexture>& bare) {
  constexpr double kSomethingElse = 30.0;  // grey levels; the occluders differ by 45 and more
  Painted painted;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    for (std::size_t i = 0; i < t.states.size(); ++i) {
      if (t.states[i] != TexelState::Seen) continue;
      const int x = static_cast<int>(i) % t.image.width;
      const int y = static_cast<int>(i) / t.image.width;
      const bool suspect = differenceFrom(bare[f].image, t.image, x, y) > kSomethingElse;
      if (!suspect && i % 11 != 0) continue;  // rays are slow: the share is measured on some
      const auto num_clear = std::count_if(
          rendered.photos.begin(), rendered.photos.end(), [&](const FacadePhoto& photo) {
            return rendered.scene.isClear(photo.camera, f, middleOf(t, i));
          });
      if (num_clear < 3) continue;
      painted.wrong += suspect ? 1 : 0;
      painted.clear += i % 11 == 0 ? 11 : 0;
    }
  }
  return painted;
}

// Occluders, exposures from 0.8 to 1.25, noise of 2 grey levels.
TEST(RenderedTexturing, IsFaithfulWhereSeen) {
  for (const char* name : {"l_shape", "two_towers"}) {
    const Rendered rendered(name, smallPhotos());
    const auto textures = texturesOf(rendered);
    const double psnr = compare(rendered.scene, textures).psnr();
    PhotoOptions options = smallPhotos();
    options.occluders = 0;
    const double wrong = maskErrors(rendered, PhotoScene(rendered.model, options), textures);
    EXPECT_GE(psnr, kTargetPsnr) << name;
    EXPECT_LE(wrong, 0.02) << name;
  }
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
    const Painted painted = occludersPaintedOn(rendered, textures, bare);
    EXPECT_GT(painted.clear, 10000u);
    EXPECT_LE(static_cast<double>(painted.wrong), 0.002 * static_cast<double>(painted.clear))
        << name;
  }
}

}  // namespace
}  // namespace storey::synth
