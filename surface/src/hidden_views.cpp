// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/hidden_views.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace storey::detail {
namespace {

constexpr float kLeastRadius = 2.0f;       // grey levels: rounding, in case photos agree exactly
constexpr float kLeastContrast = 0.03f;    // of the brightness: what levelling exposures leaves
constexpr float kLeastOfContrast = 0.15f;  // about the block: sharpness and parallax differ
constexpr float kLimit = 3.0f;             // radii of the group
constexpr float kLeastShare = 0.4f;        // of the views: with fewer votes, photos just differ
constexpr float kVotesOfFacade = 3.0f;
constexpr std::size_t kFewestViews = 3;

/// Largest over the cells that both show of the mean difference of the channels; infinite without
/// such a cell.
float difference(const BlockView& a, const BlockView& b, const std::vector<Eigen::Array3f>& gains) {
  float largest = -1.0f;
  for (std::size_t c = 0; c < kCells; ++c) {
    if (!a.shown[c] || !b.shown[c]) continue;
    const Eigen::Array3f apart = a.colors[c] * gains[static_cast<std::size_t>(a.photo)] -
                                 b.colors[c] * gains[static_cast<std::size_t>(b.photo)];
    largest = std::max(largest, apart.abs().mean());
  }
  return largest < 0.0f ? std::numeric_limits<float>::infinity() : largest;
}

using Distances = std::vector<std::vector<float>>;

Distances distancesBetween(const std::vector<BlockView>& views,
                           const std::vector<Eigen::Array3f>& gains) {
  Distances distances(views.size(), std::vector<float>(views.size(), 0.0f));
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      distances[i][j] = distances[j][i] = difference(views[i], views[j], gains);
    }
  }
  return distances;
}

/// Radius of the densest group: the least distance within which a view has a quarter of the
/// others, at least one.
float densestRadius(const Distances& distances) {
  const std::size_t neighbors = std::max<std::size_t>(1, distances.size() / 4);
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < distances.size(); ++i) {
    std::vector<float> others = distances[i];
    const auto last = others.begin() + static_cast<std::ptrdiff_t>(neighbors);  // itself is first
    std::nth_element(others.begin(), last, others.end());
    least = std::min(least, *last);
  }
  return least;
}

/// Median over the blocks of the radius of their densest group.
float usualRadius(const std::vector<Eigen::Array3f>& gains,
                  const std::vector<std::vector<BlockView>>& views) {
  std::vector<float> radii(views.size(), std::numeric_limits<float>::infinity());
  const auto num_blocks = static_cast<std::ptrdiff_t>(views.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::ptrdiff_t b = 0; b < num_blocks; ++b) {
    const auto block = static_cast<std::size_t>(b);
    if (views[block].size() < kFewestViews) continue;
    radii[block] = densestRadius(distancesBetween(views[block], gains));
  }
  radii.erase(std::remove_if(radii.begin(), radii.end(), [](float r) { return !std::isfinite(r); }),
              radii.end());
  if (radii.empty()) return kLeastRadius;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return std::max(*middle, kLeastRadius);
}

Eigen::Array3f levelledColor(const BlockView& view, const std::vector<Eigen::Array3f>& gains) {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (std::size_t c = 0; c < kCells; ++c) {
    if (view.shown[c]) sum += view.colors[c];
  }
  return sum / static_cast<float>(view.numShown()) * gains[static_cast<std::size_t>(view.photo)];
}

struct Range {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
};

void extendRange(const BlockView& view, Range& range) {
  for (std::size_t c = 0; c < kCells; ++c) {
    if (!view.shown[c]) continue;
    range.low = std::min(range.low, view.colors[c].mean());
    range.high = std::max(range.high, view.colors[c].mean());
  }
}

/// For each view of a block the difference between the brightest and the darkest cell that the
/// photo shows in the 3 x 3 blocks about it.
void measureContrasts(const TextureGrid& grid, std::vector<std::vector<BlockView>>& views) {
#pragma omp parallel for schedule(dynamic, 1)
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      for (BlockView& view : views[grid.block(column, row)]) {
        Range range;
        for (int i = 0; i < 9; ++i) {
          const int c = std::clamp(column + i % 3 - 1, 0, grid.columns - 1);
          const int r = std::clamp(row + i / 3 - 1, 0, grid.rows - 1);
          const BlockView* const other = findView(views[grid.block(c, r)], view.photo);
          if (other != nullptr) extendRange(*other, range);
        }
        view.contrast = range.high - range.low;
      }
    }
  }
}

/// How far from a view others may be that show the same.
float limitAbout(const BlockView& view, const Eigen::Array3f& color, float radius, float usual) {
  return kLimit *
         std::max({radius, usual, kLeastContrast * color.mean(), kLeastOfContrast * view.contrast});
}

