// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/cell_partition.h>
#include <storey/segmentation/detail/region_components.h>
#include <storey/segmentation/detail/union_find.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey::detail {
namespace {

// Cells whose numbers differ by 3 in a coordinate are 2 sides = 1.15 radii apart at least.
constexpr double kReach = 2.0;

using Iterator = std::vector<std::size_t>::iterator;

// Some points, as a part of a list of their numbers, with their bounding box.
struct Group {
  Iterator begin, end;
  Eigen::AlignedBox3d box;

  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

class ComponentFinder {
 public:
  ComponentFinder(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::uint32_t>& labels, double radius)
      : points_(points),
        squared_radius_(radius * radius),
        // the diagonal of a cell stays below the radius whatever the rounding
        partition_(partitionIntoCells(points, labels, radius / std::sqrt(3.0) * (1.0 - 1e-6))),
        sets_(points.size()) {}

  std::vector<std::size_t> find() {
    linkWithinCells();
    linkRow(0.0, 0.0, 1.0);
    for (double dy = 1.0; dy <= kReach; ++dy) {
      linkRow(0.0, dy, -kReach);
    }
    for (double dx = 1.0; dx <= kReach; ++dx) {
      for (double dy = -kReach; dy <= kReach; ++dy) {
        linkRow(dx, dy, -kReach);
      }
    }
    std::vector<std::size_t> component(points_.size());
    for (std::size_t i = 0; i < component.size(); ++i) {
      component[i] = sets_.find(i);
    }
    return component;
  }

 private:
  void linkWithinCells() {
    for (std::size_t c = 0; c < partition_.cells.size(); ++c) {
      for (std::size_t place = partition_.begin[c]; place < partition_.begin[c + 1]; ++place) {
        sets_.unite(partition_.order[partition_.begin[c]], partition_.order[place]);
      }
    }
  }

  // Links every cell with those at (dx, dy, from_dz .. kReach) from it. Both are met in the same
  // order, so that one walk along the sorted cells finds all of them.
  void linkRow(double dx, double dy, double from_dz) {
    const std::vector<LabeledCell>& cells = partition_.cells;
    std::size_t first = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      LabeledCell low = cells[c];
      low.x += dx;
      low.y += dy;
      LabeledCell high = low;
      low.z += from_dz;
      high.z += kReach;
      while (first < cells.size() && cells[first] < low) {
        ++first;
      }
      for (std::size_t d = first; d < cells.size() && !(high < cells[d]); ++d) {
        linkCells(c, d);
      }
    }
  }

  void linkCells(std::size_t c, std::size_t d) {
    const std::size_t i = partition_.order[partition_.begin[c]];
    const std::size_t j = partition_.order[partition_.begin[d]];
    if (sets_.find(i) != sets_.find(j) && anyWithinRadius(groupOfCell(c), groupOfCell(d))) {
      sets_.unite(i, j);
    }
  }

  Group groupOfCell(std::size_t c) {
    const auto place = [&](std::size_t cell) {
      return partition_.order.begin() + static_cast<std::ptrdiff_t>(partition_.begin[cell]);
    };
    return makeGroup(place(c), place(c + 1));
  }

  Group makeGroup(Iterator begin, Iterator end) const {
    Group group{begin, end, Eigen::AlignedBox3d()};
    for (Iterator it = begin; it != end; ++it) {
      group.box.extend(points_[*it]);
    }
    return group;
  }

  // Whether a point of one group lies within the radius of a point of the other. Boxes that are
  // near or far as a whole decide at once; else the larger one is halved.
  bool anyWithinRadius(const Group& a, const Group& b) {
    constexpr std::size_t kFewPairs = 64;
    if (a.box.squaredExteriorDistance(b.box) > squared_radius_) {
      return false;
    }
    if (a.box.merged(b.box).diagonal().squaredNorm() <= squared_radius_) {
      return true;
    }
    if (a.size() * b.size() <= kFewPairs) {
      return std::any_of(a.begin, a.end, [&](std::size_t i) {
        return std::any_of(b.begin, b.end, [&](std::size_t j) {
          return (points_[i] - points_[j]).squaredNorm() <= squared_radius_;
        });
      });
    }
    const double extent_a = a.box.sizes().maxCoeff();
    const double extent_b = b.box.sizes().maxCoeff();
    if (extent_a == 0.0 && extent_b == 0.0) {  // copies of two points
      return (points_[*a.begin] - points_[*b.begin]).squaredNorm() <= squared_radius_;
    }
    const Group& larger = extent_a >= extent_b ? a : b;
    const Group& smaller = extent_a >= extent_b ? b : a;
    const Iterator middle = halve(larger);
    return anyWithinRadius(makeGroup(larger.begin, middle), smaller) ||
           anyWithinRadius(makeGroup(middle, larger.end), smaller);
  }

  // Reorders the points of the group into two halves of its box, neither empty.
  Iterator halve(const Group& group) const {
    Eigen::Index axis = 0;
    group.box.sizes().maxCoeff(&axis);
    const double middle = 0.5 * (group.box.min()[axis] + group.box.max()[axis]);
    return std::partition(group.begin, group.end,
                          [&](std::size_t i) { return points_[i][axis] < middle; });
  }

  const std::vector<Eigen::Vector3d>& points_;
  const double squared_radius_;
  CellPartition partition_;
  UnionFind<> sets_;
};

}  // namespace

std::vector<std::size_t> labeledComponents(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::uint32_t>& labels,
                                           double radius) {
  return ComponentFinder(points, labels, radius).find();
}

}  // namespace storey::detail
