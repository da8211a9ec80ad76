// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/segmentation/detail/assignment.h>
#include <storey/surface/floorplan_grammar.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey {
namespace {

constexpr double kTwoPi = 6.283185307179586;
// The paper's "arbitrary point far enough from the point cloud", in extents of the floorplans.
const Eigen::Vector2d kFarPoint(-1000.0, -700.0);
// Strings that differ everywhere are at distance 1; rare edges of different walls never match.
constexpr int kNothing = FloorplanGrammar::kSpecialLetter - 1;

std::vector<const FloorplanRing*> ringsOf(const Floorplan& plan) {
  std::vector<const FloorplanRing*> rings;
  for (const FloorplanComponent& component : plan.components) {
    rings.push_back(&component.outer);
    for (const FloorplanRing& hole : component.holes) rings.push_back(&hole);
  }
  return rings;
}

// Groups values on a line: sorted, a group grows while the next value is within the tolerance of
// the group's weighted mean. Returns the group of each value.
std::vector<int> groupValues(const std::vector<double>& values, const std::vector<double>& weights,
                             double tolerance) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<int> group(values.size(), 0);
  double sum = 0.0;
  double weight = 0.0;
  int current = -1;
  for (const std::size_t i : order) {
    if (current < 0 || values[i] - sum / weight > tolerance) {
      ++current;
      sum = 0.0;
      weight = 0.0;
    }
    const double w = std::max(weights[i], 1e-300);
    sum += w * values[i];
    weight += w;
    group[i] = current;
  }
  return group;
}

// Angles are a circle: it is cut open in its widest gap, and grouped as a line.
std::vector<int> groupAngles(const std::vector<double>& angles, const std::vector<double>& weights,
                             double tolerance) {
  std::vector<double> sorted = angles;
  std::sort(sorted.begin(), sorted.end());
  double cut = 0.0;
  double widest = -1.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double next = i + 1 < sorted.size() ? sorted[i + 1] : sorted.front() + kTwoPi;
    if (next - sorted[i] > widest) {
      widest = next - sorted[i];
      cut = sorted[i] + 0.5 * widest;
    }
  }
  std::vector<double> opened(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    opened[i] = angles[i] - cut;
    opened[i] -= kTwoPi * std::floor(opened[i] / kTwoPi);
  }
  return groupValues(opened, weights, tolerance);
}

Eigen::Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

bool isSimpleForward(const FloorplanRing& ring, const FloorplanRing& model) {
  // Every edge runs as it did: then no corner has crossed another one on its ring.
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t j = (i + 1) % ring.size();
    if (!ring.vertices[i].allFinite() ||
        (ring.vertices[j] - ring.vertices[i]).dot(model.vertices[j] - model.vertices[i]) <= 0.0) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<FloorplanGrammar::Occurrence> FloorplanGrammar::collectEdges() const {
  std::vector<Occurrence> edges;
  for (const Floorplan& plan : plans_) {
    for (const FloorplanRing* ring : ringsOf(plan)) {
      const std::size_t n = ring->size();
      for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d& a = ring->vertices[i];
        const Eigen::Vector2d& b = ring->vertices[(i + 1) % n];
        const Eigen::Vector2d along = b - a;
        Occurrence edge;
        edge.weight = along.norm();
        edge.middle = 0.5 * (a + b);
        if (encoding_ == Encoding::Walls) {
          edge.angle = std::atan2(-along.x(), along.y());  // outward normal, to the right
        } else {
          const Eigen::Vector2d before = a - ring->vertices[(i + n - 1) % n];
          edge.angle = std::atan2(before.x() * along.y() - before.y() * along.x(),
                                  before.dot(along));  // + counter-clockwise: v and theta
          edge.extent = edge.weight;
        }
        edges.push_back(edge);
      }
    }
  }
  return edges;
}

void FloorplanGrammar::buildDictionary(std::vector<Occurrence>& edges) {
  letters_.clear();
  std::vector<double> angles;
  std::vector<double> weights;
  for (const Occurrence& edge : edges) {
    angles.push_back(edge.angle);
    weights.push_back(edge.weight);
  }
  const std::vector<int> angle_group = groupAngles(angles, weights, angle_tolerance_);
  const int num_groups =
      edges.empty() ? 0 : *std::max_element(angle_group.begin(), angle_group.end()) + 1;
  for (int g = 0; g < num_groups; ++g) {
    std::vector<std::size_t> members;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (angle_group[i] != g) continue;
      members.push_back(i);
      mean += edges[i].weight * unit(edges[i].angle);
    }
    const double angle = std::atan2(mean.y(), mean.x());
    std::vector<double> extents;
    std::vector<double> member_weights;
    for (const std::size_t i : members) {
      if (encoding_ == Encoding::Walls) edges[i].extent = unit(angle).dot(edges[i].middle);
      extents.push_back(edges[i].extent);
      member_weights.push_back(edges[i].weight);
    }
    const std::vector<int> extent_group = groupValues(extents, member_weights, length_tolerance_);
    const int num_letters = *std::max_element(extent_group.begin(), extent_group.end()) + 1;
    for (int e = 0; e < num_letters; ++e) {
      std::vector<std::size_t> same;
      for (std::size_t m = 0; m < members.size(); ++m) {
        if (extent_group[m] == e) same.push_back(members[m]);
      }
      if (same.size() < 2) continue;  // not repeated: the special letter
      for (const std::size_t i : same) edges[i].letter = static_cast<int>(letters_.size());
      letters_.push_back(makeLetter(edges, same));
    }
  }
}

