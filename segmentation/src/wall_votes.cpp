// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_votes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace storey::detail {
namespace {

constexpr int kDegrees = 360;
constexpr std::size_t kRows = 16;   // of a task
constexpr std::size_t kFew = 2000;  // points that are not worth a second thread

int degreeOf(double angle) {
  const int degree = static_cast<int>(std::floor(angle * kDegrees / (2.0 * M_PI))) % kDegrees;
  return degree < 0 ? degree + kDegrees : degree;
}

}  // namespace

// Points by the direction of their normals, whole degree by degree: those that vote for a row are
// together.
struct VoteTable::Ballots {
  std::vector<Eigen::Vector2d> positions;
  std::vector<Eigen::Vector2d> normals;
  std::vector<std::size_t> first;  // of each degree

  Ballots(const std::vector<WallPoint>& all, const std::vector<int>& numbers)
      : positions(numbers.size()), normals(numbers.size()), first(kDegrees + 1, 0) {
    std::vector<int> degrees;
    degrees.reserve(numbers.size());
    for (const int i : numbers) {
      const Eigen::Vector2d& normal = all[static_cast<std::size_t>(i)].normal;
      degrees.push_back(degreeOf(std::atan2(normal.y(), normal.x())));
      ++first[static_cast<std::size_t>(degrees.back()) + 1];
    }
    for (std::size_t d = 0; d < kDegrees; ++d) first[d + 1] += first[d];
    std::vector<std::size_t> next = first;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const WallPoint& p = all[static_cast<std::size_t>(numbers[k])];
      const std::size_t place = next[static_cast<std::size_t>(degrees[k])]++;
      positions[place] = p.position;
      normals[place] = p.normal;
    }
  }

  // Calls `work(from, to, sure)` for the ranges of points that may be within the angle of a row;
  // `sure`: all of them are.
  template <typename Work>
  void forEachRange(double row, const Work& work) const {
    constexpr int kReach = static_cast<int>(kVoteAngle * kDegrees / (2.0 * M_PI) + 0.5);
    for (int d = -kReach - 1; d <= kReach; ++d) {
      const auto degree = static_cast<std::size_t>((degreeOf(row) + d + kDegrees) % kDegrees);
      if (first[degree] == first[degree + 1]) continue;
      work(first[degree], first[degree + 1], std::abs(d) < kReach - 1);
    }
  }
};

VoteTable::VoteTable(const std::vector<WallPoint>& points, std::vector<double> angles, double bin,
                     int window, TaskCrew& crew)
    : points_(points),
      angles_(std::move(angles)),
      bin_(bin),
      bins_per_length_(1.0 / bin),
      window_(window),
      crew_(crew) {
  double squared = 0.0;
  for (const WallPoint& p : points) squared = std::max(squared, p.position.squaredNorm());
  const double radius = std::sqrt(squared);
  low_ = -radius - bin_;
  bins_ = static_cast<int>(2.0 * (radius + bin_) / bin_) + 2;
  votes_.assign(angles_.size() * static_cast<std::size_t>(bins_), 0);
  peaks_.resize(angles_.size());
  changed_.assign(angles_.size(), 1);
  for (const double angle : angles_) normals_.emplace_back(std::cos(angle), std::sin(angle));
}

void VoteTable::vote(const std::vector<int>& numbers, int amount) {
  const Ballots ballots(points_, numbers);
  const std::size_t rows = normals_.size();
  const std::size_t parts = numbers.size() > kFew ? (rows + kRows - 1) / kRows : 1;
  crew_.run(parts, [&](std::size_t part) {
    for (std::size_t a = part * rows / parts; a < (part + 1) * rows / parts; ++a) {
      voteInRow(a, ballots, amount);
    }
  });
}

void VoteTable::voteInRow(std::size_t angle, const Ballots& ballots, int amount) {
  const double least = std::cos(kVoteAngle);
  const Eigen::Vector2d normal = normals_[angle];
  int* row = votes_.data() + angle * static_cast<std::size_t>(bins_);
  ballots.forEachRange(angles_[angle], [&](std::size_t from, std::size_t to, bool sure) {
    for (std::size_t i = from; i < to; ++i) {
      if (!sure && normal.dot(ballots.normals[i]) < least) continue;
      row[binOf(normal.dot(ballots.positions[i]))] += amount;
    }
  });
  // Where votes are taken away, the strongest window stays so unless it loses some.
  if (amount < 0 && votesIn(angle, peaks_[angle].bin) == peaks_[angle].votes) return;
  changed_[angle] = 1;
  if (amount > 0) measurePeak(angle);
}

void VoteTable::measurePeak(std::size_t angle) {
  peaks_[angle] = strongestOf(angle);
  changed_[angle] = 0;
}

VoteTable::Peak VoteTable::strongest() {
  if (peaks_.empty()) return {};
  while (true) {
    const auto most =
        std::max_element(peaks_.begin(), peaks_.end(),
                         [](const Peak& a, const Peak& b) { return a.votes < b.votes; });
    const auto angle = static_cast<std::size_t>(most - peaks_.begin());
    if (changed_[angle] == 0) return *most;
    measurePeak(angle);
  }
}

void VoteTable::strikeOut(const Peak& peak) {
  struck_.push_back(peak);
  changed_[peak.angle] = 1;
}

void VoteTable::takeBack(std::size_t strikes) {
  for (; strikes > 0; --strikes) {
    const std::size_t angle = struck_.back().angle;
    changed_[angle] = 1;
    peaks_[angle].votes = std::numeric_limits<int>::max();  // there may be more than before
    struck_.pop_back();
  }
}

WallLine VoteTable::lineAt(const Peak& peak) const {
  const int* row = votes_.data() + peak.angle * static_cast<std::size_t>(bins_);
  double sum = 0.0;
  double weight = 0.0;
  for (int b = peak.bin - window_ / 2; b <= peak.bin + window_ / 2; ++b) {
    if (b < 0 || b >= bins_ || row[b] <= 0) continue;
    sum += row[b] * (low_ + (b + 0.5) * bin_);
    weight += row[b];
  }
  WallLine line;
  line.normal = normals_[peak.angle];
  line.offset = weight > 0.0 ? sum / weight : low_ + (peak.bin + 0.5) * bin_;
  return line;
}

VoteTable::Peak VoteTable::strongestOf(std::size_t angle) const {
  Peak best;
  const int* row = votes_.data() + angle * static_cast<std::size_t>(bins_);
  int sum = 0;
  for (int b = 0; b < bins_; ++b) {
    sum += row[b];
    if (b >= window_) sum -= row[b - window_];
    if (sum > best.votes && !struckOut(angle, b - window_ / 2)) {
      best = {angle, b - window_ / 2, sum};
    }
  }
  return best;
}

int VoteTable::votesIn(std::size_t angle, int bin) const {
  const int* row = votes_.data() + angle * static_cast<std::size_t>(bins_);
  const int end = bin + window_ / 2 + 1;
  return std::accumulate(row + std::max(0, end - window_), row + end, 0);
}

bool VoteTable::struckOut(std::size_t angle, int bin) const {
  return std::any_of(struck_.begin(), struck_.end(),
                     [&](const Peak& p) { return p.angle == angle && std::abs(p.bin - bin) <= 1; });
}

}  // namespace storey::detail
