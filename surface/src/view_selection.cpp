// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/alpha_expansion.h>
#include <storey/surface/detail/view_selection.h>

#include <algorithm>

namespace storey::detail {
namespace {

constexpr double kHiddenCost = 4.0;
constexpr double kSeamCost = 0.5;
constexpr double kNoView = 1e3;  // a photo that does not show a block at all

std::vector<int> photosOf(const std::vector<std::vector<BlockView>>& views) {
  std::vector<int> photos;
  for (const auto& here : views) {
    for (const BlockView& view : here) photos.push_back(view.photo);
  }
  std::sort(photos.begin(), photos.end());
  photos.erase(std::unique(photos.begin(), photos.end()), photos.end());
  return photos;
}

double costOf(const BlockView& view) {
  const double shown = static_cast<double>(view.numShown()) / kCells;
  return 1.0 - view.quality + 0.25 * std::min(view.deviation, 1.0f) +
         (view.hidden ? kHiddenCost : 0.0) + kHiddenCost * (1.0 - shown);
}

}  // namespace

std::vector<int> selectViews(const TextureGrid& grid,
                             const std::vector<std::vector<BlockView>>& views) {
  const std::vector<int> photos = photosOf(views);
  std::vector<std::size_t> node_of(views.size(), views.size());
  std::vector<std::size_t> block_of;
  PottsProblem problem;
  problem.num_labels = photos.size();
  for (std::size_t b = 0; b < views.size(); ++b) {
    if (views[b].empty()) continue;
    node_of[b] = block_of.size();
    block_of.push_back(b);
    std::vector<double> costs(photos.size(), kNoView);
    for (const BlockView& view : views[b]) {
      const auto label = std::lower_bound(photos.begin(), photos.end(), view.photo);
      costs[static_cast<std::size_t>(label - photos.begin())] = costOf(view);
    }
    problem.data_costs.insert(problem.data_costs.end(), costs.begin(), costs.end());
  }
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (std::size_t b = 0; b < views.size(); ++b) {
    if (views[b].empty()) continue;
    const bool has_right = (b + 1) % columns != 0 && !views[b + 1].empty();
    const bool has_below = b + columns < views.size() && !views[b + columns].empty();
    if (has_right) problem.edges.push_back({node_of[b], node_of[b + 1], kSeamCost});
    if (has_below) problem.edges.push_back({node_of[b], node_of[b + columns], kSeamCost});
  }
  std::vector<int> selected(views.size(), -1);
  if (block_of.empty()) return selected;
  const std::vector<std::size_t> labels = minimizePotts(problem);
  for (std::size_t node = 0; node < block_of.size(); ++node) {
    const auto& here = views[block_of[node]];
    for (std::size_t v = 0; v < here.size(); ++v) {
      if (here[v].photo == photos[labels[node]]) selected[block_of[node]] = static_cast<int>(v);
    }
  }
  return selected;
}

}  // namespace storey::detail
