// SPDX-License-Identifier: BSD-3-Clause
#include "synth/column_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "synth/random.h"

namespace storey::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A line of a column meets a triangle. `enters`: +1 into the solid when going up, -1 out of it.
struct Crossing {
  std::size_t column;
  double z;
  int solid;
  int enters;
};

/// The raster of columns, seen from above, one row of it at a time.
class Raster {
 public:
  Raster(const Eigen::AlignedBox2d& box, int cells)
      : box_(box), cells_(cells), size_(box.sizes() / cells) {}

  int cells() const { return cells_; }
  double cellArea() const { return size_.prod(); }

  /// Random places of the columns of a row, the same whoever asks.
  std::vector<Vector2d> columnsOfRow(int row) const {
    Random random(static_cast<std::uint64_t>(row), 77);
    std::vector<Vector2d> columns;
    for (int i = 0; i < cells_; ++i) {
      const double u = random.uniform();
      const double v = random.uniform();
      columns.push_back(box_.min() + Vector2d(i + u, row + v).cwiseProduct(size_));
    }
    return columns;
  }

  /// Cells that [low, high] touches along an axis, as first and one past the last.
  std::pair<int, int> cellsBetween(double low, double high, Eigen::Index axis) const {
    const auto cell = [&](double at) {
      return std::clamp(std::floor((at - box_.min()[axis]) / size_[axis]), 0.0, cells_ - 1.0);
    };
    return {static_cast<int>(cell(low)), static_cast<int>(cell(high)) + 1};
  }

 private:
  Eigen::AlignedBox2d box_;
  int cells_;
  Vector2d size_;
};

/// Twice the area of (a, b, p), seen from above. The ends are sorted first, so that both triangles
/// at an edge get the same number but for the sign, and no column slips between them.
double orient(const Vector3d& a, const Vector3d& b, const Vector2d& p) {
  const bool swapped = std::make_pair(b.x(), b.y()) < std::make_pair(a.x(), a.y());
  const Vector3d& s = swapped ? b : a;
  const Vector3d& t = swapped ? a : b;
  const double area = (t.x() - s.x()) * (p.y() - s.y()) - (t.y() - s.y()) * (p.x() - s.x());
  // On the line counts as left of the sorted edge: to one triangle inside, to its neighbour not.
  const double decided = area == 0.0 ? 1e-300 : area;
  return swapped ? -decided : decided;
}

void addCrossings(const TriangleMesh& mesh, std::size_t t, int solid, const Raster& raster,
                  const std::vector<Vector2d>& columns, std::vector<Crossing>& crossings) {
  const Vector3d& a = mesh.corner(t, 0);
  const Vector3d& b = mesh.corner(t, 1);
  const Vector3d& c = mesh.corner(t, 2);
  const auto [x_min, x_max] = std::minmax({a.x(), b.x(), c.x()});
  const auto [first, last] = raster.cellsBetween(x_min, x_max, 0);
  for (int i = first; i < last; ++i) {
    const Vector2d& p = columns[static_cast<std::size_t>(i)];
    const double bc = orient(b, c, p);
    const double ca = orient(c, a, p);
    const double ab = orient(a, b, p);
    const bool up = bc > 0.0 && ca > 0.0 && ab > 0.0;
    const bool down = bc < 0.0 && ca < 0.0 && ab < 0.0;
    if (up || down) {
      const double z = (bc * a.z() + ca * b.z() + ab * c.z()) / (bc + ca + ab);
      crossings.push_back({static_cast<std::size_t>(i), z, solid, down ? 1 : -1});
    }
  }
}

/// Triangles by the rows of the raster that they reach into.
std::vector<std::vector<std::size_t>> trianglesOfRows(const TriangleMesh& mesh,
                                                      const Raster& raster) {
  std::vector<std::vector<std::size_t>> rows(static_cast<std::size_t>(raster.cells()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [y_min, y_max] =
        std::minmax({mesh.corner(t, 0).y(), mesh.corner(t, 1).y(), mesh.corner(t, 2).y()});
    const auto [first, last] = raster.cellsBetween(y_min, y_max, 1);
    for (int row = first; row < last; ++row) {
      rows[static_cast<std::size_t>(row)].push_back(t);
    }
  }
  return rows;
}

/// Adds the lengths inside each solid and inside both along all columns of a row.
void measure(std::vector<Crossing>& crossings, SolidOverlap& lengths) {
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::make_pair(a.column, a.z) < std::make_pair(b.column, b.z);
  });
  for (std::size_t i = 0; i < crossings.size();) {
    const std::size_t column = crossings[i].column;
    int depth[2] = {0, 0};
    for (; i < crossings.size() && crossings[i].column == column; ++i) {
      depth[crossings[i].solid] += crossings[i].enters;
      if (i + 1 == crossings.size() || crossings[i + 1].column != column) {
        continue;
      }
      const double length = crossings[i + 1].z - crossings[i].z;
      lengths.first += depth[0] != 0 ? length : 0.0;
      lengths.second += depth[1] != 0 ? length : 0.0;
      lengths.both += depth[0] != 0 && depth[1] != 0 ? length : 0.0;
    }
    lengths.open_columns += depth[0] != 0 || depth[1] != 0 ? 1 : 0;
  }
}

}  // namespace

SolidOverlap overlapOfSolids(const TriangleMesh& first, const TriangleMesh& second,
                             int columns_per_side) {
  Eigen::AlignedBox2d box;
  const TriangleMesh* const meshes[2] = {&first, &second};
  for (const TriangleMesh* mesh : meshes) {
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        box.extend(Vector2d(mesh->corner(t, i).head<2>()));
      }
    }
  }
  SolidOverlap overlap;
  if (box.isEmpty() || !(box.volume() > 0.0)) {
    return overlap;
  }
  const Raster raster(box, columns_per_side);
  const std::vector<std::vector<std::size_t>> rows[2] = {trianglesOfRows(first, raster),
                                                         trianglesOfRows(second, raster)};
  for (int row = 0; row < columns_per_side; ++row) {
    const std::vector<Vector2d> columns = raster.columnsOfRow(row);
    std::vector<Crossing> crossings;
    for (int solid = 0; solid < 2; ++solid) {
      for (const std::size_t t : rows[solid][static_cast<std::size_t>(row)]) {
        addCrossings(*meshes[solid], t, solid, raster, columns, crossings);
      }
    }
    measure(crossings, overlap);
  }
  overlap.first *= raster.cellArea();
  overlap.second *= raster.cellArea();
  overlap.both *= raster.cellArea();
  return overlap;
}

}  // namespace storey::synth
