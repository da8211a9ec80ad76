// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/task_crew.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
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

// Layers from one on upwards: a solved cut of their terms.
struct LayerRange {
  CellTerms terms;
  LabelCut cut;
  double energy;  // of the best labelling

  LayerRange(const LineArrangement& plan, const CellTerms& layer, double gap, double total)
      : terms(layer),
        cut(plan, layer, gap, total),
        energy(energyOf(plan, terms, gap, cut.solve())) {}

  // One more layer, the next one, on its own.
  void add(const LineArrangement& plan, const LayerRange& layer, double gap) {
    cut.add(layer.cut, terms, layer.terms);
    terms.add(layer.terms);
    energy = energyOf(plan, terms, gap, cut.solve());
  }
};

double sumOfCosts(const std::vector<CellTerms>& layers) {
  return std::accumulate(layers.begin(), layers.end(), 0.0, [](double sum, const CellTerms& layer) {
    return sum + sumOfCosts(layer);
  });
}

// The starts of the blocks of the partition with the least sum of energies, each with `cost` added,
// by dynamic programming, and the end of the last. Two ranges never have more energy than both as
// one: once the best partition up to some end is cheaper than one that ends with a range does even
// without that range's cost, dividing it there is better for all ends to come, and it is left
// alone (PELT; Killick, Fearnhead, Eckley 2012).
std::vector<std::size_t> bestPartition(const LineArrangement& plan,
                                       const std::vector<CellTerms>& layers, double gap,
                                       double cost, TaskCrew& crew) {
  std::vector<double> best(layers.size() + 1, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(layers.size() + 1, 0);
  best[0] = 0.0;
  const double total = sumOfCosts(layers);
  std::vector<std::unique_ptr<LayerRange>> ranges(layers.size());
  const auto energyFrom = [&](std::size_t start) { return best[start] + ranges[start]->energy; };
  std::vector<std::size_t> open;  // starts, ascending
  const auto ahead = static_cast<std::size_t>(crew.size());
  for (std::size_t end = 1; end <= layers.size(); ++end) {
    const std::size_t layer = end - 1;
    if (layer % ahead == 0) {
      crew.run(std::min(ahead, layers.size() - layer), [&](std::size_t i) {
        ranges[layer + i] = std::make_unique<LayerRange>(plan, layers[layer + i], gap, total);
      });
    }
    crew.run(open.size(), [&](std::size_t i) { ranges[open[i]]->add(plan, *ranges[layer], gap); });
    open.push_back(layer);
    for (const std::size_t start : open) {
      if (energyFrom(start) + cost >= best[end]) continue;
      best[end] = energyFrom(start) + cost;
      from[end] = start;
    }
    const auto closed = std::remove_if(open.begin(), open.end(), [&](std::size_t start) {
      if (energyFrom(start) <= best[end] + kClearly * cost) return false;
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
  TaskCrew crew(threadsFor(threads));
  const std::vector<std::size_t> bounds =
      bestPartition(plan, layers, options.gap, options.block, crew);
  std::vector<CellBlock> blocks(bounds.size() - 1);
  crew.run(blocks.size(), [&](std::size_t b) {
    CellBlock& block = blocks[b];
    block.first_bin = levels[bounds[b]];
    block.last_bin = levels[bounds[b + 1]];
    block.terms = layers[bounds[b]];
    for (std::size_t l = bounds[b] + 1; l < bounds[b + 1]; ++l) block.terms.add(layers[l]);
    block.energy = minimumCut(plan, block.terms, options.gap, block.inside);
    block.measureCoverage();
  });
  return blocks;
}

}  // namespace storey::detail
