// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_cuts.h>
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

EdgeRange rangeOf(const OutlineRun& run) { return {run.first, run.last}; }

// All edges of a line, which has some.
EdgeRange edgesOf(const LineArrangement& plan, std::size_t line) {
  const auto firstFrom = [&](std::size_t l) {
    const auto found = std::partition_point(
        plan.edges.begin(), plan.edges.end(),
        [&](const PlanEdge& edge) { return static_cast<std::size_t>(edge.line) < l; });
    return static_cast<std::size_t>(found - plan.edges.begin());
  };
  return {firstFrom(line), firstFrom(line + 1) - 1};
}

class Pruning {
 public:
  Pruning(const LineArrangement& plan, double gap, double cost, bool may_vanish,
          unsigned int threads, std::vector<CellBlock>& blocks)
      : plan_(plan),
        neighbors_(plan),
        cost_(cost),
        may_vanish_(may_vanish),
        outlines_(plan, gap, threads, blocks) {
    tried_.resize(blocks.size());
    measureJoints();
    objective_ = objectiveOf(stack(), joints_);
  }

  void run() {
    dropLines();
    for (std::size_t b = 0; b < outlines_.size(); ++b) dropRuns(b);
    while (mergeBlocks()) {
    }
    dropLines();
    outlines_.writeBack();
  }

 private:
  using Trial = std::map<std::size_t, EdgeRange>;  // what blocks are to do without
  using Stack = std::vector<const BlockLabels*>;

  Stack stack() const {
    Stack stack;
    for (std::size_t b = 0; b < outlines_.size(); ++b) stack.push_back(&outlines_[b]);
    return stack;
  }

  // What the joint below a block of the stack costs; above the last block there is one more.
  double jointOf(const Stack& stack, std::size_t b) const {
    return jointComplexity(neighbors_, b > 0 ? &stack[b - 1]->inside : nullptr,
                           b < stack.size() ? &stack[b]->inside : nullptr);
  }

  void measureJoints() {
    joints_.clear();
    for (std::size_t b = 0; b <= outlines_.size(); ++b) joints_.push_back(jointOf(stack(), b));
  }

  // F. A line that was guessed costs nothing to describe: it follows from the ends of others.
  double objectiveOf(const Stack& stack, const std::vector<double>& joints) const {
    std::vector<const std::vector<OutlineRun>*> runs;
    std::vector<char> used(plan_.lines.size(), 0);
    double energy = 0.0;
    for (const BlockLabels* labels : stack) {
      energy += labels->energy;
      runs.push_back(&labels->runs);
      for (const OutlineRun& run : labels->runs) {
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

  bool acceptIfLower(const Trial& trial) {
    Stack changed = stack();
    outlines_.cutAhead({trial.begin(), trial.end()});  // side by side
    for (const auto& [b, edges] : trial) changed[b] = &outlines_.without(edges, b);
    std::vector<double> joints = joints_;
    for (const auto& [block, edges] : trial) joints[block] = joints[block + 1] = 0.0;
    const double most = objective_ - kLeastGain * cost_;
    if (objectiveOf(changed, joints) >= most) return false;  // whatever the joints cost
    for (const auto& [block, edges] : trial) {
      for (const std::size_t b : {block, block + 1}) joints[b] = jointOf(changed, b);
    }
    const double objective = objectiveOf(changed, joints);
    if (objective >= most) return false;
    objective_ = objective;
    joints_ = std::move(joints);
    for (const auto& [b, edges] : trial) outlines_.take(edges, b);
    return true;
  }

  void dropRuns(std::size_t b) {
    while (dropRun(b)) {
    }
  }

  bool dropRun(std::size_t b) {
    const std::vector<OutlineRun> runs = untriedRuns(b);
    std::size_t cut = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (r == cut) {  // the longer nothing was taken away, the further ahead
        cut = std::min(runs.size(), 2 * cut + 1);
        cutAhead(b, runs.begin() + static_cast<std::ptrdiff_t>(r),
                 runs.begin() + static_cast<std::ptrdiff_t>(cut));
      }
      const EdgeRange edges = rangeOf(runs[r]);
      tried_[b].insert(edges);
      if (acceptIfLower({{b, edges}})) return true;
      const Trial face = faceOf(b, runs[r]);
      if (face.size() > 1 && acceptIfLower(face)) return true;
    }
    return false;
  }

  // Those with the least to show first.
  std::vector<OutlineRun> untriedRuns(std::size_t b) const {
    std::vector<OutlineRun> runs;
    for (const OutlineRun& run : outlines_[b].runs) {
      if (run.seen <= kTriedUpTo * cost_ && tried_[b].count(rangeOf(run)) == 0) runs.push_back(run);
    }
    std::stable_sort(runs.begin(), runs.end(), [](const OutlineRun& one, const OutlineRun& other) {
      return one.seen < other.seen;
    });
    return runs;
  }

  // Cuts what trials of some runs will ask for.
  template <typename Iterator>
  void cutAhead(std::size_t b, Iterator from, Iterator to) {
    if (!outlines_.cutsAhead()) return;
    std::set<std::pair<std::size_t, EdgeRange>> asked;
    for (auto run = from; run != to; ++run) {
      const Trial face = faceOf(b, *run);
      asked.insert(face.begin(), face.end());
    }
    outlines_.cutAhead(asked);
  }

  // The run and those that continue it in the blocks above and below.
  Trial faceOf(std::size_t b, const OutlineRun& run) const {
    Trial face{{b, rangeOf(run)}};
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
        face.emplace(next, rangeOf(last));
      }
    }
    return face;
  }

