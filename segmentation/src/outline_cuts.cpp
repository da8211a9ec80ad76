// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/outline_cuts.h>

#include <cmath>

namespace storey::detail {
namespace {

void tie(const EdgeRange& edges, LabelCut& cut) {
  for (std::size_t e = edges.first; e <= edges.last; ++e) cut.tie(e);
}

// The energy of labels: cells one by one, then the edges of the runs that bound them.
double energyAlong(const std::vector<OutlineRun>& runs, const CellTerms& terms, double gap,
                   const std::vector<char>& inside) {
  double energy = 0.0;
  for (std::size_t c = 0; c < inside.size(); ++c) {
    if (inside[c] != 0) energy += terms.unary[c];
  }
  for (const OutlineRun& run : runs) {
    for (std::size_t e = run.first; e <= run.last; ++e) {
      energy +=
          gap * (terms.area[e] - std::abs(terms.signed_area[e])) - run.side * terms.signed_area[e];
    }
  }
  return energy;
}

}  // namespace

OutlineCuts::OutlineCuts(const LineArrangement& plan, double gap, unsigned int threads,
                         std::vector<CellBlock>& blocks)
    : plan_(plan), gap_(gap), blocks_(blocks), crew_(threadsFor(threads)) {
  for (const CellBlock& block : blocks) {
    BlockLabels labels{block.inside, block.energy, runsOf(plan, block.terms, block.inside)};
    outlines_.push_back({LabelCut(plan, block.terms, gap), std::move(labels), {}, {}});
  }
  crew_.run(outlines_.size(), [&](std::size_t b) {
    outlines_[b].cut.solve();  // once; the others go on from there
  });
}

const BlockLabels& OutlineCuts::without(const EdgeRange& edges, std::size_t block) {
  auto& known = outlines_[block].without;
  const auto found = known.find(edges);
  return found != known.end() ? found->second
                              : known.emplace(edges, cutWithout(edges, block)).first->second;
}

void OutlineCuts::cutAhead(const std::set<std::pair<std::size_t, EdgeRange>>& asked) {
  if (!cutsAhead()) return;
  std::vector<std::pair<std::size_t, EdgeRange>> missing;
  for (const auto& [block, edges] : asked) {
    if (outlines_[block].without.count(edges) == 0) missing.emplace_back(block, edges);
  }
  std::vector<BlockLabels> found(missing.size());
  crew_.run(missing.size(),
            [&](std::size_t i) { found[i] = cutWithout(missing[i].second, missing[i].first); });
  for (std::size_t i = 0; i < missing.size(); ++i) {
    outlines_[missing[i].first].without.emplace(missing[i].second, std::move(found[i]));
  }
}

void OutlineCuts::take(const EdgeRange& edges, std::size_t block) {
  Outline& outline = outlines_[block];
  outline.labels = std::move(outline.without.at(edges));
  outline.without.clear();
  tie(edges, outline.cut);
  outline.cut.solve();
  forgetMerges(block);
}

void OutlineCuts::cutAllMerged() {
  std::vector<std::size_t> missing;
  for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
    if (!outlines_[b].merged) missing.push_back(b);
  }
  crew_.run(missing.size(), [&](std::size_t i) {
    outlines_[missing[i]].merged = std::make_unique<Outline>(cutMerged(missing[i]));
  });
}

void OutlineCuts::takeMerge(std::size_t block) {
  const auto upper = static_cast<std::ptrdiff_t>(block) + 1;
  blocks_[block].terms = termsOfMerge(block);
  blocks_[block].last_bin = blocks_[block + 1].last_bin;
  outlines_[block] = Outline(std::move(*outlines_[block].merged));
  forgetMerges(block);
  blocks_.erase(blocks_.begin() + upper);
  outlines_.erase(outlines_.begin() + upper);
}

void OutlineCuts::writeBack() {
  for (std::size_t b = 0; b < outlines_.size(); ++b) {
    blocks_[b].inside = outlines_[b].labels.inside;
    blocks_[b].energy = outlines_[b].labels.energy;
  }
}

BlockLabels OutlineCuts::cutAgain(const CellTerms& terms, LabelCut& cut) const {
  BlockLabels labels;
  labels.inside = cut.solve();
  labels.runs = runsOf(plan_, terms, labels.inside);
  labels.energy = energyAlong(labels.runs, terms, gap_, labels.inside);
  return labels;
}

BlockLabels OutlineCuts::cutWithout(const EdgeRange& edges, std::size_t block) const {
  LabelCut cut = outlines_[block].cut;
  tie(edges, cut);
  return cutAgain(blocks_[block].terms, cut);
}

OutlineCuts::Outline OutlineCuts::cutMerged(std::size_t block) const {
  const CellTerms terms = termsOfMerge(block);
  Outline merged{LabelCut(plan_, terms, gap_), {}, {}, {}};
  for (std::size_t e = 0; e < plan_.edges.size(); ++e) {
    if (outlines_[block].cut.tied(e) && outlines_[block + 1].cut.tied(e)) merged.cut.tie(e);
  }
  merged.labels = cutAgain(terms, merged.cut);
  return merged;
}

CellTerms OutlineCuts::termsOfMerge(std::size_t block) const {
  CellTerms terms = blocks_[block].terms;
  terms.add(blocks_[block + 1].terms);
  return terms;
}

void OutlineCuts::forgetMerges(std::size_t block) {
  outlines_[block].merged.reset();
  if (block > 0) outlines_[block - 1].merged.reset();
}

}  // namespace storey::detail
