// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/points_by_wall.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace storey {
namespace {

using detail::PointsByWall;
using detail::WallPlace;

constexpr double kTukey = 6.0;           // noise deviations
constexpr double kWallLean = 3e-4;       // rad; walls themselves are no more upright than this
constexpr double kHuber = 2.0;           // deviations
constexpr int kRounds = 10;              // of reweighting
constexpr double kClear = 4.0;           // deviations; one cloud in 3000 leans as far by chance
constexpr std::size_t kMinSupport = 20;  // points of a wall
constexpr double kMinPivot = 1e-9;       // of the largest: below, there is no solution

// Weighted moments of the points of a wall, across it against (1, along it, height).
struct Moments {
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();  // lower half
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

void addTo(Moments& sum, const WallPlace& place, double scale) {
  const double across = place.across;
  const double u = across / scale;
  if (std::abs(u) >= 1.0) return;
  const double weight = (1.0 - u * u) * (1.0 - u * u);
  const double along = place.along;
  const double height = place.height;
  sum.rows(0, 0) += weight;
  sum.rows(1, 0) += weight * along;
  sum.rows(2, 0) += weight * height;
  sum.rows(1, 1) += weight * along * along;
  sum.rows(2, 1) += weight * along * height;
  sum.rows(2, 2) += weight * height * height;
  sum.products += weight * across * Eigen::Vector3d(1.0, along, height);
  sum.squares += weight * across * across;
  ++sum.support;
}

// c of a wall: how far it moves outwards with each unit of height.
struct Lean {
  Eigen::Vector2d normal;
  double slope = 0.0;
  double variance = 0.0;
};

std::vector<Lean> leansOf(const PointsByWall& by_wall, double noise, unsigned int threads) {
  const std::vector<Moments> sums = by_wall.sum<Moments>(
      threads, [noise](std::size_t, const WallPlace* begin, const WallPlace* end, Moments& sum) {
        for (const WallPlace* p = begin; p != end; ++p) addTo(sum, *p, kTukey * noise);
      });
  std::vector<Lean> leans;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const Moments& moments = sums[k];
    if (moments.support < kMinSupport) continue;
    const Eigen::Matrix3d rows = moments.rows.selfadjointView<Eigen::Lower>();
    Eigen::FullPivLU<Eigen::Matrix3d> lu(rows);
    lu.setThreshold(kMinPivot);
    if (!lu.isInvertible()) continue;
    const Eigen::Matrix3d inverse = lu.inverse();
    const Eigen::Vector3d fit = inverse * moments.products;
    const double residual =
        std::max(0.0, moments.squares - fit.dot(moments.products)) / moments.rows(0, 0);
    leans.push_back(
        {by_wall.frames()[k].normal, fit[2], residual * inverse(2, 2) + kWallLean * kWallLean});
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

// Of the box around the layers.
Eigen::Vector3d middleOf(const std::vector<FloorplanLayer>& layers) {
  Eigen::AlignedBox3d box;
  for (const FloorplanLayer& layer : layers) {
    for (const FloorplanComponent& component : layer.plan.components) {
      for (const Eigen::Vector2d& corner : component.outer.vertices) {
        box.extend(Eigen::Vector3d(corner.x(), corner.y(), layer.z_min));
        box.extend(Eigen::Vector3d(corner.x(), corner.y(), layer.z_max));
      }
    }
  }
  return box.center();
}

}  // namespace

Eigen::Isometry3d detail::fitUpright(const std::vector<FloorplanLayer>& layers,
                                     const FitPoints& points, double noise, unsigned int threads,
                                     PointsByWall& by_wall) {
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  if (!(noise > 0.0) || std::isinf(noise) || points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::fitUpright] noise is %g, and there are %zu normals for %zu points.\n",
              noise, points.normals.size(), points.positions.size());
    return upright;
  }
  if (points.positions.empty() || layers.empty()) return upright;
  by_wall.gather(layers, points, noise, threads);
  const Eigen::Vector2d lean = commonLean(leansOf(by_wall, noise, threads));
  if (lean.isZero()) return upright;
  upright.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(lean.x(), lean.y(), 1.0),
                                                        Eigen::Vector3d::UnitZ())
                         .toRotationMatrix();
  const Eigen::Vector3d middle = middleOf(layers);
  upright.translation() = middle - upright.linear() * middle;
  return upright;
}

Eigen::Isometry3d fitUpright(const std::vector<FloorplanLayer>& layers, const FitPoints& points,
                             double noise, unsigned int threads) {
  detail::PointsByWall by_wall;
  return detail::fitUpright(layers, points, noise, threads, by_wall);
}

}  // namespace storey
