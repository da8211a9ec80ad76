// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/transition_blocks.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

// Dividing block b at the bin that suits the labels of its neighbours best.
struct Division {
  std::size_t bin = 0;
  double energy = std::numeric_limits<double>::infinity();  // of its bins with those labels
};

Division bestDivision(const LineArrangement& plan, const WallEvidence& evidence, double gap,
                      const std::vector<CellBlock>& blocks, std::size_t b) {
  const CellBlock& block = blocks[b];
  const std::size_t n = block.last_bin - block.first_bin;
  std::vector<double> below(n + 1, 0.0);  // running sums over the bins
  std::vector<double> above(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t bin = block.first_bin + i;
    const CellTerms terms = termsOfPart(plan, evidence, block, bin, bin + 1);
    below[i + 1] = below[i] + energyOf(plan, terms, gap, blocks[b - 1].inside);
    above[i + 1] = above[i] + energyOf(plan, terms, gap, blocks[b + 1].inside);
  }
  Division best;
  for (std::size_t i = 0; i <= n; ++i) {
    const double energy = below[i] + above[n] - above[i];
    if (energy < best.energy) best = {block.first_bin + i, energy};
  }
  return best;
}

void divide(const LineArrangement& plan, const WallEvidence& evidence, const Division& division,
            double gap, std::vector<CellBlock>& blocks, std::size_t b) {
  const CellBlock block = std::move(blocks[b]);
  CellBlock& lower = blocks[b - 1];
  CellBlock& upper = blocks[b + 1];
  lower.terms.add(termsOfPart(plan, evidence, block, block.first_bin, division.bin));
  upper.terms.add(termsOfPart(plan, evidence, block, division.bin, block.last_bin));
  lower.last_bin = upper.first_bin = division.bin;
  for (CellBlock* grown : {&lower, &upper}) {
    grown->energy = energyOf(plan, grown->terms, gap, grown->inside);
    grown->measureCoverage();
  }
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(b));
}

}  // namespace

void divideTransitions(const LineArrangement& plan, const WallEvidence& evidence, double gap,
                       double cost, std::vector<CellBlock>& blocks) {
  for (std::size_t b = 1; b + 1 < blocks.size();) {
    const Division division = bestDivision(plan, evidence, gap, blocks, b);
    const double now = costOf(plan, {&blocks[b - 1], &blocks[b], &blocks[b + 1]});
    const double saved = now - costOf(plan, {&blocks[b - 1], &blocks[b + 1]});
    if (division.energy - blocks[b].energy < cost * saved) {
      divide(plan, evidence, division, gap, blocks, b);
      b = std::max<std::size_t>(b, 2) - 1;
    } else {
      ++b;
    }
  }
}

}  // namespace storey::detail
