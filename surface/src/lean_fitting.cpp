// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/wall_assignment.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace storey {
namespace {

constexpr double kTukey = 6.0;           // noise deviations
constexpr double kWallLean = 3e-4;       // rad; walls themselves are no more upright than this
constexpr double kHuber = 2.0;           // deviations
constexpr int kRounds = 10;              // of reweighting
constexpr double kClear = 4.0;           // deviations; one cloud in 3000 leans as far by chance
constexpr std::size_t kMinSupport = 20;  // points of a wall
constexpr double kMinPivot = 1e-9;       // of the largest: below, there is no solution

// Weighted moments of the points of a wall, across it against (1, along it, height).
struct Moments {
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  double squares = 0.0;
  std::size_t support = 0;

  Moments& operator+=(const Moments& other) {
    rows += other.rows;
    products += other.products;
    squares += other.squares;
    support += other.support;
    return *this;
  }
};

struct Line {
  Eigen::Vector2d reference;
  Eigen::Vector2d normal;

  void addTo(Moments& sum, const Eigen::Vector3d& point, double scale) const {
    const Eigen::Vector2d r = point.head<2>() - reference;
    const double across = r.dot(normal);
    const double u = across / scale;
    if (std::abs(u) >= 1.0) return;
    const double weight = (1.0 - u * u) * (1.0 - u * u);
    const Eigen::Vector3d row(1.0, normal.x() * r.y() - normal.y() * r.x(), point.z());
    sum.rows += weight * row * row.transpose();
    sum.products += weight * across * row;
    sum.squares += weight * across * across;
    ++sum.support;
  }
};

struct LeaningWall {
  Line line;
  Moments moments;
};

// c of a wall: how far it moves outwards with each unit of height.
struct Lean {
  Eigen::Vector2d normal;
  double slope = 0.0;
  double variance = 0.0;
};

std::vector<LeaningWall> collect(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                 const Eigen::Vector3d& middle, double noise,
                                 unsigned int threads) {
  std::map<int, Line> lines;
  for (const FloorplanLayer& layer : layers) {
    for (const detail::WallStretch& stretch : detail::stretchesOf(layer.plan)) {
      if (stretch.wall < 0) continue;
      lines.emplace(stretch.wall, Line{stretch.start - middle.head<2>(), stretch.normal()});
    }
  }
  std::vector<LeaningWall> walls;
  for (const auto& [id, line] : lines) walls.push_back({line, {}});
  const std::vector<int> wall_of = detail::WallAssignment(layers, noise).wallsOf(points, threads);
  const std::vector<Moments> sums = detail::sumByChunks(
      wall_of.size(), threads, std::vector<Moments>(walls.size()),
      [&](std::size_t begin, std::size_t end, std::vector<Moments>& part) {
        for (std::size_t i = begin; i < end; ++i) {
          if (wall_of[i] < 0) continue;
          const auto k = static_cast<std::size_t>(wall_of[i]);
          walls[k].line.addTo(part[k], points.positions[i].cast<double>() - middle, kTukey * noise);
        }
      });
  for (std::size_t k = 0; k < walls.size(); ++k) walls[k].moments = sums[k];
  return walls;
}

std::vector<Lean> leansOf(const std::vector<LeaningWall>& walls) {
  std::vector<Lean> leans;
  for (const auto& [line, moments] : walls) {
    if (moments.support < kMinSupport) continue;
    Eigen::FullPivLU<Eigen::Matrix3d> lu(moments.rows);
    lu.setThreshold(kMinPivot);
    if (!lu.isInvertible()) continue;
    const Eigen::Matrix3d inverse = lu.inverse();
    const Eigen::Vector3d fit = inverse * moments.products;
    const double residual =
        std::max(0.0, moments.squares - fit.dot(moments.products)) / moments.rows(0, 0);
    leans.push_back({line.normal, fit[2], residual * inverse(2, 2) + kWallLean * kWallLean});
  }
  return leans;
}

// The lean (x and y of the vertical where its z is 1), or zero if it is not clear.
Eigen::Vector2d commonLean(const std::vector<Lean>& leans) {
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  double scatter = 0.0;  // of the walls about the common lean, against their own deviations
  for (int round = 0; round < kRounds; ++round) {
    information.setZero();
    scatter = 0.0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Lean& wall : leans) {
      const double off = std::abs(wall.slope - wall.normal.dot(lean)) / std::sqrt(wall.variance);
      const double weight = std::min(1.0, kHuber / off) / wall.variance;
      information += weight * wall.normal * wall.normal.transpose();
      sum += weight * wall.slope * wall.normal;
      scatter += std::min(1.0, kHuber / off) * off * off;
    }
    Eigen::FullPivLU<Eigen::Matrix2d> lu(information);
    lu.setThreshold(kMinPivot);
    if (!lu.isInvertible()) return Eigen::Vector2d::Zero();  // all walls are parallel
    lean = lu.solve(sum);
  }
  // Where walls differ by more than their points' noise explains, they bulge and lean by
  // themselves.
  const double freedom = std::max(1.0, static_cast<double>(leans.size()) - 2.0);
  const double clear = kClear * kClear * std::max(1.0, scatter / freedom);
  return lean.dot(information * lean) > clear ? lean : Eigen::Vector2d::Zero();
}

}  // namespace

Eigen::Isometry3d fitUpright(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                             double noise, unsigned int threads) {
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  if (!(noise > 0.0) || std::isinf(noise) || points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::fitUpright] noise is %g, and there are %zu normals for %zu points.\n",
              noise, points.normals.size(), points.positions.size());
    return upright;
  }
  if (points.positions.empty()) return upright;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points.positions) middle += p.cast<double>();
  middle /= static_cast<double>(points.positions.size());
  const Eigen::Vector2d lean = commonLean(leansOf(collect(layers, points, middle, noise, threads)));
  if (lean.isZero()) return upright;
  upright.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(lean.x(), lean.y(), 1.0),
                                                        Eigen::Vector3d::UnitZ())
                         .toRotationMatrix();
  upright.translation() = middle - upright.linear() * middle;
  return upright;
}

}  // namespace storey
