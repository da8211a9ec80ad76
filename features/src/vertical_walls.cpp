// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/vertical_kernels.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

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
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& point) {
    if (count == 0.0) {
      origin = point;
    }
    const Eigen::Vector3d d = point - origin;
    count += 1.0;
    sum += d;
    products += d * d.transpose();
  }
};

double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The columns that wall points stand in, by the first of their points.
std::vector<ColumnMoments> momentsOfColumns(const Vectors3d& positions, const Vectors3d& normals,
                                            const Eigen::Vector3d& up, double cell) {
  Eigen::Matrix3d to_local;
  to_local << tangentFrame(up).transpose(), up.transpose();
  std::unordered_map<std::uint64_t, std::size_t> column_of_cell;
  std::vector<ColumnMoments> columns;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::abs(normals[i].dot(up)) >= kWallGate) {
      continue;
    }
    const Eigen::Vector3d point = to_local * positions[i];
    const Eigen::Array2d c = (point.head<2>() / cell).array().floor();
    if (c.abs().maxCoeff() < 1e9) {
      const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(c.x()) + (1LL << 31));
      const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(c.y()) + (1LL << 31));
      const auto [place, is_new] = column_of_cell.try_emplace(x << 32 | y, columns.size());
      if (is_new) {
        columns.emplace_back();
      }
      columns[place->second].add(point);
    }
  }
  return columns;
}

// Total least squares plane of the points of a column; false if they are no upright plane.
bool fitColumn(const ColumnMoments& moments, Column& column) {
  const double n = moments.count;
  const Eigen::Vector3d mean = moments.sum / n;
  const Eigen::Matrix3d covariance = moments.products / n - mean * mean.transpose();
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
                               const Eigen::Vector3d& up, double cell) {
  std::vector<Column> columns;
  for (const ColumnMoments& moments : momentsOfColumns(positions, normals, up, cell)) {
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
                              const Eigen::Vector3d& up, double cell) {
  VerticalFit fit;
  fit.up = up;
  for (int round = 0; round < kRounds && cell > 0.0; ++round) {
    const std::vector<Column> columns = fitColumns(positions, normals, fit.up, cell);
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
