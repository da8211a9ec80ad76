// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "io/polygon_soup.h"

/// The model that evaluations are tested with, that of the generated building "box".
namespace storey::test {

inline io::PolygonSoup box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  io::PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  const std::vector<std::vector<int>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    io::PolygonSoup::Polygon polygon;
    polygon.corners = faces[i];
    polygon.label = i == 0 ? 2 : i == 1 ? 1 : 0;
    soup.polygons.push_back(polygon);
  }
  return soup;
}

inline const Eigen::Vector3d kLow(-10.0, -7.0, 0.0);
inline const Eigen::Vector3d kHigh(10.0, 7.0, 24.0);

}  // namespace storey::test
