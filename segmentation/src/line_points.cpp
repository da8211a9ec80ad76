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

LinePoints LinePoints::within(double gate) const {
  LinePoints near;
  near.resize(size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    near.position[kept] = position[k];
    near.s[kept] = s[k];
    near.d[kept] = d[k];
    near.z[kept] = z[k];
    near.number[kept] = number[k];
    kept += std::abs(d[k]) < gate ? 1 : 0;  // overwritten by the next, or not
  }
  near.resize(kept);
  return near;
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

void LinePoints::resize(std::size_t size) {
  position.resize(size);
  s.resize(size);
  d.resize(size);
  z.resize(size);
  number.resize(size);
}

}  // namespace storey::detail
