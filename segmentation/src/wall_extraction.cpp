// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_input.h>
#include <storey/segmentation/detail/wall_lines.h>
#include <storey/segmentation/detail/wall_support.h>
#include <storey/segmentation/wall_extraction.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kGate = 3.0;  // noise deviations

bool isAt(const WallLine& line, const WallPoint& p, double margin) {
  if (p.z < line.z_min - margin || p.z > line.z_max + margin) return false;
  const double s = line.along(p.position);
  return std::any_of(line.runs.begin(), line.runs.end(), [&](const auto& run) {
    return s > run.first - margin && s < run.second + margin;
  });
}

}  // namespace

std::vector<int> assignToWalls(const std::vector<WallPoint>& points,
                               const std::vector<WallLine>& lines, const WallScale& scale) {
  std::vector<int> walls(points.size(), -1);
  const double margin = 2.0 * supportCellSize(scale);  // the heights of a line lack its last 3 %
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = kGate * scale.noise;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      const double d = std::abs(lines[l].across(points[i].position));
      if (d >= nearest || lines[l].normal.dot(points[i].normal) < kMinAgreement) continue;
      if (!isAt(lines[l], points[i], margin)) continue;
      nearest = d;
      walls[i] = static_cast<int>(l);
    }
  }
  return walls;
}

}  // namespace storey::detail

template class storey::WallExtraction<pcl::PointNormal>;
template class storey::WallExtraction<pcl::PointXYZRGBNormal>;
template class storey::WallExtraction<pcl::PointXYZINormal>;
template class storey::WallExtraction<pcl::PointXYZLNormal>;
