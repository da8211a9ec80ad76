// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/texture_evaluation.h"

#include <algorithm>
#include <cmath>

namespace storey::synth {
namespace {

Eigen::Vector3d middleOf(const FacadeTexture& t, std::size_t i) {
  const auto width = static_cast<std::size_t>(t.image.width);
  return t.frame.point((static_cast<double>(i % width) + 0.5) * t.texel,
                       t.frame.height - (static_cast<double>(i / width) + 0.5) * t.texel);
}

/// The factor by which a channel is to be multiplied to be nearest to the truth where it was seen.
double gainOf(const std::vector<FacadeTexture>& textures, const std::vector<RgbImage>& truths,
              std::size_t channel) {
  double ab = 0.0;
  double aa = 0.0;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    for (std::size_t i = 0; i < textures[f].states.size(); ++i) {
      if (textures[f].states[i] != TexelState::Seen) continue;
      const double a = textures[f].image.channels[3 * i + channel];
      ab += a * truths[f].channels[3 * i + channel];
      aa += a * a;
    }
  }
  return aa > 0.0 ? ab / aa : 1.0;
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

}  // namespace

double faithfulness(const PhotoScene& scene, const std::vector<FacadeTexture>& textures,
                    TexelState state) {
  std::vector<RgbImage> truths;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    truths.push_back(scene.orthoImage(f, textures[f].texel));
  }
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double gain = gainOf(textures, truths, c);
    for (std::size_t f = 0; f < textures.size(); ++f) {
      for (std::size_t i = 0; i < textures[f].states.size(); ++i) {
        if (textures[f].states[i] != state) continue;
        const double off = gain * textures[f].image.channels[3 * i + c] -
                           static_cast<double>(truths[f].channels[3 * i + c]);
        squares += off * off;
        count += 1.0;
      }
    }
  }
  return 10.0 * std::log10(255.0 * 255.0 * count / squares);
}

double wrongMask(const PhotoScene& scene, const std::vector<Camera>& cameras,
                 const std::vector<FacadeTexture>& textures) {
  constexpr double kGrazing = 0.1;  // the cosine below which nothing counts as seen
  constexpr std::size_t kStep = 7;  // rays are slow: the share is measured on some texels
  std::size_t wrong = 0;
  std::size_t total = 0;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    for (std::size_t i = 0; i < t.states.size(); i += kStep) {
      if (t.states[i] == TexelState::Outside) continue;
      const Eigen::Vector3d point = middleOf(t, i);
      const bool seen = std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
        const Eigen::Vector3d sight = (camera.center() - point).normalized();
        return sight.dot(t.frame.normal()) > kGrazing && scene.isClear(camera, f, point);
      });
      wrong += seen != (t.states[i] == TexelState::Seen) ? 1 : 0;
      ++total;
    }
  }
  return static_cast<double>(wrong) / static_cast<double>(total);
}

PaintedOccluders paintedOccluders(const PhotoScene& scene, const std::vector<Camera>& cameras,
                                  const std::vector<FacadeTexture>& textures,
                                  const std::vector<FacadeTexture>& bare) {
  constexpr double kSomethingElse = 30.0;  // grey levels; the occluders differ by 45 and more
  constexpr std::size_t kStep = 11;        // rays are slow: the clear are counted on some texels
  PaintedOccluders painted;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    for (std::size_t i = 0; i < t.states.size(); ++i) {
      if (t.states[i] != TexelState::Seen) continue;
      const int x = static_cast<int>(i) % t.image.width;
      const int y = static_cast<int>(i) / t.image.width;
      const bool suspect = differenceFrom(bare[f].image, t.image, x, y) > kSomethingElse;
      if (!suspect && i % kStep != 0) continue;
      const Eigen::Vector3d point = middleOf(t, i);
      const auto num_clear =
          std::count_if(cameras.begin(), cameras.end(),
                        [&](const Camera& camera) { return scene.isClear(camera, f, point); });
      if (num_clear < 3) continue;
      painted.wrong += suspect ? 1 : 0;
      painted.clear += i % kStep == 0 ? kStep : 0;
    }
  }
  return painted;
}

void hideMiddles(const PhotoScene& scene, std::vector<FacadeTexture>& textures) {
  for (std::size_t f = 0; f < textures.size(); ++f) {
    if (scene.paints()[f].windows().empty()) continue;
    FacadeTexture& t = textures[f];
    for (int y = t.image.height * 7 / 20; y < t.image.height * 13 / 20; ++y) {
      for (int x = t.image.width * 7 / 20; x < t.image.width * 13 / 20; ++x) {
        TexelState& state = t.states[static_cast<std::size_t>(y * t.image.width + x)];
        if (state == TexelState::Outside) continue;
        state = TexelState::Unseen;
        std::fill_n(t.image.at(x, y), 3, std::uint8_t{0});
      }
    }
  }
}

}  // namespace storey::synth
