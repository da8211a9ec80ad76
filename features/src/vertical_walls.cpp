// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/vertical_kernels.h>
#include <storey/filters/detail/chunks.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace storey::detail {
namespace {

constexpr double kWallGate = 0.35;      // |n.up| of a wall with noise of 15 degrees
constexpr double kFewestPoints = 30.0;  // of a column
constexpr double kFlat = 4.0;           // variance along over variance across a wall, at least
constexpr double kRoughness = 4.0;      // variance across over that of good columns, at most
constexpr double kStraightness = 3e-4;  // rad, how well real walls stand
constexpr double kTukey = 4.685;        // 95 % efficiency under normal errors
constexpr double kNormalMad = 1.4826;   // standard deviation over median absolute deviation
constexpr double kSinSamePlane = 0.1;   // walls that differ by less than 6 degrees face one way
constexpr int kRounds = 8;
constexpr int kTukeyRounds = 20;
constexpr double kSettled = 1e-6;   // rad
constexpr double kMinorTurn = 0.5;  // deviations: so much every turn changes the columns anyway

// The plane of one column of wall: its horizontal normal, and its lean n.up with that value's
// standard deviation.
struct Column {
  Eigen::Vector2d normal;
  double lean = 0.0;
  double deviation = 0.0;
  double variance = 0.0;  // across the plane
};

// Moments of the points of a column in upright local coordinates, about a point inside it.
struct ColumnMoments {
  double count = 0.0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();  // yz, xz, xy

  void add(const Eigen::Vector3d& point) {
    if (count == 0.0) {
      origin = point;
    }
    const Eigen::Vector3d d = point - origin;
    count += 1.0;
    sum += d;
    squares += d.cwiseProduct(d);
    products += Eigen::Vector3d(d.y() * d.z(), d.x() * d.z(), d.x() * d.y());
  }

  // What another part of the same column holds.
  void add(const ColumnMoments& other) {
    if (count == 0.0) {
      origin = other.origin;
    }
    const Eigen::Vector3d d = other.origin - origin;
    const Eigen::Vector3d& s = other.sum;
    const double n = other.count;
    count += n;
    sum += s + n * d;
    squares += other.squares + 2.0 * d.cwiseProduct(s) + n * d.cwiseProduct(d);
    products += other.products + Eigen::Vector3d(d.y() * s.z() + s.y() * d.z() + n * d.y() * d.z(),
                                                 d.x() * s.z() + s.x() * d.z() + n * d.x() * d.z(),
                                                 d.x() * s.y() + s.x() * d.y() + n * d.x() * d.y());
  }

  Eigen::Matrix3d covariance() const {
    Eigen::Matrix3d c;
    c << squares.x(), products.z(), products.y(), products.z(), squares.y(), products.x(),
        products.y(), products.x(), squares.z();
    const Eigen::Vector3d mean = sum / count;
    return c / count - mean * mean.transpose();
  }
};

// Columns by the number of their cell, in the order in which they were first met: an open table.
class Columns {
 public:
  ColumnMoments& of(std::uint64_t cell) {
    if (2 * (columns_.size() + 1) > slots_.size()) {
      grow();
    }
    std::size_t& column = slotOf(cell);
    if (column == kNone) {
      column = columns_.size();
      columns_.emplace_back();
      cells_.push_back(cell);
    }
    return columns_[column];
  }

  // After those that were met before.
  void add(const Columns& others) {
    for (std::size_t column = 0; column < others.columns_.size(); ++column) {
      of(others.cells_[column]).add(others.columns_[column]);
    }
  }

  const std::vector<ColumnMoments>& all() const { return columns_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::size_t& slotOf(std::uint64_t cell) {
    std::uint64_t slot = cell * 0x9e3779b97f4a7c15u;  // Fibonacci hashing
    for (slot = (slot ^ slot >> 32) & (slots_.size() - 1);
         slots_[slot] != kNone && cells_[slots_[slot]] != cell;
         slot = (slot + 1) & (slots_.size() - 1)) {
    }
    return slots_[slot];
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(1024, 4 * slots_.size()), kNone);
    for (std::size_t column = 0; column < cells_.size(); ++column) {
      slotOf(cells_[column]) = column;
    }
  }

  std::vector<std::size_t> slots_;
  std::vector<std::uint64_t> cells_;
  std::vector<ColumnMoments> columns_;
};

double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The columns that wall points stand in, by the first of their points.
Columns columnsOf(const Vectors3d& positions, const Vectors3d& normals, const Eigen::Vector3d& up,
                  double cell, int num_threads) {
  Eigen::Matrix3d to_local;
  to_local << tangentFrame(up).transpose(), up.transpose();
  constexpr double kMiddle = 2147483648.0;  // of the numbers of cells
  const double cells_a_length = 1.0 / cell;
  const auto threads = static_cast<unsigned int>(num_threads);
  std::vector<Columns> parts(Chunks(positions.size()).count());
  forEachChunk(positions.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (std::abs(normals[i].dot(up)) >= kWallGate) {
        continue;
      }
      const Eigen::Vector3d point = to_local * positions[i];
      const double x = point.x() * cells_a_length + kMiddle;
      const double y = point.y() * cells_a_length + kMiddle;
      if (x >= 0.0 && y >= 0.0 && std::max(x, y) < 2.0 * kMiddle) {
        parts[c].of(static_cast<std::uint64_t>(x) << 32 | static_cast<std::uint64_t>(y)).add(point);
      }
    }
  });
  Columns columns;
  for (const Columns& part : parts) {
    columns.add(part);
  }
  return columns;
}

