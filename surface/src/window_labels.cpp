// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/color_mixture.h>
#include <storey/surface/detail/window_labels.h>

#include <cmath>

namespace storey::detail {
namespace {

std::vector<Eigen::Array3f> colorsOf(const RectifiedView& view, const std::vector<TexelMark>& marks,
                                     TexelMark mark) {
  std::vector<Eigen::Array3f> colors;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == mark && view.seen[i] != 0) colors.push_back(view.colors[i]);
  }
  return colors;
}

WindowScores labelView(const TextureGrid& grid, const RectifiedView& view,
                       const std::vector<TexelMark>& marks) {
  constexpr std::size_t kLeastTexels = 50;  // to learn the colours of a class
  WindowScores scores = WindowScores::Zero(grid.height, grid.width);
  const std::vector<Eigen::Array3f> marked = colorsOf(view, marks, TexelMark::Window);
  const std::vector<Eigen::Array3f> others = colorsOf(view, marks, TexelMark::Rest);
  if (marked.size() < kLeastTexels || others.size() < kLeastTexels) return scores;
  const ColorMixture window(marked);
  const ColorMixture rest(others);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const auto i = static_cast<std::size_t>(y * grid.width + x);
      if (view.seen[i] == 0) continue;
      const float odds = window.logDensity(view.colors[i]) - rest.logDensity(view.colors[i]);
      scores(y, x) = std::tanh(0.5f * odds);
    }
  }
  return scores;
}

}  // namespace

std::vector<WindowScores> labelTexels(const TextureGrid& grid,
                                      const std::vector<RectifiedView>& views,
                                      const std::vector<TexelMark>& marks) {
  std::vector<WindowScores> scores(views.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(views.size()); ++k) {
    const auto view = static_cast<std::size_t>(k);
    scores[view] = labelView(grid, views[view], marks);
  }
  return scores;
}

WindowScores combineScores(const std::vector<RectifiedView>& views,
                           const std::vector<WindowScores>& scores) {
  WindowScores sum = WindowScores::Zero(scores[0].rows(), scores[0].cols());
  WindowScores weights = WindowScores::Zero(sum.rows(), sum.cols());
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto weight = static_cast<float>(views[k].sharpness * views[k].sharpness);
    sum += weight * scores[k];
    weights += weight * (scores[k] != 0.0f).cast<float>();
  }
  return (weights > 0.0f).select(sum / weights, 0.0f);
}

}  // namespace storey::detail