  // F with one outline in place of that of a block and the one above it.
  double objectiveOfMerge(std::size_t b, const BlockLabels& merged) const {
    Stack changed = stack();
    std::vector<double> joints = joints_;
    changed[b] = &merged;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(b) + 1);
    joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(b) + 1);
    for (const std::size_t joint : {b, b + 1}) joints[joint] = jointOf(changed, joint);
    return objectiveOf(changed, joints);
  }

  // The merge of two neighbours with the least F, if that is no higher: of equals one block is the
  // simpler description.
  bool mergeBlocks() {
    outlines_.cutAllMerged();
    double best = objective_ + kLeastGain * cost_;
    std::size_t lower = SIZE_MAX;
    for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
      const double objective = objectiveOfMerge(b, outlines_.merged(b));
      if (objective >= best) continue;
      best = objective;
      lower = b;
    }
    if (lower == SIZE_MAX) return false;
    objective_ = best;
    takeMerge(lower);
    dropRuns(lower);
    return true;
  }

  void takeMerge(std::size_t b) {
    outlines_.takeMerge(b);
    tried_[b].clear();
    tried_.erase(tried_.begin() + static_cast<std::ptrdiff_t>(b) + 1);
    measureJoints();
  }

  // Area that each line shows in all blocks; negative: it bounds nothing.
  std::vector<double> seenByLine() const {
    std::vector<double> seen(plan_.lines.size(), -1.0);
    for (const BlockLabels* labels : stack()) {
      for (const OutlineRun& run : labels->runs) {
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
    const EdgeRange edges = edgesOf(plan_, line);
    Trial trial;
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      const std::vector<OutlineRun>& runs = outlines_[b].runs;
      const bool used = std::any_of(runs.begin(), runs.end(), [&](const OutlineRun& run) {
        return run.first >= edges.first && run.first <= edges.last;
      });
      if (used) trial.emplace(b, edges);
    }
    if (!trial.empty()) acceptIfLower(trial);
  }

  const LineArrangement& plan_;
  CellNeighbors neighbors_;
  double cost_;
  bool may_vanish_;
  OutlineCuts outlines_;                    // of each block
  std::vector<std::set<EdgeRange>> tried_;  // runs that earn their cost
  std::vector<double> joints_;              // below each block, and above the last
  double objective_ = 0.0;
};

}  // namespace

void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks, bool may_vanish, unsigned int threads) {
  if (!(cost > 0.0) || blocks.empty()) return;
  Pruning(plan, gap, cost, may_vanish, threads, blocks).run();
  for (CellBlock& block : blocks) block.measureCoverage();
}

}  // namespace storey::detail
