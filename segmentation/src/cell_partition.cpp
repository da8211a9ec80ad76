// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/cell_partition.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey::detail {

CellPartition partitionIntoCells(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<std::uint32_t>& labels, double side) {
  std::vector<LabeledCell> cell_of_point(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell_of_point[i] = {labels[i], std::floor(points[i].x() / side),
                        std::floor(points[i].y() / side), std::floor(points[i].z() / side)};
  }
  CellPartition result;
  result.order.resize(points.size());
  std::iota(result.order.begin(), result.order.end(), std::size_t{0});
  std::sort(result.order.begin(), result.order.end(), [&](std::size_t i, std::size_t j) {
    return std::tuple_cat(cell_of_point[i].key(), std::tie(i)) <
           std::tuple_cat(cell_of_point[j].key(), std::tie(j));
  });
  for (std::size_t place = 0; place < result.order.size(); ++place) {
    const LabeledCell& cell = cell_of_point[result.order[place]];
    if (result.cells.empty() || !(result.cells.back() == cell)) {
      result.cells.push_back(cell);
      result.begin.push_back(place);
    }
  }
  result.begin.push_back(result.order.size());
  return result;
}

}  // namespace storey::detail
