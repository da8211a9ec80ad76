// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/palette_image.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace storey::detail {
namespace {

using Color = Eigen::Array3f;

constexpr int kColors = 24;
constexpr int kLloydSteps = 8;

/// A photo's view in pixels of `step` x `step` texels; NaN where less than half of them are seen.
struct CoarseView {
  std::vector<Color> colors;
};

const Color kNothing = Color::Constant(std::numeric_limits<float>::quiet_NaN());

bool isSeen(const Color& color) { return !std::isnan(color[0]); }

CoarseView shrink(const TextureGrid& grid, const RectifiedView& view, int step) {
  CoarseView coarse;
  for (int top = 0; top + step <= grid.height; top += step) {
    for (int left = 0; left + step <= grid.width; left += step) {
      Color sum = Color::Zero();
      int seen = 0;
      for (int y = top; y < top + step; ++y) {
        for (int x = left; x < left + step; ++x) {
          const auto texel = static_cast<std::size_t>(y * grid.width + x);
          if (view.seen[texel] == 0) continue;
          sum += view.colors[texel];
          ++seen;
        }
      }
      const bool enough = 2 * seen >= step * step;
      coarse.colors.push_back(enough ? (sum / static_cast<float>(seen)).eval() : kNothing);
    }
  }
  return coarse;
}

float medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Medians over the views, channel by channel.
std::vector<Color> medianImage(const std::vector<CoarseView>& views) {
  std::vector<Color> image(views[0].colors.size(), kNothing);
  std::vector<float> values;
  for (std::size_t i = 0; i < image.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      values.clear();
      for (const CoarseView& view : views) {
        if (isSeen(view.colors[i])) values.push_back(view.colors[i][channel]);
      }
      if (!values.empty()) image[i][channel] = medianOf(values);
    }
  }
  return image;
}

/// Gives a view the exposure of an image.
void level(const std::vector<Color>& image, CoarseView& view) {
  Color gain = Color::Ones();
  std::vector<float> ratios;
  for (int channel = 0; channel < 3; ++channel) {
    ratios.clear();
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (!isSeen(view.colors[i])) continue;
      ratios.push_back((image[i][channel] + 1.0f) / (view.colors[i][channel] + 1.0f));
    }
    if (!ratios.empty()) gain[channel] = medianOf(ratios);
  }
  for (Color& color : view.colors) color *= gain;
}

int nearest(const std::vector<Color>& palette, const Color& color) {
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < palette.size(); ++k) {
    const float distance = (palette[k] - color).square().sum();
    if (distance >= least) continue;
    least = distance;
    best = static_cast<int>(k);
  }
  return best;
}

bool isDarker(const Color& a, const Color& b) { return a.sum() < b.sum(); }

/// Colours that stand for those of an image, dark ones first.
std::vector<Color> paletteOf(const std::vector<Color>& image) {
  std::vector<Color> seen;
  for (const Color& color : image) {
    if (isSeen(color)) seen.push_back(color);
  }
  std::stable_sort(seen.begin(), seen.end(), isDarker);
  std::vector<Color> palette;
  for (std::size_t k = 0; k < kColors && !seen.empty(); ++k) {
    palette.push_back(seen[(2 * k + 1) * seen.size() / (2 * kColors)]);
  }
  for (int turn = 0; turn < kLloydSteps; ++turn) {
    std::vector<Color> sums(palette.size(), Color::Zero());
    std::vector<float> counts(palette.size(), 0.0f);
    for (const Color& color : seen) {
      const auto k = static_cast<std::size_t>(nearest(palette, color));
      sums[k] += color;
      counts[k] += 1.0f;
    }
    for (std::size_t k = 0; k < palette.size(); ++k) {
      if (counts[k] > 0.0f) palette[k] = sums[k] / counts[k];
    }
  }
  std::stable_sort(palette.begin(), palette.end(), isDarker);
  return palette;
}

}  // namespace

PaletteImage paletteImage(const TextureGrid& grid, const std::vector<RectifiedView>& views,
                          double max_pixels) {
  PaletteImage result;
  const double step = std::sqrt(grid.width * grid.height / max_pixels);
  result.step =
      std::clamp(static_cast<int>(std::lround(step)), 1, std::min(grid.width, grid.height));
  std::vector<CoarseView> coarse(views.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(views.size()); ++k) {
    const auto view = static_cast<std::size_t>(k);
    coarse[view] = shrink(grid, views[view], result.step);
  }
  const int width = grid.width / result.step;
  const int height = grid.height / result.step;
  result.colors = Eigen::ArrayXXi::Constant(height, width, PaletteImage::kUnseen);
  if (coarse.empty() || result.colors.size() == 0) return result;
  std::vector<Color> image = medianImage(coarse);
  for (CoarseView& view : coarse) level(image, view);
  image = medianImage(coarse);
  const std::vector<Color> palette = paletteOf(image);
  result.num_colors = static_cast<int>(palette.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color& color = image[static_cast<std::size_t>(y * width + x)];
      if (isSeen(color)) result.colors(y, x) = nearest(palette, color);
    }
  }
  return result;
}

}  // namespace storey::detail
