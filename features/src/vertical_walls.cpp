// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/vertical_kernels.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kWallGate = 0.35;         // |n.up| of a wall with noise of 15 degrees
constexpr std::size_t kFewestPoints = 30;  // of a column
constexpr double kFlat = 4.0;              // variance along over variance across a wall, at least
constexpr double kRoughness = 4.0;         // variance across over that of good columns, at most
constexpr double kStraightness = 3e-4;     // rad, how well real walls stand
constexpr double kTukey = 4.685;           // 95 % efficiency under normal errors
constexpr double kNormalMad = 1.4826;      // standard deviation over median absolute deviation
constexpr double kSinSamePlane = 0.1;      // walls that differ by less than 6 degrees face one way
constexpr int kRounds = 8;
constexpr int kTukeyRounds = 20;
constexpr double kSettled = 1e-6;  // rad

// The plane of one column of wall: its horizontal normal, and its lean n.up with that value's
// standard deviation.
struct Column {
  Eigen::Vector2d normal;
  double lean = 0.0;
  double deviation = 0.0;
  double variance = 0.0;  // across the plane
};

struct Keyed {
  std::uint64_t key;
  std::uint32_t point;
};

double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The wall points, sorted by the column they stand in.
std::vector<Keyed> columnsOfPoints(const Vectors3d& positions, const Vectors3d& normals,
                                   const Eigen::Vector3d& up,
                                   const Eigen::Matrix<double, 3, 2>& frame, double cell) {
  std::vector<Keyed> keyed;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::abs(normals[i].dot(up)) < kWallGate) {
      const Eigen::Vector2d c = (frame.transpose() * positions[i] / cell).array().floor();
      if (c.cwiseAbs().maxCoeff() < 1e9) {
        const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(c.x()) + (1LL << 31));
        const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(c.y()) + (1LL << 31));
        keyed.push_back({x << 32 | y, static_cast<std::uint32_t>(i)});
      }
    }
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.point < b.point;
  });
  return keyed;
}

// Total least squares plane of the points [begin, end); false if they are no upright plane.
bool fitColumn(const Vectors3d& positions, const Eigen::Matrix3d& to_local, const Keyed* begin,
               const Keyed* end, Column& column) {
  const auto n = static_cast<double>(end - begin);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Keyed* k = begin; k != end; ++k) {
    mean += positions[k->point];
  }
  mean /= n;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Keyed* k = begin; k != end; ++k) {
    const Eigen::Vector3d d = to_local * (positions[k->point] - mean);
    covariance += d * d.transpose();
  }
  covariance /= n;
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
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame(up);
  Eigen::Matrix3d to_local;
  to_local << frame.transpose(), up.transpose();
  const std::vector<Keyed> keyed = columnsOfPoints(positions, normals, up, frame, cell);
  std::vector<Column> columns;
  for (std::size_t begin = 0; begin < keyed.size();) {
    std::size_t end = begin;
    while (end < keyed.size() && keyed[end].key == keyed[begin].key) {
      ++end;
    }
    Column column;
    if (end - begin >= kFewestPoints &&
        fitColumn(positions, to_local, &keyed[begin], &keyed[begin] + (end - begin), column)) {
      columns.push_back(column);
    }
    begin = end;
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
    if (turn.norm() < kSettled) {
      break;
    }
  }
  return fit;
}

}  // namespace storey::detail
