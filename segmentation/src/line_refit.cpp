// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/line_refit.h>
#include <storey/segmentation/detail/point_blocks.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace storey::detail {
namespace {

constexpr int kRounds = 2;
constexpr double kGate = 4.0;   // noise deviations
constexpr double kTukey = 6.0;  // noise deviations
constexpr double kMinPoints = 8.0;

// A stretch of a line that bounds the inside.
struct Stretch {
  std::size_t line;
  double sense;  // of the outward normal: +1 along the line's, -1 against it
  double s_min;
  double s_max;
};

std::vector<Stretch> stretchesOf(const LineArrangement& plan, const CellBlock& block) {
  std::vector<Stretch> stretches;
  for (const PlanEdge& edge : plan.edges) {
    const bool behind = block.inside[static_cast<std::size_t>(edge.behind)] != 0;
    const bool ahead = block.inside[static_cast<std::size_t>(edge.ahead)] != 0;
    if (behind == ahead) continue;
    stretches.push_back(
        {static_cast<std::size_t>(edge.line), behind ? 1.0 : -1.0, edge.s_min, edge.s_max});
  }
  return stretches;
}

// The stretches of each block, and which of them a point is of.
class StretchFinder {
 public:
  StretchFinder(const LineArrangement& plan, const WallEvidence& evidence,
                const std::vector<CellBlock>& blocks, double gate)
      : evidence_(evidence), blocks_(blocks), gate_(gate), used_(plan.lines.size(), 0) {
    for (const CellBlock& block : blocks) {
      stretches_.push_back(stretchesOf(plan, block));
      std::vector<std::size_t> first(plan.lines.size() + 1, 0);
      for (const Stretch& stretch : stretches_.back()) {
        used_[stretch.line] = 1;
        ++first[stretch.line + 1];
      }
      for (std::size_t l = 0; l < plan.lines.size(); ++l) first[l + 1] += first[l];
      first_.push_back(std::move(first));
    }
  }

  bool isUsed(std::size_t line) const { return used_[line] != 0; }

  // The used lines that points of a run may be near, ascending.
  std::vector<std::size_t> linesNear(const std::vector<PlanLine>& lines, const PointBlocks& runs,
                                     std::size_t run) const {
    std::vector<std::size_t> near;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (isUsed(l) && runs.mayBeNear(run, lines[l].normal, lines[l].offset, gate_)) {
        near.push_back(l);
      }
    }
    return near;
  }

  // The line of the nearest stretch that the point confirms; the number of lines if there is none.
  std::size_t lineOf(const WallPoint& p, const std::vector<PlanLine>& lines,
                     const std::vector<std::size_t>& near) const {
    const auto bin = static_cast<std::size_t>((p.z - evidence_.z_min) / evidence_.bin);
    const auto block = std::find_if(blocks_.begin(), blocks_.end(), [&](const CellBlock& b) {
      return bin < b.last_bin || (bin + 1 >= evidence_.num_bins && &b == &blocks_.back());
    });
    std::size_t found = lines.size();
    if (block == blocks_.end()) return found;
    const auto b = static_cast<std::size_t>(block - blocks_.begin());
    double nearest = gate_;
    for (const std::size_t l : near) {
      const PlanLine& line = lines[l];
      const double d = std::abs(line.across(p.position));
      if (d >= nearest) continue;
      const double agreement = line.normal.dot(p.normal);
      const double s = line.tangent().dot(p.position);
      const bool on_wall =
          std::any_of(stretches_[b].begin() + static_cast<std::ptrdiff_t>(first_[b][l]),
                      stretches_[b].begin() + static_cast<std::ptrdiff_t>(first_[b][l + 1]),
                      [&](const Stretch& stretch) {
                        return stretch.sense * agreement >= kMinAgreement && s >= stretch.s_min &&
                               s <= stretch.s_max;
                      });
      if (!on_wall) continue;
      nearest = d;
      found = l;
    }
    return found;
  }

 private:
  const WallEvidence& evidence_;
  const std::vector<CellBlock>& blocks_;
  double gate_;
  std::vector<std::vector<Stretch>> stretches_;  // by block, then by line
  std::vector<std::vector<std::size_t>> first_;  // of each block's lines, of their stretches
  std::vector<char> used_;
};

}  // namespace

std::vector<PlanLine> refitUsedLines(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<CellBlock>& blocks,
                                     const std::vector<WallPoint>& points, double noise,
                                     unsigned int threads) {
  const StretchFinder finder(plan, evidence, blocks, kGate * noise);
  const PointBlocks runs(points);
  std::vector<PlanLine> lines = plan.lines;
  std::vector<std::size_t> line_of(points.size());
  for (int round = 0; round < kRounds; ++round) {
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 64)
    for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(runs.size()); ++r) {
      const auto run = static_cast<std::size_t>(r);
      const std::vector<std::size_t> near = finder.linesNear(lines, runs, run);
      for (std::size_t i = runs.begin(run); i < runs.end(run); ++i) {
        line_of[i] = finder.lineOf(points[i], lines, near);
      }
    }
    std::vector<double> weight(lines.size(), 0.0);
    std::vector<double> shift(lines.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t l = line_of[i];
      if (l == lines.size()) continue;
      const double d = lines[l].across(points[i].position);
      const double u = d / (kTukey * noise);
      const double w = (1.0 - u * u) * (1.0 - u * u);
      weight[l] += w;
      shift[l] += w * d;
    }
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (weight[l] >= kMinPoints) lines[l].offset += shift[l] / weight[l];
    }
  }
  std::vector<PlanLine> result;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (finder.isUsed(l)) result.push_back(lines[l]);
  }
  return result;
}

}  // namespace storey::detail
