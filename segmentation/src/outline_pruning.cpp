// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_pruning.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kTriedUpTo = 2.0;  // costs: what has more to show than this stays
constexpr double kLeastGain = 1e-9;  // of the cost, against endless exchanges

struct Run {
  std::size_t first = 0;  // edges of the plan, one after the other along a line
  std::size_t last = 0;
  double seen = 0.0;  // area
};

// +1 if the inside is behind the line, -1 if it is ahead, 0 if the edge is no boundary.
int sideOf(const PlanEdge& edge, const std::vector<char>& inside) {
  return int{inside[static_cast<std::size_t>(edge.behind)]} -
         int{inside[static_cast<std::size_t>(edge.ahead)]};
}

std::vector<Run> runsOf(const LineArrangement& plan, const CellTerms& terms,
                        const std::vector<char>& inside) {
  std::vector<Run> runs;
  int side = 0;  // of the run that is being made
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    const int own = sideOf(edge, inside);
    const bool joined = e > 0 && side == own && plan.edges[e - 1].line == edge.line &&
                        edge.s_min - plan.edges[e - 1].s_max < 1e-6 * edge.length();
    side = own;
    if (own == 0) continue;
    if (!joined) runs.push_back({e, e, 0.0});
    runs.back().last = e;
    runs.back().seen += std::max(0.0, own * terms.signed_area[e]);
  }
  return runs;
}

// One block while it is pruned.
struct Outline {
  std::vector<char> tied;
  std::vector<Run> runs;
  std::set<std::pair<std::size_t, std::size_t>> tried;  // runs that earn their cost
};

class Pruning {
 public:
  Pruning(const LineArrangement& plan, double gap, double cost, std::vector<CellBlock>& blocks)
      : plan_(plan), gap_(gap), cost_(cost), blocks_(blocks), outlines_(blocks.size()) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      outlines_[b].tied.assign(plan.edges.size(), 0);
      outlines_[b].runs = runsOf(plan, blocks[b].terms, blocks[b].inside);
    }
  }

  void run() {
    dropLines();
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      while (dropRun(b)) {
      }
    }
    dropLines();
  }

 private:
  struct Trial {
    std::size_t block = 0;
    std::vector<char> tied;
    std::vector<char> inside;
    std::vector<Run> runs;
    double energy = 0.0;
  };

  Trial cutWithout(std::size_t b, std::vector<char> tied) const {
    Trial trial;
    trial.block = b;
    trial.tied = std::move(tied);
    trial.energy = minimumCut(plan_, blocks_[b].terms, gap_, trial.tied, trial.inside);
    trial.runs = runsOf(plan_, blocks_[b].terms, trial.inside);
    return trial;
  }

  // Of F, without the lines.
  double changeBy(const Trial& trial) const {
    const double more_runs = static_cast<double>(trial.runs.size()) -
                             static_cast<double>(outlines_[trial.block].runs.size());
    return trial.energy - blocks_[trial.block].energy + cost_ * more_runs;
  }

  void accept(Trial trial) {
    CellBlock& block = blocks_[trial.block];
    Outline& outline = outlines_[trial.block];
    block.energy = trial.energy;
    block.inside = std::move(trial.inside);
    outline.tied = std::move(trial.tied);
    outline.runs = std::move(trial.runs);
  }

  bool dropRun(std::size_t b) {
    std::vector<Run> runs = outlines_[b].runs;
    std::stable_sort(runs.begin(), runs.end(),
                     [](const Run& one, const Run& other) { return one.seen < other.seen; });
    for (const Run& run : runs) {
      if (run.seen > kTriedUpTo * cost_) return false;
      if (!outlines_[b].tried.emplace(run.first, run.last).second) continue;
      std::vector<char> tied = outlines_[b].tied;
      std::fill(tied.begin() + static_cast<std::ptrdiff_t>(run.first),
                tied.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, char{1});
      Trial trial = cutWithout(b, std::move(tied));
      if (changeBy(trial) >= -kLeastGain * cost_) continue;
      accept(std::move(trial));
      return true;
    }
    return false;
  }

  // Area that each line shows in all blocks; negative: it bounds nothing.
  std::vector<double> seenByLine() const {
    std::vector<double> seen(plan_.lines.size(), -1.0);
    for (const Outline& outline : outlines_) {
      for (const Run& run : outline.runs) {
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
    for (const std::size_t line : order) dropLine(static_cast<int>(line));
  }

  void dropLine(int line) {
    const auto [begin, end] =
        std::equal_range(plan_.edges.begin(), plan_.edges.end(), PlanEdge{line, 0, 0, 0.0, 0.0},
                         [](const PlanEdge& a, const PlanEdge& b) { return a.line < b.line; });
    std::vector<Trial> trials;
    double change = -cost_ * static_cast<double>(countLines(trials));
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const bool used = std::any_of(begin, end, [&](const PlanEdge& edge) {
        return sideOf(edge, blocks_[b].inside) != 0;
      });
      if (!used) continue;
      std::vector<char> tied = outlines_[b].tied;
      std::fill(tied.begin() + (begin - plan_.edges.begin()),
                tied.begin() + (end - plan_.edges.begin()), char{1});
      trials.push_back(cutWithout(b, std::move(tied)));
      change += changeBy(trials.back());
    }
    change += cost_ * static_cast<double>(countLines(trials));
    if (trials.empty() || change >= -kLeastGain * cost_) return;
    for (Trial& trial : trials) accept(std::move(trial));
  }

  // Lines with a run in any block, the trials in place of their blocks.
  std::size_t countLines(const std::vector<Trial>& trials) const {
    std::vector<char> used(plan_.lines.size(), 0);
    const auto mark = [&](const std::vector<Run>& runs) {
      for (const Run& run : runs) used[static_cast<std::size_t>(plan_.edges[run.first].line)] = 1;
    };
    for (std::size_t b = 0; b < outlines_.size(); ++b) {
      const auto trial = std::find_if(trials.begin(), trials.end(),
                                      [&](const Trial& t) { return t.block == b; });
      mark(trial != trials.end() ? trial->runs : outlines_[b].runs);
    }
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  }

  const LineArrangement& plan_;
  double gap_;
  double cost_;
  std::vector<CellBlock>& blocks_;
  std::vector<Outline> outlines_;
};

}  // namespace

void pruneOutlines(const LineArrangement& plan, double gap, double cost,
                   std::vector<CellBlock>& blocks) {
  if (!(cost > 0.0)) return;
  Pruning(plan, gap, cost, blocks).run();
}

}  // namespace storey::detail
