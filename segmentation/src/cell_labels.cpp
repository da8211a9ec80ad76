// SPDX-License-Identifier: BSD-3-Clause
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

std::vector<CellBlock> labelCells(const LineArrangement& plan, const WallEvidence& evidence,
                                  const std::vector<std::size_t>& levels,
                                  const std::vector<LevelPoint>& level_points,
                                  const CellEnergyOptions& options) {
  if (levels.size() < 2) return {};
  const std::size_t num_layers = levels.size() - 1;
  const std::vector<CellTerms> layers =
      termsOfLayers(plan, evidence, levels, level_points, options.level);
  // Dynamic programming over the partitions: best[k] is the least energy of the layers below k.
  std::vector<double> best(num_layers + 1, std::numeric_limits<double>::infinity());
  std::vector<CellBlock> last(num_layers + 1);
  std::vector<std::size_t> from(num_layers + 1, 0);
  best[0] = 0.0;
  for (std::size_t start = 0; start < num_layers; ++start) {
    CellTerms sum = layers[start];
    for (std::size_t end = start + 1; end <= num_layers; ++end) {
      if (end > start + 1) sum.add(layers[end - 1]);
      CellBlock block{levels[start], levels[end], 0.0, {}, sum, {}};
      block.energy = minimumCut(plan, sum, options.gap, block.inside);
      const double energy = best[start] + options.block + block.energy;
      if (energy >= best[end]) continue;
      best[end] = energy;
      from[end] = start;
      last[end] = std::move(block);
    }
  }
  std::vector<CellBlock> blocks;
  for (std::size_t k = num_layers; k > 0; k = from[k]) blocks.push_back(std::move(last[k]));
  std::reverse(blocks.begin(), blocks.end());
  for (CellBlock& block : blocks) block.measureCoverage();
  return blocks;
}

}  // namespace storey::detail
