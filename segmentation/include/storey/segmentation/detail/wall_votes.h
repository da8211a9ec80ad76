// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/task_crew.h>
#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Votes of points over (direction, bin of the offset) for the lines that they may be of. Rows may
/// have any set of directions.
class VoteTable {
 public:
  struct Peak {
    std::size_t angle = 0;
    int bin = 0;
    int votes = 0;
  };

  /// \param angles of the rows' normals, rad \param bin width \param window bins that are summed
  /// \param crew that counts votes; they are the same for any number of threads
  VoteTable(const std::vector<WallPoint>& points, std::vector<double> angles, double bin,
            int window, TaskCrew& crew);

  /// Adds `amount` for each of the points of these numbers, in all rows within `kVoteAngle` of its
  /// normal.
  void vote(const std::vector<int>& numbers, int amount);

  /// The window with most votes. What was struck out does not count.
  Peak strongest();
  void strikeOut(const Peak& peak);
  void takeBack(std::size_t strikes);  ///< the last ones

  /// A line at the mean offset of the window's votes, not at its middle.
  WallLine lineAt(const Peak& peak) const;

 private:
  struct Ballots;

  void voteInRow(std::size_t angle, const Ballots& ballots, int amount);
  int binOf(double offset) const {
    const auto bin = static_cast<int>((offset - low_) * bins_per_length_);
    return bin < 0 ? 0 : bin < bins_ ? bin : bins_ - 1;
  }
  void measurePeak(std::size_t angle);
  Peak strongestOf(std::size_t angle) const;
  int votesIn(std::size_t angle, int bin) const;  // in the window about the bin
  bool struckOut(std::size_t angle, int bin) const;

  const std::vector<WallPoint>& points_;
  std::vector<double> angles_;
  std::vector<Eigen::Vector2d> normals_;
  double bin_;
  double bins_per_length_;
  int window_;
  TaskCrew& crew_;
  double low_ = 0.0;
  int bins_ = 0;
  std::vector<int> votes_;
  std::vector<Peak> peaks_;    // of each angle; where it changed, with no less votes than there are
  std::vector<char> changed_;  // angles whose peak is to be found again
  std::vector<Peak> struck_;
};

}  // namespace storey::detail
