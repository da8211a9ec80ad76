// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace storey::detail {

/// A cube of a regular grid with the points of one label in it. The coordinates are whole numbers,
/// floor(position / side), kept as double: no position of a cloud is too far away for them.
struct LabeledCell {
  std::uint32_t label;
  double x, y, z;

  auto key() const { return std::tie(label, x, y, z); }
  bool operator<(const LabeledCell& other) const { return key() < other.key(); }
  bool operator==(const LabeledCell& other) const { return key() == other.key(); }
};

/// Points sorted into cells, so that the points of one label in one cube are together.
struct CellPartition {
  std::vector<LabeledCell> cells;  ///< ascending by label, x, y, z; none is empty
  std::vector<std::size_t> begin;  ///< cells.size() + 1 places in `order`
  std::vector<std::size_t> order;  ///< numbers of points, cell by cell, ascending within a cell
};

/// O(n log n). \param labels parallel to `points` \param side > 0, in the unit of the points
CellPartition partitionIntoCells(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<std::uint32_t>& labels, double side);

}  // namespace storey::detail
