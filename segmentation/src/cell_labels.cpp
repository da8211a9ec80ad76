// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/task_crew.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace storey::detail {

void CellBlock::measureCoverage() {
  coverage.resize(terms.area.size());
  for (std::size_t e = 0; e < coverage.size(); ++e) {
    coverage[e] = terms.area[e] > 0.0 ? terms.signed_area[e] / terms.area[e] : 0.0;
  }
}

namespace {

constexpr double kClearly = 0.01;  // of the cost of a block: more than rounding

// The layers from one on upwards, one more at a time: its cut goes on from the one before.
class GrowingRange {
 public:
  GrowingRange(const LineArrangement& plan, const std::vector<CellTerms>& layers, std::size_t start,
               double gap)
      : plan_(plan), gap_(gap), sum_(layers[start]), cut_(makeCut(layers, start)) {}

  /// Of the best labelling with this layer, the next one, as well.
  double energyWith(const CellTerms& layer) {
    if (!empty_) sum_.add(layer);
    empty_ = false;
    cut_.raiseTo(sum_);
    return energyOf(plan_, sum_, gap_, cut_.solve());
  }

 private:
  LabelCut makeCut(const std::vector<CellTerms>& layers, std::size_t start) const {
    CellTerms all = layers[start];
    for (std::size_t l = start + 1; l < layers.size(); ++l) all.add(layers[l]);
    return LabelCut::ofRising(plan_, all, gap_);
  }

  const LineArrangement& plan_;
  double gap_;
  CellTerms sum_;  // with the first layer from the beginning
  LabelCut cut_;
  bool empty_ = true;
};

// The starts of the blocks of the partition with the least sum of energies, each with `cost` added,
// by dynamic programming, and the end of the last. Two ranges never have more energy than both as
// one: once the best partition up to some end is cheaper than one that ends with a range does even
// without that range's cost, dividing it there is better for all ends to come, and it is left
// alone (PELT; Killick, Fearnhead, Eckley 2012).
std::vector<std::size_t> bestPartition(const LineArrangement& plan,
                                       const std::vector<CellTerms>& layers, double gap,
                                       double cost, unsigned int threads) {
  std::vector<double> best(layers.size() + 1, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(layers.size() + 1, 0);
  best[0] = 0.0;
  std::vector<std::unique_ptr<GrowingRange>> ranges(layers.size());
  std::vector<double> energies(layers.size());
  std::vector<std::size_t> open;  // starts, ascending
  TaskCrew crew(threadsFor(threads));
  for (std::size_t end = 1; end <= layers.size(); ++end) {
    open.push_back(end - 1);
    crew.run(open.size(), [&](std::size_t i) {
      const std::size_t start = open[open.size() - 1 - i];
      if (start + 1 == end)
        ranges[start] = std::make_unique<GrowingRange>(plan, layers, start, gap);
      energies[start] = best[start] + ranges[start]->energyWith(layers[end - 1]);
    });
    for (const std::size_t start : open) {
      if (energies[start] + cost >= best[end]) continue;
      best[end] = energies[start] + cost;
      from[end] = start;
    }
    const auto closed = std::remove_if(open.begin(), open.end(), [&](std::size_t start) {
      if (energies[start] <= best[end] + kClearly * cost) return false;
      ranges[start].reset();
      return true;
    });
    open.erase(closed, open.end());
  }
  std::vector<std::size_t> bounds = {layers.size()};
  while (bounds.back() > 0) bounds.push_back(from[bounds.back()]);
  std::reverse(bounds.begin(), bounds.end());
  return bounds;
}

}  // namespace

std::vector<CellBlock> labelCells(const LineArrangement& plan, const WallEvidence& evidence,
                                  const std::vector<std::size_t>& levels,
                                  const std::vector<LevelPoint>& level_points,
                                  const CellEnergyOptions& options, unsigned int threads) {
  if (levels.size() < 2) return {};
  const std::vector<CellTerms> layers =
      termsOfLayers(plan, evidence, levels, level_points, options.level, threads);
  const std::vector<std::size_t> bounds =
      bestPartition(plan, layers, options.gap, options.block, threads);
  std::vector<CellBlock> blocks;
  for (std::size_t b = 0; b + 1 < bounds.size(); ++b) {
    CellBlock block{levels[bounds[b]], levels[bounds[b + 1]], 0.0, {}, layers[bounds[b]], {}};
    for (std::size_t l = bounds[b] + 1; l < bounds[b + 1]; ++l) block.terms.add(layers[l]);
    block.energy = minimumCut(plan, block.terms, options.gap, block.inside);
    block.measureCoverage();
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace storey::detail
