// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/end_evidence.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kSameDirection = 0.999;  // cosine of 2.6 degrees

// Whether the wall of this end was found on this line.
bool isOn(const PlanLine& line, const WallEnd& end, double apart) {
  return !line.hypothetical && std::abs(line.normal.dot(end.normal)) > kSameDirection &&
         std::abs(line.across(end.place)) < apart;
}

// Length of an edge that is beyond the end.
double lengthBeyond(const LineArrangement& plan, const PlanEdge& edge, const WallEnd& end,
                    double reach) {
  const Eigen::Vector2d tangent = plan.lines[static_cast<std::size_t>(edge.line)].tangent();
  const auto [from, to] =
      std::minmax({tangent.dot(end.place), tangent.dot(end.place + reach * end.onward)});
  return std::max(0.0, std::min(to, edge.s_max) - std::max(from, edge.s_min));
}

}  // namespace

void noteEnds(const LineArrangement& plan, const std::vector<WallEnd>& ends, double reach,
              double apart, WallEvidence& evidence) {
  if (ends.empty()) return;
  const std::size_t bins = evidence.num_bins;
  const auto binOf = [&](double z) {
    const double bin = std::round((z - evidence.z_min) / evidence.bin);
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins)));
  };
  evidence.beyond.assign(plan.edges.size() * bins, 0.0f);
  for (const WallEnd& end : ends) {
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      const PlanEdge& edge = plan.edges[e];
      if (!isOn(plan.lines[static_cast<std::size_t>(edge.line)], end, apart)) continue;
      const auto area = static_cast<float>(lengthBeyond(plan, edge, end, reach) * evidence.bin);
      for (std::size_t b = binOf(end.z_min); b < binOf(end.z_max); ++b) {
        float& beyond = evidence.beyond[e * bins + b];
        beyond = std::max(beyond, area);
      }
    }
  }
}

}  // namespace storey::detail
