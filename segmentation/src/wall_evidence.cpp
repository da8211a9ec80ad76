// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGate = 2.5;             // noise deviations
constexpr double kBin = 3.0;              // noise deviations
constexpr double kMaxBins = 300.0;        // the partition is quadratic in them
constexpr double kMinPoints = 20.0;       // of an edge that takes part in the levels
constexpr double kTilePoints = 6.0;       // a wall misses a tile once in 400
constexpr double kSeenPoints = 5.0;       // fewer may be outliers
constexpr double kFullDensity = 0.5;      // of the walls' density: a tile is seen wholly
constexpr double kLeastDensity = 0.05;    // of the densest height's
constexpr std::size_t kDensityReach = 3;  // bins up and down

// n ln(n / length), the Poisson log-likelihood of n points at their own mean density.
double logLikelihood(double n, double length) { return n > 0.0 ? n * std::log(n / length) : 0.0; }

// Tiles of all edges: edge e has those from first[e] to first[e + 1], equally wide.
struct EdgeTiles {
  std::vector<std::size_t> first;
  std::vector<double> width;
  std::size_t num_bins = 0;
  std::vector<float> difference;  // tile by tile and bin: points ahead less points behind

  std::size_t tileOf(std::size_t edge, double s) const {
    const std::size_t count = first[edge + 1] - first[edge];
    const double place = std::max(0.0, s / width[edge]);
    return first[edge] + std::min(count - 1, static_cast<std::size_t>(place));
  }
};

EdgeTiles makeTiles(const LineArrangement& plan, double width, std::size_t num_bins) {
  EdgeTiles tiles;
  tiles.num_bins = num_bins;
  tiles.first.push_back(0);
  for (const PlanEdge& edge : plan.edges) {
    const double count = std::max(1.0, std::floor(edge.length() / width));
    tiles.width.push_back(edge.length() / count);
    tiles.first.push_back(tiles.first.back() + static_cast<std::size_t>(count));
  }
  tiles.difference.assign(tiles.first.back() * num_bins, 0.0f);
  return tiles;
}

// Density of the points on the walls at each height: the median over the area that was seen around
// it, so that it follows a density that falls with height or with the distance of a side from the
// scanner. Where there are outliers only it is a small share of the building's.
std::vector<double> densityByHeight(const EdgeTiles& tiles, double bin) {
  std::vector<double> densities(tiles.num_bins, 0.0);
  std::vector<std::pair<double, double>> values;  // density, weight
  for (std::size_t b = 0; b < tiles.num_bins; ++b) {
    values.clear();
    double total = 0.0;
    const std::size_t from = b > kDensityReach ? b - kDensityReach : 0;
    const std::size_t to = std::min(tiles.num_bins, b + kDensityReach + 1);
    for (std::size_t e = 0; e < tiles.width.size(); ++e) {
      for (std::size_t t = tiles.first[e]; t < tiles.first[e + 1]; ++t) {
        double d = 0.0;
        for (std::size_t k = from; k < to; ++k) d += tiles.difference[t * tiles.num_bins + k];
        if (std::abs(d) < kSeenPoints) continue;
        const double area = tiles.width[e] * bin * static_cast<double>(to - from);
        values.emplace_back(std::abs(d) / area, area);
        total += area;
      }
    }
    std::sort(values.begin(), values.end());
    double sum = 0.0;
    for (const auto& [density, weight] : values) {
      sum += weight;
      if (sum < 0.5 * total) continue;
      densities[b] = density;
      break;
    }
  }
  const double least = kLeastDensity * *std::max_element(densities.begin(), densities.end());
  for (double& density : densities) density = std::max(density, least);
  return densities;
}

// Bins up, or down, that a tile takes in so that it holds enough points at this density.
std::size_t reachOf(double density, double width, double bin) {
  const double more = kTilePoints / (density * width * bin) - 1.0;
  return std::min(kDensityReach, static_cast<std::size_t>(std::max(0.0, std::round(more))));
}

// A tile that holds few points where the wall is thin is as much seen as the tiles below it and
// those above it, whichever is less: so the ends of a wall stay sharp.
void measureSeen(const EdgeTiles& tiles, WallEvidence& evidence) {
  const std::size_t bins = evidence.num_bins;
  evidence.seen.assign(evidence.ahead.size(), 0.0f);
  const std::vector<double> densities = densityByHeight(tiles, evidence.bin);
  std::vector<double> below(bins + 1, 0.0);  // running sums of a tile's column
  for (std::size_t e = 0; e < tiles.width.size(); ++e) {
    const double area = tiles.width[e] * evidence.bin;
    for (std::size_t t = tiles.first[e]; t < tiles.first[e + 1]; ++t) {
      for (std::size_t b = 0; b < bins; ++b) {
        below[b + 1] = below[b] + tiles.difference[t * bins + b];
      }
      const auto shareOf = [&](std::size_t from, std::size_t to, double density) {
        const double full = kFullDensity * density * area * static_cast<double>(to - from);
        return std::clamp((below[to] - below[from]) / full, -1.0, 1.0);
      };
      for (std::size_t b = 0; b < bins; ++b) {
        const double density = densities[b];
        const std::size_t reach = reachOf(density, tiles.width[e], evidence.bin);
        const double own = shareOf(b, b + 1, density);
        const double down = shareOf(b > reach ? b - reach : 0, b + 1, density);
        const double up = shareOf(b, std::min(bins, b + reach + 1), density);
        const double around = std::abs(down) < std::abs(up) ? down : up;
        const double share = down * up > 0.0 && std::abs(around) > std::abs(own) ? around : own;
        evidence.seen[e * bins + b] += static_cast<float>(share * area);
      }
    }
  }
}

