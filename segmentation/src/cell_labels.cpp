// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace storey::detail {

void CellBlock::measureCoverage() {
  coverage.resize(terms.area.size());
  for (std::size_t e = 0; e < coverage.size(); ++e) {
    coverage[e] = terms.area[e] > 0.0 ? terms.signed_area[e] / terms.area[e] : 0.0;
  }
}

namespace {

// Of all ranges of layers, the energy of the best labelling: [start][end - start - 1]. From a range
// to one with a layer more its cut goes on.
std::vector<std::vector<double>> energiesOf(const LineArrangement& plan,
                                            const std::vector<CellTerms>& layers, double gap,
                                            unsigned int threads) {
  std::vector<std::vector<double>> energies(layers.size());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t s = 0; s < static_cast<std::ptrdiff_t>(layers.size()); ++s) {
    const auto start = static_cast<std::size_t>(s);
    CellTerms all = layers[start];
    for (std::size_t l = start + 1; l < layers.size(); ++l) all.add(layers[l]);
    LabelCut cut = LabelCut::ofRising(plan, all, gap);
    CellTerms sum = layers[start];
    for (std::size_t end = start + 1; end <= layers.size(); ++end) {
      if (end > start + 1) sum.add(layers[end - 1]);
      cut.raiseTo(sum);
      energies[start].push_back(energyOf(plan, sum, gap, cut.solve()));
    }
  }
  return energies;
}

// The starts of the ranges of the partition with the least sum of energies, each with `cost` added,
// by dynamic programming; and the end of the last.
std::vector<std::size_t> bestPartition(const std::vector<std::vector<double>>& energies,
                                       double cost) {
  const std::size_t num_layers = energies.size();
  std::vector<double> best(num_layers + 1, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(num_layers + 1, 0);
  best[0] = 0.0;
  for (std::size_t start = 0; start < num_layers; ++start) {
    for (std::size_t end = start + 1; end <= num_layers; ++end) {
      const double energy = best[start] + cost + energies[start][end - start - 1];
      if (energy >= best[end]) continue;
      best[end] = energy;
      from[end] = start;
    }
  }
  std::vector<std::size_t> bounds = {num_layers};
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
      termsOfLayers(plan, evidence, levels, level_points, options.level);
  const std::vector<std::size_t> bounds =
      bestPartition(energiesOf(plan, layers, options.gap, threads), options.block);
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
