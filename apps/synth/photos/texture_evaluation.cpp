// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/texture_evaluation.h"

#include <storey/surface/window_cutting.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace storey::synth {
namespace {

Eigen::Vector3d middleOf(const FacadeTexture& t, std::size_t i) {
  const auto width = static_cast<std::size_t>(t.image.width);
  return t.frame.point((static_cast<double>(i % width) + 0.5) * t.texel,
                       t.frame.height - (static_cast<double>(i / width) + 0.5) * t.texel);
}

std::size_t firstOnFacade(const FacadeTexture& t) {
  const auto on = std::find_if(t.states.begin(), t.states.end(),
                               [](TexelState state) { return state != TexelState::Outside; });
  return static_cast<std::size_t>(on - t.states.begin());
}

/// The facade of the scene that a texture is of, or of whose windows: parallel, and not in front of
/// it. The number of facades if there is none, as for reveals.
std::size_t paintedFacade(const PhotoScene& scene, const FacadeTexture& t) {
  constexpr double kSame = 1e-3;  // of a direction; of the height of a facade
  const std::vector<FacadeFrame>& frames = scene.frames();
  const std::size_t first = firstOnFacade(t);
  if (first == t.states.size()) return frames.size();
  const Eigen::Vector3d point = middleOf(t, first);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Eigen::Vector2d at = frames[f].local(point);
    const double depth = frames[f].normal().dot(frames[f].origin - point);
    const bool parallel = frames[f].normal().dot(t.frame.normal()) > 1.0 - kSame;
    const bool at_facade = std::abs(depth) < kSame * frames[f].height;
    const bool in_window =
        depth > 0.0 && depth < frames[f].height && scene.paints()[f].windowAt(at) != nullptr;
    if (!parallel || !(at_facade || in_window)) continue;
    if (isInside(frames[f].outline(scene.facades()[f]), at)) return f;
  }
  return frames.size();
}

/// What a texture ought to show: the paint of a facade behind its texels, 3 x 3 samples each.
RgbImage truthOf(const PhotoScene& scene, std::size_t facade, const FacadeTexture& t) {
  constexpr int kSamples = 3;  // in each direction
  RgbImage truth(t.image.width, t.image.height);
  for (std::size_t i = 0; i < t.states.size(); ++i) {
    if (t.states[i] == TexelState::Outside) continue;
    const Eigen::Vector3d middle = middleOf(t, i);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const double right = ((k % kSamples + 0.5) / kSamples - 0.5) * t.texel;
      const double up = ((k / kSamples + 0.5) / kSamples - 0.5) * t.texel;
      const Eigen::Vector3d point = middle + right * t.frame.right + up * t.frame.up;
      sum += scene.paints()[facade].color(scene.frames()[facade].local(point));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double level = sum[static_cast<Eigen::Index>(c)] / (kSamples * kSamples);
      truth.channels[3 * i + c] = static_cast<std::uint8_t>(std::lround(level));
    }
  }
  return truth;
}

/// A channel of textures beside what it ought to be.
struct Pairs {
  std::vector<std::pair<double, double>> seen;      // found, true
  std::vector<std::pair<double, double>> measured;  // of the state that is asked for
};

/// The factor by which what was found is nearest to the truth.
double gainOf(const std::vector<std::pair<double, double>>& pairs) {
  double ab = 0.0;
  double aa = 0.0;
  for (const auto& [found, truth] : pairs) {
    ab += found * truth;
    aa += found * found;
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
  std::array<Pairs, 3> channels;
  for (const FacadeTexture& t : textures) {
    const std::size_t facade = paintedFacade(scene, t);
    if (facade == scene.frames().size()) continue;
    const RgbImage truth = truthOf(scene, facade, t);
    for (std::size_t i = 0; i < t.states.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::pair<double, double> pair(t.image.channels[3 * i + c],
                                             truth.channels[3 * i + c]);
        if (t.states[i] == TexelState::Seen) channels[c].seen.push_back(pair);
        if (t.states[i] == state) channels[c].measured.push_back(pair);
      }
    }
  }
  double squares = 0.0;
  double count = 0.0;
  for (const Pairs& channel : channels) {
    const double gain = gainOf(channel.seen);
    for (const auto& [found, truth] : channel.measured)
      squares += std::pow(gain * found - truth, 2);
    count += static_cast<double>(channel.measured.size());
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

void cutPaintedWindows(const PhotoScene& scene, double depth, PolyhedralModel& model) {
  for (std::size_t f = 0; f < scene.frames().size(); ++f) {
    std::vector<FacadeWindow> windows;
    for (const PaintedWindow& painted : scene.paints()[f].windows()) {
      FacadeWindow window;
      window.min = painted.min;
      window.max = painted.max;
      windows.push_back(window);
    }
    if (!windows.empty()) cutWindows(model, f, scene.frames()[f], windows, depth);
  }
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

void fillWithMean(FacadeTexture& t) {
  std::array<double, 3> sum{};
  double count = 0.0;
  for (std::size_t i = 0; i < t.states.size(); ++i) {
    if (t.states[i] != TexelState::Seen) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += t.image.channels[3 * i + c];
    count += 1.0;
  }
  for (std::size_t i = 0; count > 0.0 && i < t.states.size(); ++i) {
    if (t.states[i] != TexelState::Unseen) continue;
    t.states[i] = TexelState::Filled;
    for (std::size_t c = 0; c < 3; ++c) {
      t.image.channels[3 * i + c] = static_cast<std::uint8_t>(sum[c] / count);
    }
  }
}

}  // namespace storey::synth
