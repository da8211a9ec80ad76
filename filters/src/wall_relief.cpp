// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/filters/detail/wall_relief.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace storey::detail {
namespace {

constexpr std::size_t kPlaces = 400;
constexpr std::size_t kMinPoints = 50;
constexpr std::size_t kMaxPoints = 2000;       // of one neighbourhood
constexpr std::size_t kMostSearched = 200000;  // points, of all places together
constexpr int kCellsAcross = 64;
constexpr double kGate = 8.0;       // noise deviations: more is another wall
constexpr double kNormalDot = 0.7;  // cosine of 45 degrees
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

// Every step-th position, sorted by cells of some side, at least the radius of a search.
class SampleCells {
 public:
  SampleCells(const std::vector<Eigen::Vector3f>& positions, std::size_t step, double side);

  /// The samples of the 27 cells around a position, by cell.
  void around(const Eigen::Vector3f& position, std::vector<std::uint32_t>& samples) const;

 private:
  Eigen::Array3i cellOf(const Eigen::Vector3f& position) const;
  static std::size_t indexOf(const Eigen::Array3i& cell) {
    return static_cast<std::size_t>((cell.z() * kCellsAcross + cell.y()) * kCellsAcross + cell.x());
  }

  Eigen::Array3d low_ = Eigen::Array3d::Zero();
  double side_ = 1.0;
  std::vector<std::uint32_t> begins_;  ///< of each cell in `samples_`
  std::vector<std::uint32_t> samples_;
};

SampleCells::SampleCells(const std::vector<Eigen::Vector3f>& positions, std::size_t step,
                         double side)
    : side_(side) {
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < positions.size(); i += step) {
    mean += positions[i].cast<double>().array();
    count += 1.0;
  }
  low_ = mean / std::max(count, 1.0) - 0.5 * kCellsAcross * side;
  begins_.assign(static_cast<std::size_t>(kCellsAcross * kCellsAcross * kCellsAcross) + 1, 0);
  for (std::size_t i = 0; i < positions.size(); i += step) {
    ++begins_[indexOf(cellOf(positions[i])) + 1];
  }
  for (std::size_t c = 1; c < begins_.size(); ++c) {
    begins_[c] += begins_[c - 1];
  }
  samples_.resize(begins_.back());
  std::vector<std::uint32_t> ends(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < positions.size(); i += step) {
    samples_[ends[indexOf(cellOf(positions[i]))]++] = static_cast<std::uint32_t>(i);
  }
}

// What lies outside belongs to the outermost cells, so that neighbours stay neighbours.
Eigen::Array3i SampleCells::cellOf(const Eigen::Vector3f& position) const {
  return ((position.cast<double>().array() - low_) / side_)
      .max(0.0)
      .min(kCellsAcross - 1.0)
      .cast<int>();
}

void SampleCells::around(const Eigen::Vector3f& position,
                         std::vector<std::uint32_t>& samples) const {
  samples.clear();
  const Eigen::Array3i first = (cellOf(position) - 1).max(0);
  const Eigen::Array3i last = (cellOf(position) + 1).min(kCellsAcross - 1);
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      const std::uint32_t begin = begins_[indexOf({first.x(), y, z})];
      const std::uint32_t end = begins_[indexOf({last.x(), y, z}) + 1];
      samples.insert(samples.end(), samples_.begin() + begin, samples_.begin() + end);
    }
  }
}

// Scatter about its wall of the points around the i-th; -1 if they are too few. \param near those
// that may be, left changed
double scatterAround(const std::vector<Eigen::Vector3f>& positions,
                     const std::vector<Eigen::Vector3f>& normals, std::size_t i, double radius,
                     double noise, std::vector<std::uint32_t>& near) {
  const Eigen::Vector2f normal = normals[i].head<2>().normalized();
  near.erase(std::remove_if(near.begin(), near.end(),
                            [&](std::uint32_t j) {
                              const Eigen::Vector3f r = positions[j] - positions[i];
                              return r.squaredNorm() > radius * radius ||
                                     normals[j].head<2>().dot(normal) < kNormalDot;
                            }),
             near.end());
  if (near.size() < kMinPoints) return -1.0;
  std::sort(near.begin(), near.end());
  const std::size_t taken = std::min(near.size(), kMaxPoints);  // from all over the place
  std::vector<Eigen::Vector2d> points;
  for (std::size_t t = 0; t < taken; ++t) {
    const std::uint32_t j = near[t * near.size() / taken];
    points.push_back((positions[j] - positions[i]).head<2>().cast<double>());
  }
  return scatterAbout(points, normal.cast<double>(), kGate * noise);
}

}  // namespace

double estimateWallRelief(const std::vector<Eigen::Vector3f>& positions,
                          const std::vector<Eigen::Vector3f>& normals, double radius, double noise,
                          unsigned int threads) {
  const std::size_t n = positions.size();
  const std::size_t places = std::min(kPlaces, n);
  const SampleCells cells(positions, std::max<std::size_t>(1, n / kMostSearched), radius);
  std::vector<double> scatters(places);
#pragma omp parallel num_threads(threadsFor(threads)) if (places > 1)
  {
    std::vector<std::uint32_t> near;
#pragma omp for schedule(dynamic, 4)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(places); ++k) {
      const std::size_t i = static_cast<std::size_t>(k) * n / places;
      cells.around(positions[i], near);
      scatters[static_cast<std::size_t>(k)] =
          scatterAround(positions, normals, i, radius, noise, near);
    }
  }
  scatters.erase(std::remove_if(scatters.begin(), scatters.end(), [](double s) { return s < 0.0; }),
                 scatters.end());
  return scatters.empty() ? noise : medianOf(scatters);
}

double estimateWallNoise(const std::vector<Eigen::Vector3f>& positions,
                         const std::vector<Eigen::Vector3f>& normals, double noise, double extent,
                         unsigned int threads) {
  const double least = std::max(noise, kLeastNoise * extent);
  const double relief =
      estimateWallRelief(positions, normals, kReliefRadius * extent, least, threads);
  return relief > kReliefRatio * least ? relief : least;
}

}  // namespace storey::detail
