// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kTriedUpTo = 3.0;   // costs: what has more to show than this stays
constexpr double kLeastGain = 1e-9;  // of the cost, against endless exchanges

// A block while it is pruned.
struct Outline {
  CellBlock block;
  std::vector<char> tied;  // edges that may not bound it
  std::vector<OutlineRun> runs;
  std::set<std::pair<std::size_t, std::size_t>> tried;  // runs that earn their cost
};

class Pruning {
 public:
  Pruning(const LineArrangement& plan, double gap, double cost, bool may_vanish,
          std::vector<CellBlock>& blocks)
      : plan_(plan), gap_(gap), cost_(cost), may_vanish_(may_vanish) {
    for (CellBlock& block : blocks) {
      Outline outline;
      outline.block = std::move(block);
      outline.tied.assign(plan.edges.size(), 0);
      outline.runs = runsOf(plan, outline.block.terms, outline.block.inside);
      outlines_.push_back(std::move(outline));
    }
    objective_ = objectiveOf({});
  }

  std::vector<CellBlock> run() {
    dropLines();
    for (std::size_t b = 0; b < outlines_.size(); ++b) dropRuns(b);
    while (mergeBlocks()) {
    }
    dropLines();
    std::vector<CellBlock> blocks;
    for (Outline& outline : outlines_) blocks.push_back(std::move(outline.block));
    return blocks;
  }

 private:
  using Trials = std::map<std::size_t, Outline>;  // in place of the blocks of these numbers

  void cut(Outline& outline) const {
    CellBlock& block = outline.block;
    block.energy = minimumCut(plan_, block.terms, gap_, outline.tied, block.inside);
    outline.runs = runsOf(plan_, block.terms, block.inside);
  }

