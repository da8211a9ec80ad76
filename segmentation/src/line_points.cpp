// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/line_points.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {

LinePoints::LinePoints(const std::vector<WallPoint>& points, const std::vector<int>& numbers,
                       const WallLine& line)
    : number(numbers) {
  resize(numbers.size());
  for (std::size_t k = 0; k < size(); ++k) {
    const WallPoint& p = points[static_cast<std::size_t>(numbers[k])];
    position[k] = p.position;
    z[k] = p.z;
  }
  moveTo(line);
}

std::vector<std::size_t> LinePoints::within(double gate) const {
  std::vector<std::size_t> near(size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    near[kept] = k;
    kept += std::abs(d[k]) < gate ? 1 : 0;  // overwritten by the next, or not
  }
  near.resize(kept);
  return near;
}

LinePoints LinePoints::only(const std::vector<std::size_t>& kept) const {
  LinePoints some;
  some.resize(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    some.position[k] = position[kept[k]];
    some.s[k] = s[kept[k]];
    some.d[k] = d[kept[k]];
    some.z[k] = z[kept[k]];
    some.number[k] = number[kept[k]];
  }
  return some;
}

void LinePoints::moveTo(const WallLine& line) {
  for (std::size_t k = 0; k < size(); ++k) {
    s[k] = line.along(position[k]);
    d[k] = line.across(position[k]);
  }
}

std::pair<double, double> rangeOf(const std::vector<double>& values) {
  double low = values.front();
  double high = low;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {low, high};
}

std::pair<double, double> rangeOf(const std::vector<double>& values,
                                  const std::vector<std::size_t>& some) {
  double low = values[some.front()];
  double high = low;
  for (const std::size_t i : some) {
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  return {low, high};
}

void LinePoints::resize(std::size_t size) {
  position.resize(size);
  s.resize(size);
  d.resize(size);
  z.resize(size);
  number.resize(size);
}

}  // namespace storey::detail
