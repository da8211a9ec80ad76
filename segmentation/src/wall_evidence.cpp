// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/point_blocks.h>
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
constexpr double kTilePoints = 6.0;       // a wall misses a tile once in 400
constexpr double kSeenPoints = 5.0;       // fewer may be outliers
constexpr double kFullDensity = 0.5;      // of the walls' density: a tile is seen wholly
constexpr double kLeastDensity = 0.05;    // of the densest height's
constexpr std::size_t kDensityReach = 3;  // bins up and down

// Tiles of all edges: edge e has those from first[e] to first[e + 1], equally wide.
struct EdgeTiles {
  std::vector<std::size_t> first;
  std::vector<double> width;
  std::size_t num_bins = 0;
  std::vector<float> difference;  // tile by tile and bin: points ahead less points behind
  std::vector<char> occupied;     // tile by tile: whether there are points

  // Calls `work(tile)` for the tiles of an edge with points.
  template <typename Work>
  void forEachOccupied(std::size_t edge, const Work& work) const {
    for (std::size_t t = first[edge]; t < first[edge + 1]; ++t) {
      if (occupied[t] != 0) work(t);
    }
  }

  // Calls `work(edge, tile)` for the tiles with points.
  template <typename Work>
  void forEachOccupied(const Work& work) const {
    for (std::size_t e = 0; e < width.size(); ++e) {
      forEachOccupied(e, [&](std::size_t t) { work(e, t); });
    }
  }

  void note(std::size_t edge, double s, std::size_t bin, float amount) {
    const std::size_t tile = tileOf(edge, s);
    difference[tile * num_bins + bin] += amount;
    occupied[tile] = 1;
  }

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
  tiles.occupied.assign(tiles.first.back(), 0);
  return tiles;
}

