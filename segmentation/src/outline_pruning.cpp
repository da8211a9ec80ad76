// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kTriedUpTo = 3.0;   // costs: what has more to show than this stays
constexpr double kLeastGain = 1e-9;  // of the cost, against endless exchanges

// The outline of a block, and the cut that found it.
struct Outline {
  LabelCut cut;
  std::vector<char> inside;
  double energy = 0.0;
  std::vector<OutlineRun> runs;
};

class Pruning {
 public:
  Pruning(const LineArrangement& plan, double gap, double cost, bool may_vanish,
          std::vector<CellBlock>& blocks)
      : plan_(plan),
        neighbors_(plan),
        gap_(gap),
        cost_(cost),
        may_vanish_(may_vanish),
        blocks_(blocks) {
    for (const CellBlock& block : blocks) {
      Outline outline{LabelCut(plan, block.terms, gap), block.inside, block.energy, {}};
      outline.cut.solve();  // once; trials go on from there
      outline.runs = runsOf(plan, block.terms, block.inside);
      outlines_.push_back(std::move(outline));
    }
    tried_.resize(blocks.size());
    measureJoints();
    objective_ = objectiveOf(stackOf({}), joints_);
  }

  void run() {
    dropLines();
    for (std::size_t b = 0; b < outlines_.size(); ++b) dropRuns(b);
    while (mergeBlocks()) {
    }
    dropLines();
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      blocks_[b].inside = std::move(outlines_[b].inside);
      blocks_[b].energy = outlines_[b].energy;
    }
  }

 private:
  using Trials = std::map<std::size_t, Outline>;  // in place of the outlines of these blocks
  using Stack = std::vector<const Outline*>;

  void cutAgain(const CellTerms& terms, Outline& outline) const {
    outline.inside = outline.cut.solve();
    outline.energy = energyOf(plan_, terms, gap_, outline.inside);
    outline.runs = runsOf(plan_, terms, outline.inside);
  }

  Stack stackOf(const Trials& trials) const {
    Stack stack;
    for (const Outline& outline : outlines_) stack.push_back(&outline);
    for (const auto& [b, outline] : trials) stack[b] = &outline;
    return stack;
  }

  // What the joint below a block of the stack costs; above the last block there is one more.
  double jointOf(const Stack& stack, std::size_t b) const {
    return jointComplexity(neighbors_, b > 0 ? &stack[b - 1]->inside : nullptr,
                           b < stack.size() ? &stack[b]->inside : nullptr);
  }

  void measureJoints() {
    const Stack stack = stackOf({});
    joints_.clear();
    for (std::size_t b = 0; b <= stack.size(); ++b) joints_.push_back(jointOf(stack, b));
  }

  // F. A line that was guessed costs nothing to describe: it follows from the ends of others.
  double objectiveOf(const Stack& stack, const std::vector<double>& joints) const {
    std::vector<const std::vector<OutlineRun>*> runs;
    std::vector<char> used(plan_.lines.size(), 0);
    double energy = 0.0;
    for (const Outline* outline : stack) {
      energy += outline->energy;
      runs.push_back(&outline->runs);
      for (const OutlineRun& run : outline->runs) {
        const auto line = static_cast<std::size_t>(plan_.edges[run.first].line);
        used[line] = plan_.lines[line].hypothetical ? 0 : 1;
      }
    }
    const bool vanished = std::all_of(runs.begin(), runs.end(),
                                      [](const auto* of_block) { return of_block->empty(); });
    if (vanished && !may_vanish_) return std::numeric_limits<double>::infinity();
    const auto lines = std::count(used.begin(), used.end(), 1);
    const double complexity =
        std::accumulate(joints.begin(), joints.end(), static_cast<double>(countWalls(runs)));
    return energy + cost_ * (complexity + static_cast<double>(lines));
  }

  bool acceptIfLower(Trials trials) {
    const Stack stack = stackOf(trials);
    std::vector<double> joints = joints_;
    for (const auto& trial : trials) {
      for (const std::size_t b : {trial.first, trial.first + 1}) joints[b] = jointOf(stack, b);
    }
    const double objective = objectiveOf(stack, joints);
    if (objective >= objective_ - kLeastGain * cost_) return false;
    objective_ = objective;
    joints_ = std::move(joints);
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
      if (!tried_[b].emplace(run.first, run.last).second) continue;
      if (acceptIfLower({{b, cutWithout(b, run)}})) return true;
      Trials face = cutWithoutFace(b, run);
      if (face.size() > 1 && acceptIfLower(std::move(face))) return true;
    }
    return false;
  }

  Outline cutWithout(std::size_t b, const OutlineRun& run) const {
    Outline trial = outlines_[b];
    for (std::size_t e = run.first; e <= run.last; ++e) trial.cut.tie(e);
    cutAgain(blocks_[b].terms, trial);
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

  // The block and the one above it as one; what is tied in both stays so.
  Outline cutMerged(std::size_t b, const CellTerms& terms) const {
    Outline merged{LabelCut(plan_, terms, gap_), {}, 0.0, {}};
    for (std::size_t e = 0; e < plan_.edges.size(); ++e) {
      if (outlines_[b].cut.tied(e) && outlines_[b + 1].cut.tied(e)) merged.cut.tie(e);
    }
    cutAgain(terms, merged);
    return merged;
  }

  // F with one outline in place of that of a block and the one above it.
  double objectiveOfMerge(std::size_t b, const Outline& merged) const {
    Stack stack = stackOf({});
    std::vector<double> joints = joints_;
    stack[b] = &merged;
    stack.erase(stack.begin() + static_cast<std::ptrdiff_t>(b) + 1);
    joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(b) + 1);
    for (const std::size_t joint : {b, b + 1}) joints[joint] = jointOf(stack, joint);
    return objectiveOf(stack, joints);
  }

  // The merge of two neighbours with the least F, if that is no higher: of equals one block is the
  // simpler description.
  bool mergeBlocks() {
    double best = objective_ + kLeastGain * cost_;
    std::size_t lower = SIZE_MAX;
    Trials best_outline;
    for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
      Outline merged = cutMerged(b, termsOfMerge(b));
      const double objective = objectiveOfMerge(b, merged);
      if (objective >= best) continue;
      best = objective;
      lower = b;
      best_outline.clear();
      best_outline.emplace(b, std::move(merged));
    }
    if (lower == SIZE_MAX) return false;
    objective_ = best;
    takeMerge(lower, std::move(best_outline.at(lower)));
    dropRuns(lower);
    return true;
  }

  CellTerms termsOfMerge(std::size_t b) const {
    CellTerms terms = blocks_[b].terms;
    terms.add(blocks_[b + 1].terms);
    return terms;
  }

  void takeMerge(std::size_t b, Outline merged) {
    const auto upper = static_cast<std::ptrdiff_t>(b) + 1;
    blocks_[b].terms = termsOfMerge(b);
    blocks_[b].last_bin = blocks_[b + 1].last_bin;
    outlines_[b] = std::move(merged);
    tried_[b].clear();
    blocks_.erase(blocks_.begin() + upper);
    outlines_.erase(outlines_.begin() + upper);
    tried_.erase(tried_.begin() + upper);
    measureJoints();
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
      for (std::size_t e = 0; e < plan_.edges.size(); ++e) {
        if (static_cast<std::size_t>(plan_.edges[e].line) == line) trial.cut.tie(e);
      }
      cutAgain(blocks_[b].terms, trial);
      trials.emplace(b, std::move(trial));
    }
    if (!trials.empty()) acceptIfLower(std::move(trials));
  }

  const LineArrangement& plan_;
  CellNeighbors neighbors_;
  double gap_;
  double cost_;
  bool may_vanish_;
  std::vector<CellBlock>& blocks_;
  std::vector<Outline> outlines_;                                     // of each block
  std::vector<std::set<std::pair<std::size_t, std::size_t>>> tried_;  // runs that earn their cost
  std::vector<double> joints_;  // below each block, and above the last
  double objective_ = 0.0;
};

}  // namespace

void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks, bool may_vanish) {
  if (!(cost > 0.0) || blocks.empty()) return;
  Pruning(plan, gap, cost, may_vanish, blocks).run();
  for (CellBlock& block : blocks) block.measureCoverage();
}

}  // namespace storey::detail
