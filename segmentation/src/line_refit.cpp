// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/line_refit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace

std::vector<PlanLine> refitUsedLines(const LineArrangement& plan, const WallEvidence& evidence,
                                     const std::vector<CellBlock>& blocks,
                                     const std::vector<WallPoint>& points, double noise) {
  std::vector<std::vector<Stretch>> stretches;
  std::vector<char> used(plan.lines.size(), 0);
  for (const CellBlock& block : blocks) {
    stretches.push_back(stretchesOf(plan, block));
    for (const Stretch& stretch : stretches.back()) used[stretch.line] = 1;
  }
  std::vector<PlanLine> lines = plan.lines;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> weight(lines.size(), 0.0);
    std::vector<double> shift(lines.size(), 0.0);
    for (const WallPoint& p : points) {
      const auto bin = static_cast<std::size_t>((p.z - evidence.z_min) / evidence.bin);
      const auto block = std::find_if(blocks.begin(), blocks.end(), [&](const CellBlock& b) {
        return bin < b.last_bin || (bin + 1 >= evidence.num_bins && &b == &blocks.back());
      });
      if (block == blocks.end()) continue;
      double nearest = kGate * noise;
      const Stretch* best = nullptr;
      for (const Stretch& stretch : stretches[static_cast<std::size_t>(block - blocks.begin())]) {
        const PlanLine& line = lines[stretch.line];
        const double d = std::abs(line.across(p.position));
        if (d >= nearest || stretch.sense * line.normal.dot(p.normal) < kMinAgreement) continue;
        const double s = line.tangent().dot(p.position);
        if (s < stretch.s_min || s > stretch.s_max) continue;
        nearest = d;
        best = &stretch;
      }
      if (best == nullptr) continue;
      const double d = lines[best->line].across(p.position);
      const double u = d / (kTukey * noise);
      const double w = (1.0 - u * u) * (1.0 - u * u);
      weight[best->line] += w;
      shift[best->line] += w * d;
    }
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (weight[l] >= kMinPoints) lines[l].offset += shift[l] / weight[l];
    }
  }
  std::vector<PlanLine> result;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (used[l] != 0) result.push_back(lines[l]);
  }
  return result;
}

}  // namespace storey::detail