// Density of the points on the walls at each height: the median over the area that was seen around
// it, so that it follows a density that falls with height or with the distance of a side from the
// scanner. Where there are outliers only it is a small share of the building's.
std::vector<double> densityByHeight(const EdgeTiles& tiles, double bin, unsigned int threads) {
  std::vector<double> densities(tiles.num_bins, 0.0);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 8)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(tiles.num_bins); ++i) {
    const auto b = static_cast<std::size_t>(i);
    const std::size_t from = b > kDensityReach ? b - kDensityReach : 0;
    const std::size_t to = std::min(tiles.num_bins, b + kDensityReach + 1);
    std::vector<std::pair<double, double>> values;  // density, weight
    double total = 0.0;
    tiles.forEachOccupied([&](std::size_t e, std::size_t t) {
      double d = 0.0;
      for (std::size_t k = from; k < to; ++k) d += tiles.difference[t * tiles.num_bins + k];
      if (std::abs(d) < kSeenPoints) return;
      const double area = tiles.width[e] * bin * static_cast<double>(to - from);
      values.emplace_back(std::abs(d) / area, area);
      total += area;
    });
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
void addSeen(const EdgeTiles& tiles, const std::vector<double>& densities, std::size_t e,
             std::size_t t, std::vector<double>& below, WallEvidence& evidence) {
  const std::size_t bins = evidence.num_bins;
  const double area = tiles.width[e] * evidence.bin;
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

void measureSeen(const EdgeTiles& tiles, unsigned int threads, WallEvidence& evidence) {
  evidence.seen.assign(evidence.ahead.size(), 0.0f);
  const std::vector<double> densities = densityByHeight(tiles, evidence.bin, threads);
#pragma omp parallel num_threads(threadsFor(threads))
  {
    std::vector<double> below(evidence.num_bins + 1, 0.0);  // running sums of a tile's column
#pragma omp for schedule(dynamic, 64)
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(tiles.width.size()); ++i) {
      const auto e = static_cast<std::size_t>(i);
      tiles.forEachOccupied(
          e, [&](std::size_t t) { addSeen(tiles, densities, e, t, below, evidence); });
    }
  }
}

// Finds the edge that a point is at.
class EdgeFinder {
 public:
  EdgeFinder(const LineArrangement& plan, double gate)
      : plan_(plan), gate_(gate), first_edge_(plan.lines.size() + 1, 0) {
    for (const PlanEdge& edge : plan.edges) ++first_edge_[static_cast<std::size_t>(edge.line) + 1];
    for (std::size_t l = 0; l < plan.lines.size(); ++l) first_edge_[l + 1] += first_edge_[l];
  }

  // The lines that points of a block may be near.
  std::vector<std::size_t> linesNear(const PointBlocks& blocks, std::size_t block) const {
    std::vector<std::size_t> near;
    for (std::size_t l = 0; l < plan_.lines.size(); ++l) {
      const PlanLine& line = plan_.lines[l];
      if (blocks.mayBeNear(block, line.normal, line.offset, gate_)) near.push_back(l);
    }
    return near;
  }

  // The number of edges if there is none, or none of the lines is confirmed.
  std::size_t edgeOf(const WallPoint& p, const std::vector<std::size_t>& lines) const {
    const std::size_t line = lineOf(p, lines);
    if (line == plan_.lines.size()) return plan_.edges.size();
    const double s = plan_.lines[line].tangent().dot(p.position);
    const auto begin = plan_.edges.begin() + static_cast<std::ptrdiff_t>(first_edge_[line]);
    const auto end = plan_.edges.begin() + static_cast<std::ptrdiff_t>(first_edge_[line + 1]);
    const auto edge = std::lower_bound(
        begin, end, s, [](const PlanEdge& e, double value) { return e.s_max < value; });
    if (edge == end || s < edge->s_min) return plan_.edges.size();
    return static_cast<std::size_t>(edge - plan_.edges.begin());
  }

 private:
  // The nearest line that the point confirms; the number of lines if there is none.
  std::size_t lineOf(const WallPoint& p, const std::vector<std::size_t>& lines) const {
    std::size_t found = plan_.lines.size();
    double nearest = gate_;
    for (const std::size_t l : lines) {
      const PlanLine& line = plan_.lines[l];
      const double d = std::abs(line.across(p.position));
      if (d >= gate_ || std::abs(line.normal.dot(p.normal)) <= kMinAgreement) continue;
      const bool seen_before = found < plan_.lines.size() && !plan_.lines[found].hypothetical;
      if (line.hypothetical == !seen_before ? d >= nearest : seen_before) continue;
      nearest = d;
      found = l;
    }
    return found;
  }

  const LineArrangement& plan_;
  double gate_;
  std::vector<std::size_t> first_edge_;  // edges are sorted by line
};

// The edge of each point; the number of edges if it is at none.
std::vector<std::size_t> edgesOf(const LineArrangement& plan, const std::vector<WallPoint>& points,
                                 double gate, unsigned int threads) {
  const EdgeFinder finder(plan, gate);
  const PointBlocks blocks(points);
  std::vector<std::size_t> edges(points.size());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 64)
  for (std::ptrdiff_t b = 0; b < static_cast<std::ptrdiff_t>(blocks.size()); ++b) {
    const auto block = static_cast<std::size_t>(b);
    const std::vector<std::size_t> lines = finder.linesNear(blocks, block);
    for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
      edges[i] = finder.edgeOf(points[i], lines);
    }
  }
  return edges;
}

void sumSeen(double density, WallEvidence& evidence) {
  evidence.seen.resize(evidence.ahead.size());
  for (std::size_t i = 0; i < evidence.seen.size(); ++i) {
    evidence.seen[i] = (evidence.ahead[i] - evidence.behind[i]) / static_cast<float>(density);
  }
}

}  // namespace

WallEvidence gatherEvidence(const LineArrangement& plan, const std::vector<WallPoint>& points,
                            const WallScale& scale, bool saturated, unsigned int threads) {
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
  const std::vector<std::size_t> edges = edgesOf(plan, points, kGate * scale.noise, threads);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t e = edges[i];
    if (e == plan.edges.size()) continue;
    const WallPoint& p = points[i];
    const PlanLine& line = plan.lines[static_cast<std::size_t>(plan.edges[e].line)];
    const auto bin =
        std::min(evidence.num_bins - 1, static_cast<std::size_t>((p.z - low) / evidence.bin));
    const bool agrees = line.normal.dot(p.normal) > 0.0;
    (agrees ? evidence.ahead : evidence.behind)[e * evidence.num_bins + bin] += 1.0f;
    const double s = line.tangent().dot(p.position) - plan.edges[e].s_min;
    tiles.note(e, s, bin, agrees ? 1.0f : -1.0f);
  }
  if (saturated) {
    measureSeen(tiles, threads, evidence);
  } else {
    sumSeen(scale.density, evidence);
  }
  return evidence;
}

}  // namespace storey::detail