/// How common colours are on a facade: a histogram over the blocks about which all photos agree.
class Familiarity {
 public:
  Familiarity(const std::vector<Eigen::Array3f>& gains,
              const std::vector<std::vector<BlockView>>& views, float usual)
      : counts_(kBins * kBins * kBins, 0.0f) {
    for (const auto& here : views) {
      if (here.size() < kFewestViews) continue;
      const Eigen::Array3f color = levelledColor(here[0], gains);
      const float limit = limitAbout(here[0], color, 0.0f, usual);
      const bool agreed = std::all_of(here.begin(), here.end(), [&](const BlockView& view) {
        return difference(here[0], view, gains) <= limit;
      });
      if (!agreed) continue;
      counts_[binOf(color)] += 1.0f;
      total_ += 1.0f;
    }
  }

  /// From 0 for a colour of no block to 1 for one that is as common as can be expected of a colour
  /// of the facade: a hundredth of the blocks.
  float of(const Eigen::Array3f& color) const {
    constexpr float kCommon = 0.01f;
    return total_ > 0.0f ? std::min(1.0f, counts_[binOf(color)] / (kCommon * total_)) : 0.0f;
  }

 private:
  static constexpr int kBins = 12;  // of each channel

  static std::size_t binOf(const Eigen::Array3f& color) {
    std::size_t bin = 0;
    for (int c = 0; c < 3; ++c) {
      const int at = std::clamp(static_cast<int>(color[c] * kBins / 256.0f), 0, kBins - 1);
      bin = bin * kBins + static_cast<std::size_t>(at);
    }
    return bin;
  }

  std::vector<float> counts_;
  float total_ = 0.0f;
};

/// Sets the deviations of a block's views from the group that has most votes.
void findHiddenIn(const std::vector<Eigen::Array3f>& gains, const Familiarity& familiarity,
                  float usual, std::vector<BlockView>& views) {
  if (views.size() < kFewestViews) return;
  const Distances distances = distancesBetween(views, gains);
  const float radius = densestRadius(distances);
  if (!std::isfinite(radius)) return;
  float sharpest = 0.0f;
  for (const BlockView& view : views) sharpest = std::max(sharpest, view.quality);
  std::size_t best = 0;
  float best_limit = 0.0f;
  float most_votes = -1.0f;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Array3f color = levelledColor(views[i], gains);
    const float limit = limitAbout(views[i], color, radius, usual);
    float votes = kVotesOfFacade * familiarity.of(color);
    for (std::size_t j = 0; j < views.size(); ++j) {
      if (distances[i][j] <= limit) votes += std::min(1.0f, 2.0f * views[j].quality / sharpest);
    }
    if (votes > most_votes) {
      most_votes = votes;
      best = i;
      best_limit = limit;
    }
  }
  const bool clear = most_votes >= std::max(static_cast<float>(kFewestViews),
                                            kLeastShare * static_cast<float>(views.size()));
  for (std::size_t j = 0; j < views.size(); ++j) {
    const float apart = distances[best][j];
    views[j].deviation = std::isfinite(apart) ? apart / best_limit : 0.0f;
    views[j].hidden = clear && views[j].deviation > 1.0f;
  }
}

/// Beside a block in which something hides a photo, a third of the limit is enough: its edge.
void spreadHidden(const TextureGrid& grid, std::vector<std::vector<BlockView>>& views) {
  constexpr float kEdge = 1.0f / 3.0f;
  std::vector<BlockView*> edge;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      for (BlockView& view : views[grid.block(column, row)]) {
        if (view.hidden || view.deviation < kEdge) continue;
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          const int c = std::clamp(column + dx, 0, grid.columns - 1);
          const int r = std::clamp(row + dy, 0, grid.rows - 1);
          const BlockView* const beside = findView(views[grid.block(c, r)], view.photo);
          if (beside == nullptr || !beside->hidden) continue;
          edge.push_back(&view);
          break;
        }
      }
    }
  }
  for (BlockView* const view : edge) view->hidden = true;
}

}  // namespace

const BlockView* findView(const std::vector<BlockView>& views, int photo) {
  const auto found = std::lower_bound(views.begin(), views.end(), photo,
                                      [](const BlockView& v, int p) { return v.photo < p; });
  return found != views.end() && found->photo == photo ? &*found : nullptr;
}

void findHidden(const TextureGrid& grid, const std::vector<Eigen::Array3f>& gains,
                std::vector<std::vector<BlockView>>& views) {
  measureContrasts(grid, views);
  const float usual = usualRadius(gains, views);
  const Familiarity familiarity(gains, views, usual);
  const auto num_blocks = static_cast<std::ptrdiff_t>(views.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::ptrdiff_t b = 0; b < num_blocks; ++b) {
    findHiddenIn(gains, familiarity, usual, views[static_cast<std::size_t>(b)]);
  }
  spreadHidden(grid, views);
}

}  // namespace storey::detail