  // F. \param without a block that is left out, for its neighbour has taken it in
  double objectiveOf(const Trials& trials, std::size_t without = SIZE_MAX) const {
    std::vector<BlockOutline> stack;
    std::vector<char> used(plan_.lines.size(), 0);
    double energy = 0.0;
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      if (b == without) continue;
      const auto trial = trials.find(b);
      const Outline& outline = trial != trials.end() ? trial->second : outlines_[b];
      energy += outline.block.energy;
      stack.push_back({&outline.block.inside, &outline.runs});
      for (const OutlineRun& run : outline.runs) {
        used[static_cast<std::size_t>(plan_.edges[run.first].line)] = 1;
      }
    }
    const auto lines = std::count(used.begin(), used.end(), 1);
    if (lines == 0 && !may_vanish_) return std::numeric_limits<double>::infinity();
    return energy + cost_ * (complexityOf(plan_, stack) + static_cast<double>(lines));
  }

  bool acceptIfLower(Trials trials) {
    const double objective = objectiveOf(trials);
    if (objective >= objective_ - kLeastGain * cost_) return false;
    objective_ = objective;
    for (auto& [b, outline] : trials) outlines_[b] = std::move(outline);
    return true;
  }

  void dropRuns(std::size_t b) {
    while (dropRun(b)) {
    }
  }

  bool dropRun(std::size_t b) {
    std::vector<OutlineRun> runs = outlines_[b].runs;
    std::stable_sort(runs.begin(), runs.end(), [](const OutlineRun& one, const OutlineRun& other) {
      return one.seen < other.seen;
    });
    for (const OutlineRun& run : runs) {
      if (run.seen > kTriedUpTo * cost_) return false;
      if (!outlines_[b].tried.emplace(run.first, run.last).second) continue;
      if (acceptIfLower({{b, cutWithout(b, run)}})) return true;
      Trials face = cutWithoutFace(b, run);
      if (face.size() > 1 && acceptIfLower(std::move(face))) return true;
    }
    return false;
  }

  Outline cutWithout(std::size_t b, const OutlineRun& run) const {
    Outline trial = outlines_[b];
    std::fill(trial.tied.begin() + static_cast<std::ptrdiff_t>(run.first),
              trial.tied.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, char{1});
    cut(trial);
    return trial;
  }

  // Without the run and those that continue it in the blocks above and below.
  Trials cutWithoutFace(std::size_t b, const OutlineRun& run) const {
    Trials trials;
    trials.emplace(b, cutWithout(b, run));
    for (const int step : {1, -1}) {
      OutlineRun last = run;
      for (std::size_t next = b + static_cast<std::size_t>(step); next < outlines_.size();
           next += static_cast<std::size_t>(step)) {
        const std::vector<OutlineRun>& runs = outlines_[next].runs;
        const auto same = std::find_if(runs.begin(), runs.end(), [&](const OutlineRun& other) {
          return other.side == last.side && other.first <= last.last && last.first <= other.last;
        });
        if (same == runs.end()) break;
        last = *same;
        trials.emplace(next, cutWithout(next, last));
      }
    }
    return trials;
  }

  // The merge of two neighbours with the least F, if that is no higher: of equals one block is the
  // simpler description.
  bool mergeBlocks() {
    double best = objective_ + kLeastGain * cost_;
    std::size_t best_lower = SIZE_MAX;
    Outline best_outline;
    for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
      Outline merged = outlines_[b];
      const Outline& upper = outlines_[b + 1];
      merged.block.last_bin = upper.block.last_bin;
      merged.block.terms.add(upper.block.terms);
      for (std::size_t e = 0; e < merged.tied.size(); ++e) {
        merged.tied[e] = merged.tied[e] != 0 && upper.tied[e] != 0 ? 1 : 0;
      }
      merged.tried.clear();
      cut(merged);
      const double objective = objectiveOf({{b, merged}}, b + 1);
      if (objective >= best) continue;
      best = objective;
      best_lower = b;
      best_outline = std::move(merged);
    }
    if (best_lower == SIZE_MAX) return false;
    objective_ = best;
    outlines_[best_lower] = std::move(best_outline);
    outlines_.erase(outlines_.begin() + static_cast<std::ptrdiff_t>(best_lower) + 1);
    dropRuns(best_lower);
    return true;
  }

  // Area that each line shows in all blocks; negative: it bounds nothing.
  std::vector<double> seenByLine() const {
    std::vector<double> seen(plan_.lines.size(), -1.0);
    for (const Outline& outline : outlines_) {
      for (const OutlineRun& run : outline.runs) {
        double& sum = seen[static_cast<std::size_t>(plan_.edges[run.first].line)];
        sum = std::max(0.0, sum) + run.seen;
      }
    }
    return seen;
  }

  void dropLines() {
    const std::vector<double> seen = seenByLine();
    std::vector<std::size_t> order;
    for (std::size_t l = 0; l < seen.size(); ++l) {
      if (seen[l] >= 0.0 && seen[l] <= kTriedUpTo * cost_) order.push_back(l);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return seen[a] < seen[b]; });
    for (const std::size_t line : order) dropLine(line);
  }

  void dropLine(std::size_t line) {
    Trials trials;
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      const std::vector<OutlineRun>& runs = outlines_[b].runs;
      const bool used = std::any_of(runs.begin(), runs.end(), [&](const OutlineRun& run) {
        return static_cast<std::size_t>(plan_.edges[run.first].line) == line;
      });
      if (!used) continue;
      Outline trial = outlines_[b];
      for (std::size_t e = 0; e < trial.tied.size(); ++e) {
        if (static_cast<std::size_t>(plan_.edges[e].line) == line) trial.tied[e] = 1;
      }
      cut(trial);
      trials.emplace(b, std::move(trial));
    }
    if (!trials.empty()) acceptIfLower(std::move(trials));
  }

  const LineArrangement& plan_;
  double gap_;
  double cost_;
  bool may_vanish_;
  std::vector<Outline> outlines_;
  double objective_ = 0.0;
};

}  // namespace

void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks, bool may_vanish) {
  if (!(cost > 0.0) || blocks.empty()) return;
  blocks = Pruning(plan, gap, cost, may_vanish, blocks).run();
  for (CellBlock& block : blocks) block.measureCoverage();
}

}  // namespace storey::detail
