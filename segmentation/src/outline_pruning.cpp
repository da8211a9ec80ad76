// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/task_crew.h>
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kTriedUpTo = 3.0;   // costs: what has more to show than this stays
constexpr double kLeastGain = 1e-9;  // of the cost, against endless exchanges

// Edges of the plan one after the other along a line.
struct EdgeRange {
  std::size_t first;
  std::size_t last;

  bool operator<(const EdgeRange& other) const {
    return std::tie(first, last) < std::tie(other.first, other.last);
  }
};

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

// The cells inside in a block.
struct Labels {
  std::vector<char> inside;
  double energy = 0.0;
  std::vector<OutlineRun> runs;
};

// The outline of a block, and the cut that found it.
struct Outline {
  LabelCut cut;
  Labels labels;
  std::map<EdgeRange, Labels> without;  // the best that do without some edges, as far as tried
  std::unique_ptr<Outline> merged;      // with the block above as one, if tried
};

class Pruning {
 public:
  Pruning(const LineArrangement& plan, double gap, double cost, bool may_vanish,
          unsigned int threads, std::vector<CellBlock>& blocks)
      : plan_(plan),
        neighbors_(plan),
        gap_(gap),
        cost_(cost),
        may_vanish_(may_vanish),
        crew_(threadsFor(threads)),
        blocks_(blocks) {
    for (const CellBlock& block : blocks) {
      Labels labels{block.inside, block.energy, runsOf(plan, block.terms, block.inside)};
      outlines_.push_back({LabelCut(plan, block.terms, gap), std::move(labels), {}, {}});
    }
    crew_.run(outlines_.size(), [&](std::size_t b) {
      outlines_[b].cut.solve();  // once; trials go on from there
    });
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
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      blocks_[b].inside = std::move(outlines_[b].labels.inside);
      blocks_[b].energy = outlines_[b].labels.energy;
    }
  }

 private:
  using Trial = std::map<std::size_t, EdgeRange>;  // what blocks are to do without
  using Stack = std::vector<const Labels*>;

  Labels cutAgain(const CellTerms& terms, LabelCut& cut) const {
    Labels labels;
    labels.inside = cut.solve();
    labels.energy = energyOf(plan_, terms, gap_, labels.inside);
    labels.runs = runsOf(plan_, terms, labels.inside);
    return labels;
  }

  static void tie(const EdgeRange& edges, LabelCut& cut) {
    for (std::size_t e = edges.first; e <= edges.last; ++e) cut.tie(e);
  }

  Labels cutWithout(const EdgeRange& edges, std::size_t b) const {
    LabelCut cut = outlines_[b].cut;
    tie(edges, cut);
    return cutAgain(blocks_[b].terms, cut);
  }

  // Cut once for as long as the outline stays.
  const Labels& without(const EdgeRange& edges, std::size_t b) {
    auto& known = outlines_[b].without;
    const auto found = known.find(edges);
    return found != known.end() ? found->second
                                : known.emplace(edges, cutWithout(edges, b)).first->second;
  }

  void take(const EdgeRange& edges, std::size_t b) {
    Outline& outline = outlines_[b];
    outline.labels = std::move(outline.without.at(edges));
    outline.without.clear();
    tie(edges, outline.cut);
    outline.cut.solve();
    forgetMerges(b);
  }

  void forgetMerges(std::size_t b) {
    outlines_[b].merged.reset();
    if (b > 0) outlines_[b - 1].merged.reset();
  }

  Stack stack() const {
    Stack stack;
    for (const Outline& outline : outlines_) stack.push_back(&outline.labels);
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
    for (const Labels* labels : stack) {
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
    for (const auto& [b, edges] : trial) changed[b] = &without(edges, b);
    std::vector<double> joints = joints_;
    for (const auto& [block, edges] : trial) {
      for (const std::size_t b : {block, block + 1}) joints[b] = jointOf(changed, b);
    }
    const double objective = objectiveOf(changed, joints);
    if (objective >= objective_ - kLeastGain * cost_) return false;
    objective_ = objective;
    joints_ = std::move(joints);
    for (const auto& [b, edges] : trial) take(edges, b);
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
    for (const OutlineRun& run : outlines_[b].labels.runs) {
      if (run.seen <= kTriedUpTo * cost_ && tried_[b].count(rangeOf(run)) == 0) runs.push_back(run);
    }
    std::stable_sort(runs.begin(), runs.end(), [](const OutlineRun& one, const OutlineRun& other) {
      return one.seen < other.seen;
    });
    return runs;
  }

  // Cuts side by side what trials of some runs will ask for. One thread cuts what they do ask for.
  template <typename Iterator>
  void cutAhead(std::size_t b, Iterator from, Iterator to) {
    if (crew_.size() == 1) return;
    std::set<std::pair<std::size_t, EdgeRange>> asked;
    for (auto run = from; run != to; ++run) {
      for (const auto& [block, edges] : faceOf(b, *run)) {
        if (outlines_[block].without.count(edges) == 0) asked.emplace(block, edges);
      }
    }
    const std::vector<std::pair<std::size_t, EdgeRange>> list(asked.begin(), asked.end());
    std::vector<Labels> found(list.size());
    crew_.run(list.size(),
              [&](std::size_t i) { found[i] = cutWithout(list[i].second, list[i].first); });
    for (std::size_t i = 0; i < list.size(); ++i) {
      outlines_[list[i].first].without.emplace(list[i].second, std::move(found[i]));
    }
  }

  // The run and those that continue it in the blocks above and below.
  Trial faceOf(std::size_t b, const OutlineRun& run) const {
    Trial face{{b, rangeOf(run)}};
    for (const int step : {1, -1}) {
      OutlineRun last = run;
      for (std::size_t next = b + static_cast<std::size_t>(step); next < outlines_.size();
           next += static_cast<std::size_t>(step)) {
        const std::vector<OutlineRun>& runs = outlines_[next].labels.runs;
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

  // The block and the one above it as one; what is tied in both stays so.
  Outline cutMerged(std::size_t b) const {
    const CellTerms terms = termsOfMerge(b);
    Outline merged{LabelCut(plan_, terms, gap_), {}, {}, {}};
    for (std::size_t e = 0; e < plan_.edges.size(); ++e) {
      if (outlines_[b].cut.tied(e) && outlines_[b + 1].cut.tied(e)) merged.cut.tie(e);
    }
    merged.labels = cutAgain(terms, merged.cut);
    return merged;
  }

  void cutAllMerged() {
    std::vector<std::size_t> missing;
    for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
      if (!outlines_[b].merged) missing.push_back(b);
    }
    crew_.run(missing.size(), [&](std::size_t i) {
      outlines_[missing[i]].merged = std::make_unique<Outline>(cutMerged(missing[i]));
    });
  }

  // F with one outline in place of that of a block and the one above it.
  double objectiveOfMerge(std::size_t b, const Labels& merged) const {
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
    cutAllMerged();
    double best = objective_ + kLeastGain * cost_;
    std::size_t lower = SIZE_MAX;
    for (std::size_t b = 0; b + 1 < outlines_.size(); ++b) {
      const double objective = objectiveOfMerge(b, outlines_[b].merged->labels);
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

  CellTerms termsOfMerge(std::size_t b) const {
    CellTerms terms = blocks_[b].terms;
    terms.add(blocks_[b + 1].terms);
    return terms;
  }

  void takeMerge(std::size_t b) {
    const auto upper = static_cast<std::ptrdiff_t>(b) + 1;
    blocks_[b].terms = termsOfMerge(b);
    blocks_[b].last_bin = blocks_[b + 1].last_bin;
    outlines_[b] = Outline(std::move(*outlines_[b].merged));
    forgetMerges(b);
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
      for (const OutlineRun& run : outline.labels.runs) {
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
      const std::vector<OutlineRun>& runs = outlines_[b].labels.runs;
      const bool used = std::any_of(runs.begin(), runs.end(), [&](const OutlineRun& run) {
        return run.first >= edges.first && run.first <= edges.last;
      });
      if (used) trial.emplace(b, edges);
    }
    if (!trial.empty()) acceptIfLower(trial);
  }

  const LineArrangement& plan_;
  CellNeighbors neighbors_;
  double gap_;
  double cost_;
  bool may_vanish_;
  TaskCrew crew_;
  std::vector<CellBlock>& blocks_;
  std::vector<Outline> outlines_;           // of each block
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