// Total least squares plane of the points of a column; false if they are no upright plane.
bool fitColumn(const ColumnMoments& moments, Column& column) {
  const double n = moments.count;
  const Eigen::Matrix3d covariance = moments.covariance();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double across = std::max(solver.eigenvalues()[0], 0.0);
  const double horizontal = normal.head<2>().norm();
  if (solver.eigenvalues()[1] < kFlat * across || !(covariance(2, 2) > 0.0) || horizontal < 0.9) {
    return false;
  }
  column.normal = normal.head<2>() / horizontal;
  column.lean = normal.z() / horizontal;
  column.variance = across;
  column.deviation = std::hypot(std::sqrt(across / (n * covariance(2, 2))), kStraightness);
  return true;
}

std::vector<Column> fitColumns(const Vectors3d& positions, const Vectors3d& normals,
                               const Eigen::Vector3d& up, double cell, int num_threads) {
  std::vector<Column> columns;
  const Columns found = columnsOf(positions, normals, up, cell, num_threads);
  for (const ColumnMoments& moments : found.all()) {
    Column column;
    if (moments.count >= kFewestPoints && fitColumn(moments, column)) {
      columns.push_back(column);
    }
  }
  if (columns.empty()) {
    return columns;
  }
  // Columns with a corner, two walls, or a tree are thicker than the good ones.
  std::vector<double> variances;
  for (const Column& c : columns) {
    variances.push_back(c.variance);
  }
  const double roughest = kRoughness * quantile(variances, 0.25);
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                               [=](const Column& c) { return c.variance > roughest; }),
                columns.end());
  return columns;
}

// The weighted normal equations of lean + normal.turn = 0, and the spread of the residuals.
struct Equations {
  Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  double scale = 1.0;
};

Equations equationsAt(const std::vector<Column>& columns, const Eigen::Vector2d& turn) {
  std::vector<double> sizes;
  for (const Column& c : columns) {
    sizes.push_back(std::abs(c.lean + c.normal.dot(turn)) / c.deviation);
  }
  Equations e;
  e.scale = std::max(1.0, kNormalMad * quantile(sizes, 0.5));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double t = sizes[i] / (kTukey * e.scale);
    if (t < 1.0) {
      const Column& c = columns[i];
      const double weight = (1.0 - t * t) * (1.0 - t * t) / (c.deviation * c.deviation);
      e.a += weight * c.normal * c.normal.transpose();
      e.b -= weight * c.lean * c.normal;
    }
  }
  return e;
}

// Solves for the turn, in the determined direction only if the walls face but one way.
Eigen::Vector2d robustTurn(const std::vector<Column>& columns,
                           const Eigen::Matrix<double, 3, 2>& frame, VerticalFit& fit) {
  Eigen::Vector2d turn = Eigen::Vector2d::Zero();
  for (int round = 0; round < kTukeyRounds; ++round) {
    const Equations e = equationsAt(columns, turn);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(e.a);
    const Eigen::Vector2d strength = solver.eigenvalues();
    const Eigen::Vector2d loose = solver.eigenvectors().col(0);
    const Eigen::Vector2d firm = solver.eigenvectors().col(1);
    if (!(strength[1] > 0.0)) {
      break;
    }
    fit.one_direction = strength[0] < kSinSamePlane * kSinSamePlane * strength[1];
    fit.loose = frame * loose;
    fit.deviation = e.scale / std::sqrt(fit.one_direction ? strength[1] : strength[0]);
    turn = firm * (firm.dot(e.b) / strength[1]);
    if (!fit.one_direction) {
      turn += loose * (loose.dot(e.b) / strength[0]);
    }
  }
  return turn;
}

}  // namespace

VerticalFit refineByPositions(const Vectors3d& positions, const Vectors3d& normals,
                              const Eigen::Vector3d& up, double cell, int num_threads) {
  VerticalFit fit;
  fit.up = up;
  for (int round = 0; round < kRounds && cell > 0.0; ++round) {
    const std::vector<Column> columns = fitColumns(positions, normals, fit.up, cell, num_threads);
    fit.patches = static_cast<int>(columns.size());
    if (columns.empty()) {
      break;
    }
    const Eigen::Matrix<double, 3, 2> frame = tangentFrame(fit.up);
    const Eigen::Vector2d turn = robustTurn(columns, frame, fit);
    fit.up = (fit.up + frame * turn).normalized();
    if (turn.norm() < std::max(kSettled, kMinorTurn * fit.deviation)) {
      break;
    }
  }
  return fit;
}

}  // namespace storey::detail
