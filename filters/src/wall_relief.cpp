// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/wall_relief.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr std::size_t kPlaces = 400;
constexpr std::size_t kMinPoints = 50;
constexpr std::size_t kMaxPoints = 2000;  // of one neighbourhood
constexpr double kGate = 8.0;             // noise deviations: more is another wall
constexpr double kNormalDot = 0.7;        // cosine of 45 degrees
constexpr int kRounds = 4;
constexpr double kReliefRadius = 0.05;  // of the extent: about a wall
constexpr double kReliefRatio = 1.4;    // of the noise
constexpr double kLeastNoise = 1e-5;    // of the extent, for clouds without any
constexpr double kMadToDeviation = 1.4826;

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Scatter about a line in plan that starts through the origin with the given normal.
double scatterAbout(const std::vector<Eigen::Vector2d>& points, Eigen::Vector2d normal,
                    double gate) {
  double offset = 0.0;
  std::vector<double> deviations;
  for (int round = 0; round < kRounds; ++round) {
    double w = 0, s = 0, d = 0, ss = 0, sd = 0;
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    for (const Eigen::Vector2d& p : points) {
      const double across = normal.dot(p) - offset;
      const double u = across / gate;
      if (std::abs(u) >= 1.0) continue;
      const double weight = (1.0 - u * u) * (1.0 - u * u);
      const double along = tangent.dot(p);
      w += weight;
      s += weight * along;
      d += weight * across;
      ss += weight * along * along;
      sd += weight * along * across;
    }
    if (!(w > 0.0)) return -1.0;
    const double spread = ss - s * s / w;
    const double slope = spread > 0.0 ? (sd - s * d / w) / spread : 0.0;
    const Eigen::Vector2d center = (s / w) * tangent + (offset + d / w) * normal;
    normal = (normal - slope * tangent).normalized();
    offset = normal.dot(center);
  }
  for (const Eigen::Vector2d& p : points) {
    const double across = std::abs(normal.dot(p) - offset);
    if (across < gate) deviations.push_back(across);
  }
  return deviations.size() < kMinPoints ? -1.0 : kMadToDeviation * medianOf(deviations);
}

}  // namespace

double estimateWallRelief(const std::vector<Eigen::Vector3f>& positions,
                          const std::vector<Eigen::Vector3f>& normals, double radius,
                          double noise) {
  std::vector<double> reliefs;
  const std::size_t n = positions.size();
  const std::size_t places = std::min(kPlaces, n);
  for (std::size_t k = 0; k < places; ++k) {
    const std::size_t i = k * n / places;
    const Eigen::Vector2f normal = normals[i].head<2>().normalized();
    std::vector<Eigen::Vector2d> around;
    const std::size_t step = std::max<std::size_t>(1, n / 200000);
    for (std::size_t j = 0; j < n && around.size() < kMaxPoints; j += step) {
      const Eigen::Vector3f r = positions[j] - positions[i];
      if (std::abs(r.x()) > radius || std::abs(r.y()) > radius || r.squaredNorm() > radius * radius)
        continue;
      if (normals[j].head<2>().dot(normal) < kNormalDot) continue;
      around.push_back(r.head<2>().cast<double>());
    }
    if (around.size() < kMinPoints) continue;
    const double scatter = scatterAbout(around, normal.cast<double>(), kGate * noise);
    if (scatter >= 0.0) reliefs.push_back(scatter);
  }
  return reliefs.empty() ? noise : medianOf(reliefs);
}

double estimateWallNoise(const std::vector<Eigen::Vector3f>& positions,
                         const std::vector<Eigen::Vector3f>& normals, double noise, double extent) {
  const double least = std::max(noise, kLeastNoise * extent);
  const double relief = estimateWallRelief(positions, normals, kReliefRadius * extent, least);
  return relief > kReliefRatio * least ? relief : least;
}

}  // namespace storey::detail
