// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/found_line.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr double kCandidateGate = 12.0;  // noise deviations
const double kVoteAgreement = std::cos(kVoteAngle);
constexpr double kSameAngle = 0.1 * M_PI / 180.0;  // rad, least gap between directions
constexpr double kAngleDeviations = 4.0;
constexpr double kMinDirectionShare = 0.04;  // of the supported area
constexpr double kOutweighs = 3.0;
constexpr double kSupportMargin = 5.0;  // noise deviations beyond the ends of a line

struct Group {
  double angle = 0.0;
  double weight = 0.0;  // 1 / variance
  double area = 0.0;
  int lines = 0;
};

// Lines of one direction, strongest first.
std::vector<Group> groupsOf(const std::vector<FoundLine>& lines) {
  std::vector<Group> groups;
  for (const auto& [line, support] : lines) {  // strongest first
    double angle = std::atan2(line.normal.y(), line.normal.x());
    if (angle < 0.0) angle += M_PI;
    const double deviation = std::max(line.angle_deviation, 1e-5);
    const double weight = 1.0 / (deviation * deviation);
    bool found = false;
    for (Group& group : groups) {
      double turn = std::remainder(angle - group.angle, M_PI);
      const double gap = std::max(
          kSameAngle, kAngleDeviations * std::hypot(deviation, 1.0 / std::sqrt(group.weight)));
      if (std::abs(turn) > gap) continue;
      group.angle += turn * weight / (group.weight + weight);
      group.weight += weight;
      group.area += line.support_area;
      ++group.lines;
      found = true;
      break;
    }
    if (!found) groups.push_back({angle, weight, line.support_area, 1});
  }
  return groups;
}

std::vector<int> numbersOf(const std::vector<char>& marks) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) numbers.push_back(static_cast<int>(i));
  }
  return numbers;
}

void addPerpendiculars(std::vector<double>& angles) {
  const std::vector<double> found = angles;
  for (const double angle : found) {
    const double right = angle < M_PI_2 ? angle + M_PI_2 : angle - M_PI_2;
    const bool known = std::any_of(angles.begin(), angles.end(), [&](double other) {
      return std::abs(std::remainder(other - right, M_PI)) < kNearDirection;
    });
    if (!known) angles.push_back(right);
  }
}

}  // namespace

PointPool::PointPool(const std::vector<WallPoint>& all, const std::vector<char>& free)
    : points(all), numbers(numbersOf(free)), blocks(all, numbers) {}

void PointPool::shrink(const std::vector<char>& free) {
  const auto is_taken = [&](int i) { return free[static_cast<std::size_t>(i)] == 0; };
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), is_taken), numbers.end());
  blocks = PointBlocks(points, numbers);
}

bool isCandidate(const WallLine& guess, const WallPoint& p, double noise) {
  const bool near = std::abs(guess.across(p.position)) < kCandidateGate * noise;
  const bool agrees = guess.normal.dot(p.normal) >= kVoteAgreement;
  return static_cast<unsigned int>(near) & static_cast<unsigned int>(agrees);
}

std::vector<int> candidatesFor(const PointPool& pool, const std::vector<char>& free,
                               const WallLine& line, double noise, const LineStretch& stretch) {
  const PointBlocks& blocks = pool.blocks;
  std::vector<int> candidates;
  std::array<int, PointBlocks::kLength> held;
  const PlanStrip strip{line.normal, line.offset, kCandidateGate * noise, stretch.s_min,
                        stretch.s_max};
  blocks.forEachIn(strip, [&](std::size_t block) {
    auto end = held.begin();
    for (std::size_t k = blocks.begin(block); k < blocks.end(block); ++k) {
      const int i = pool.numbers[k];
      const WallPoint& p = pool.points[static_cast<std::size_t>(i)];
      const double s = line.along(p.position);
      *end = i;  // overwritten by the next, or not: a branch would be guessed wrongly
      end += free[static_cast<std::size_t>(i)] & static_cast<int>(isCandidate(line, p, noise)) &
             static_cast<int>(s >= stretch.s_min) & static_cast<int>(s <= stretch.s_max);
    }
    candidates.insert(candidates.end(), held.begin(), end);
  });
  return candidates;
}

bool explains(const WallLine& line, const WallPoint& p, double across, double noise) {
  const double s = line.along(p.position);
  const double margin = kSupportMargin * noise;
  return std::abs(line.across(p.position)) < across && line.normal.dot(p.normal) > kMinAgreement &&
         s > line.s_min - margin && s < line.s_max + margin && p.z > line.z_min - margin &&
         p.z < line.z_max + margin;
}

std::vector<double> directionsOf(const std::vector<FoundLine>& lines) {
  const std::vector<Group> groups = groupsOf(lines);
  double total = 0.0;
  for (const Group& group : groups) total += group.area;
  std::vector<double> angles;
  for (const Group& group : groups) {
    if (group.area < kMinDirectionShare * total && group.lines < 2) continue;
    const bool outweighed = std::any_of(groups.begin(), groups.end(), [&](const Group& other) {
      return std::abs(std::remainder(other.angle - group.angle, M_PI)) < kNearDirection &&
             other.area > kOutweighs * group.area;
    });
    if (!outweighed) angles.push_back(group.angle);
  }
  addPerpendiculars(angles);
  std::sort(angles.begin(), angles.end());
  return angles;
}

}  // namespace storey::detail
