// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/transition_blocks.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace storey::detail {
namespace {

double costOf(const LineArrangement& plan, const std::vector<const CellBlock*>& blocks) {
  std::vector<std::vector<OutlineRun>> runs;
  std::vector<BlockOutline> outlines;
  for (const CellBlock* block : blocks) runs.push_back(runsOf(plan, block->terms, block->inside));
  for (std::size_t b = 0; b < blocks.size(); ++b)
    outlines.push_back({&blocks[b]->inside, &runs[b]});
  return complexityOf(plan, outlines);
}

// The terms of some bins of a block. What its horizontal points say is shared out by height.
CellTerms termsOfPart(const LineArrangement& plan, const WallEvidence& evidence,
                      const CellBlock& block, std::size_t first, std::size_t last) {
  CellTerms terms = termsOfBins(plan, evidence, first, last);
  const double share =
      static_cast<double>(last - first) / static_cast<double>(block.last_bin - block.first_bin);
  for (std::size_t c = 0; c < terms.unary.size(); ++c) {
    terms.unary[c] = share * block.terms.unary[c];
  }
  return terms;
}

// The bin to divide block b at. Energies of single bins do not add up where the evidence of an edge
// changes its sign, but they tell the place.
std::size_t bestBin(const LineArrangement& plan, const WallEvidence& evidence, double gap,
                    const std::vector<CellBlock>& blocks, std::size_t b) {
  const CellBlock& block = blocks[b];
  const std::size_t n = block.last_bin - block.first_bin;
  std::vector<double> below(n + 1, 0.0);  // running sums over the bins, with the neighbours' labels
  std::vector<double> above(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t bin = block.first_bin + i;
    const CellTerms terms = termsOfPart(plan, evidence, block, bin, bin + 1);
    below[i + 1] = below[i] + energyOf(plan, terms, gap, blocks[b - 1].inside);
    above[i + 1] = above[i] + energyOf(plan, terms, gap, blocks[b + 1].inside);
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    if (below[i] - above[i] < below[best] - above[best]) best = i;
  }
  return block.first_bin + best;
}

// A block with some bins of another.
CellBlock grown(const LineArrangement& plan, double gap, const CellBlock& block,
                const CellTerms& part) {
  CellBlock result = block;
  result.terms.add(part);
  result.energy = energyOf(plan, result.terms, gap, result.inside);
  result.measureCoverage();
  return result;
}

}  // namespace

void divideTransitions(const LineArrangement& plan, const WallEvidence& evidence, double gap,
                       double cost, std::vector<CellBlock>& blocks) {
  for (std::size_t b = 1; b + 1 < blocks.size();) {
    CellBlock& lower = blocks[b - 1];
    CellBlock& block = blocks[b];
    CellBlock& upper = blocks[b + 1];
    const std::size_t bin = bestBin(plan, evidence, gap, blocks, b);
    CellBlock below =
        grown(plan, gap, lower, termsOfPart(plan, evidence, block, block.first_bin, bin));
    CellBlock above =
        grown(plan, gap, upper, termsOfPart(plan, evidence, block, bin, block.last_bin));
    const double more = below.energy + above.energy - lower.energy - block.energy - upper.energy;
    const double saved = costOf(plan, {&lower, &block, &upper}) - costOf(plan, {&below, &above});
    if (more < cost * saved) {
      below.last_bin = above.first_bin = bin;
      lower = std::move(below);
      upper = std::move(above);
      blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(b));
      b = std::max<std::size_t>(b, 2) - 1;
    } else {
      ++b;
    }
  }
}

}  // namespace storey::detail