// The nearest line that the point confirms; the number of lines if there is none.
std::size_t lineOf(const WallPoint& p, const std::vector<PlanLine>& lines, double gate) {
  std::size_t line = lines.size();
  double nearest = gate;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const double d = std::abs(lines[l].across(p.position));
    if (d >= gate || std::abs(lines[l].normal.dot(p.normal)) <= kMinAgreement) continue;
    const bool found = !lines[l].hypothetical;
    const bool found_before = line < lines.size() && !lines[line].hypothetical;
    if (found == found_before ? d >= nearest : found_before) continue;
    nearest = d;
    line = l;
  }
  return line;
}

void sumSeen(double density, WallEvidence& evidence) {
  evidence.seen.resize(evidence.ahead.size());
  for (std::size_t i = 0; i < evidence.seen.size(); ++i) {
    evidence.seen[i] = (evidence.ahead[i] - evidence.behind[i]) / static_cast<float>(density);
  }
}

}  // namespace

WallEvidence gatherEvidence(const LineArrangement& plan, const std::vector<WallPoint>& points,
                            const WallScale& scale, bool saturated) {
  WallEvidence evidence;
  if (points.empty() || plan.edges.empty()) return evidence;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const WallPoint& p : points) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  evidence.z_min = low;
  evidence.bin = std::max(kBin * scale.noise, (high - low) / kMaxBins);
  evidence.num_bins = static_cast<std::size_t>((high - low) / evidence.bin) + 1;
  evidence.ahead.assign(plan.edges.size() * evidence.num_bins, 0.0f);
  evidence.behind.assign(plan.edges.size() * evidence.num_bins, 0.0f);
  EdgeTiles tiles =
      makeTiles(plan, std::max(evidence.bin, kTilePoints / (scale.density * evidence.bin)),
                evidence.num_bins);

  std::vector<std::size_t> first_edge(plan.lines.size() + 1, 0);  // edges are sorted by line
  for (const PlanEdge& edge : plan.edges) ++first_edge[static_cast<std::size_t>(edge.line) + 1];
  for (std::size_t l = 0; l < plan.lines.size(); ++l) first_edge[l + 1] += first_edge[l];

  for (const WallPoint& p : points) {
    const std::size_t line = lineOf(p, plan.lines, kGate * scale.noise);
    if (line == plan.lines.size()) continue;
    const double s = plan.lines[line].tangent().dot(p.position);
    const auto begin = plan.edges.begin() + static_cast<std::ptrdiff_t>(first_edge[line]);
    const auto end = plan.edges.begin() + static_cast<std::ptrdiff_t>(first_edge[line + 1]);
    const auto edge = std::lower_bound(
        begin, end, s, [](const PlanEdge& e, double value) { return e.s_max < value; });
    if (edge == end || s < edge->s_min) continue;
    const auto bin =
        std::min(evidence.num_bins - 1, static_cast<std::size_t>((p.z - low) / evidence.bin));
    const auto e = static_cast<std::size_t>(edge - plan.edges.begin());
    const bool agrees = plan.lines[line].normal.dot(p.normal) > 0.0;
    (agrees ? evidence.ahead : evidence.behind)[e * evidence.num_bins + bin] += 1.0f;
    tiles.difference[tiles.tileOf(e, s - edge->s_min) * evidence.num_bins + bin] +=
        agrees ? 1.0f : -1.0f;
  }
  if (saturated) {
    measureSeen(tiles, evidence);
  } else {
    sumSeen(scale.density, evidence);
  }
  return evidence;
}

std::vector<std::size_t> findLevels(const WallEvidence& evidence) {
  const std::size_t bins = evidence.num_bins;
  if (bins == 0) return {};
  // Running sums over the bins, of the edges that have enough points.
  std::vector<std::vector<double>> sums;
  for (std::size_t slot = 0; slot < evidence.ahead.size(); slot += bins) {
    std::vector<double> sum(bins + 1, 0.0);
    for (std::size_t b = 0; b < bins; ++b) {
      sum[b + 1] = sum[b] + evidence.ahead[slot + b] + evidence.behind[slot + b];
    }
    if (sum.back() >= kMinPoints) sums.push_back(std::move(sum));
  }
  const auto edges = static_cast<double>(sums.size());
  const double penalty =
      0.5 * edges + 3.0 * std::sqrt(0.5 * edges) + 2.0 * std::log(static_cast<double>(bins) + 1.0);
  std::vector<double> best(bins + 1, -std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(bins + 1, 0);
  best[0] = 0.0;
  for (std::size_t to = 1; to <= bins; ++to) {
    for (std::size_t start = 0; start < to; ++start) {
      double value = best[start] - penalty;
      const auto length = static_cast<double>(to - start);
      for (const std::vector<double>& sum : sums)
        value += logLikelihood(sum[to] - sum[start], length);
      if (value > best[to]) {
        best[to] = value;
        from[to] = start;
      }
    }
  }
  std::vector<std::size_t> levels;
  for (std::size_t b = bins; b > 0; b = from[b]) levels.push_back(b);
  levels.push_back(0);
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace storey::detail
