// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace storey::detail {

/// Points in the coordinates of a line, together in memory: what asks for them again and again
/// neither gathers nor projects them each time.
struct LinePoints {
  std::vector<Eigen::Vector2d> position;
  std::vector<double> s;    ///< along the line
  std::vector<double> d;    ///< across it
  std::vector<double> z;    ///< height
  std::vector<int> number;  ///< of each point in the list that it is from

  LinePoints() = default;
  LinePoints(const std::vector<WallPoint>& points, const std::vector<int>& numbers,
             const WallLine& line);

  std::size_t size() const { return number.size(); }
  bool empty() const { return number.empty(); }

  /// Keeps the points k for which `keeps(k)` is true, in order.
  template <typename Predicate>
  void keepWhere(const Predicate& keeps) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      if (!keeps(k)) continue;
      position[kept] = position[k];
      s[kept] = s[k];
      d[kept] = d[k];
      z[kept] = z[k];
      number[kept] = number[k];
      ++kept;
    }
    resize(kept);
  }

  /// Which of them have |d| below the gate.
  std::vector<std::size_t> within(double gate) const;
  LinePoints only(const std::vector<std::size_t>& kept) const;

  /// Changes to the coordinates of another line.
  void moveTo(const WallLine& line);

 private:
  void resize(std::size_t size);
};

/// The least and the greatest of some values, of which there is one at least.
std::pair<double, double> rangeOf(const std::vector<double>& values);
/// Of some of the values alone.
std::pair<double, double> rangeOf(const std::vector<double>& values,
                                  const std::vector<std::size_t>& some);

}  // namespace storey::detail