FloorplanGrammar::Letter FloorplanGrammar::makeLetter(
    const std::vector<Occurrence>& edges, const std::vector<std::size_t>& members) const {
  double weight = 0.0;
  double extent = 0.0;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const std::size_t i : members) {
    const double w = std::max(edges[i].weight, 1e-300);
    weight += w;
    direction += w * unit(edges[i].angle);
    middle += w * edges[i].middle;
    extent += w * edges[i].extent;
  }
  // A letter's own direction: letters of one group of angles may be degrees apart.
  const double angle = std::atan2(direction.y(), direction.x());
  if (encoding_ == Encoding::Walls) extent = unit(angle).dot(middle);
  return {angle, extent / weight};
}

bool FloorplanGrammar::encode(const std::vector<Floorplan>& plans) {
  plans_ = plans;
  letters_.clear();
  strings_.assign(plans.size(), {});
  if (!(length_tolerance_ > 0.0) || !(angle_tolerance_ > 0.0)) {
    PCL_ERROR("[storey::FloorplanGrammar] tolerances are %g and %g rad, expected > 0.\n",
              length_tolerance_, angle_tolerance_);
    return false;
  }
  std::vector<Occurrence> edges = collectEdges();
  buildDictionary(edges);
  double extent = 0.0;
  for (const Occurrence& edge : edges) extent = std::max(extent, edge.middle.cwiseAbs().maxCoeff());
  std::size_t next = 0;
  for (std::size_t p = 0; p < plans_.size(); ++p) {
    for (const FloorplanRing* ring : ringsOf(plans_[p])) {
      std::vector<int> string;
      std::size_t start = 0;
      const auto farness = [&](std::size_t i) {
        return (ring->vertices[i] - extent * kFarPoint).squaredNorm();
      };
      for (std::size_t i = 0; i < ring->size(); ++i) {
        string.push_back(edges[next++].letter);
        if (farness(i) < farness(start)) start = i;
      }
      if (encoding_ == Encoding::Turns) {
        std::rotate(string.begin(), string.begin() + static_cast<std::ptrdiff_t>(start),
                    string.end());
      }
      strings_[p].push_back(std::move(string));
    }
  }
  return true;
}

double FloorplanGrammar::distance(std::size_t a, std::size_t b) const {
  const Strings& left = strings_[a];
  const Strings& right = strings_[b];
  const auto total = [](const Strings& strings) {
    std::size_t sum = 0;
    for (const std::vector<int>& string : strings) sum += string.size();
    return sum;
  };
  const std::size_t longest = std::max(total(left), total(right));
  if (longest == 0) return 0.0;
  const std::size_t n = std::max(left.size(), right.size());
  static const std::vector<int> kUnmatched;
  std::vector<double> cost(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<int>& x = i < left.size() ? left[i] : kUnmatched;
      const std::vector<int>& y = j < right.size() ? right[j] : kUnmatched;
      cost[i * n + j] = static_cast<double>(encoding_ == Encoding::Walls
                                                ? cyclicEditDistance(x, y, kSpecialLetter)
                                                : editDistance(x, y, kNothing));
    }
  }
  const std::vector<int> match = detail::solveAssignment(cost, static_cast<int>(n));
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += cost[i * n + static_cast<std::size_t>(match[i])];
  return a == b ? 0.0 : std::min(1.0, sum / static_cast<double>(longest));
}

Floorplan FloorplanGrammar::decode(std::size_t plan) const {
  Floorplan decoded = plans_[plan];
  // Without letters (bad tolerances) there is nothing to decode.
  if (encoding_ == Encoding::Turns || strings_[plan].empty()) return decoded;
  std::size_t next = 0;
  const auto decodeRing = [&](FloorplanRing& ring) {
    const std::vector<int>& string = strings_[plan][next++];
    const std::size_t n = ring.size();
    std::vector<Eigen::Vector2d> normals(n);
    std::vector<double> offsets(n);
    FloorplanRing exact = ring;
    for (std::size_t i = 0; i < n; ++i) {
      exact.edges[i].wall = string[i];
      if (string[i] != kSpecialLetter) {
        const Letter& letter = letters_[static_cast<std::size_t>(string[i])];
        normals[i] = unit(letter.angle);
        offsets[i] = letter.extent;
      } else {
        const Eigen::Vector2d along = ring.vertices[(i + 1) % n] - ring.vertices[i];
        normals[i] = Eigen::Vector2d(along.y(), -along.x()).normalized();
        offsets[i] = normals[i].dot(ring.vertices[i]);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + n - 1) % n;
      const double det = normals[j].x() * normals[i].y() - normals[j].y() * normals[i].x();
      exact.vertices[i] =
          Eigen::Vector2d(offsets[j] * normals[i].y() - offsets[i] * normals[j].y(),
                          normals[j].x() * offsets[i] - normals[i].x() * offsets[j]) /
          det;
    }
    ring.edges = exact.edges;
    if (isSimpleForward(exact, ring)) {
      ring = exact;
    } else {
      for (FloorplanEdge& edge : ring.edges) edge.wall = kSpecialLetter;
    }
  };
  for (FloorplanComponent& component : decoded.components) {
    decodeRing(component.outer);
    for (FloorplanRing& hole : component.holes) decodeRing(hole);
  }
  return decoded;
}

}  // namespace storey
