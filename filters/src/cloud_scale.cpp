// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/neighbor_search.h>
#include <storey/filters/detail/threads.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>

namespace storey::detail {
namespace {

constexpr std::size_t kSamples = 1500;           // neighbourhoods
constexpr std::size_t kMinNeighbors = 20;        // points
constexpr std::size_t kMaxNeighbors = 200;       // points
constexpr std::size_t kPointsPerNeighbor = 100;  // k = n / 100 on small clouds
constexpr std::size_t kMinPositions = 5;         // a plane has 3 parameters; 2 more tell its noise
constexpr double kNoiseShare = 0.25;             // of the neighbourhoods lie on one plane, at least
constexpr double kNoiseQuantile = -0.6745;       // of the normal distribution, at kNoiseShare
constexpr double kAcceptedDeviations = 2.5;      // of chi-square, above the start
constexpr double kMadToDeviation = 1.4826;
constexpr double kCore = 2.5;              // deviations
constexpr double kCoreVariance = 0.91123;  // of a normal distribution cut there: 1 - 2 c phi / P
constexpr int kCoreRounds = 3;
constexpr double kFlatShare = 0.4;
constexpr double kFlatRadius = 8.0;  // noise deviations: less than this is no plane
constexpr std::size_t kThinning = 4;
constexpr std::size_t kMinThinned = kMaxNeighbors * kPointsPerNeighbor;  // below, k shrinks too
constexpr double kBoxQuantile = 0.01;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

struct Sample {
  double variance = 0.0;  // about its plane, free of bias
  double flatness = 0.0;  // l3 / (l1 + l2 + l3)
  double radius = 0.0;    // to the k-th neighbour
  double points = 0.0;    // duplicates counted
};

// Value at a share of the sorted order; reorders.
template <typename Number>
double quantile(std::vector<Number>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(rank)]);
}

// One number at random from each of `count` equal strata of [0, n): no repetitions, evenly spread.
std::vector<std::size_t> drawStratified(std::size_t n, std::size_t count, std::mt19937& random) {
  std::vector<std::size_t> drawn(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * n / count;
    const std::size_t end = (i + 1) * n / count;
    drawn[i] = begin + random() % (end - begin);
  }
  return drawn;
}

// Variance of a normal distribution from absolute deviations, some of which are of others: tails,
// clutter, the panes of windows. What lies beyond kCore deviations does not count.
double varianceOfCore(std::vector<double>& deviations) {
  double deviation = kMadToDeviation * quantile(deviations, 0.5);
  for (int round = 0; round < kCoreRounds && deviation > 0.0; ++round) {
    double sum = 0.0;
    double count = 0.0;
    for (const double d : deviations) {
      if (d > kCore * deviation) continue;
      sum += d * d;
      count += 1.0;
    }
    deviation = std::sqrt(sum / count / kCoreVariance);
  }
  return deviation * deviation;
}

Sample describe(const Neighborhood& found, const std::vector<std::uint32_t>& multiplicity) {
  const auto k = static_cast<double>(found.count);
  const auto at = [&found](std::size_t i) -> Eigen::Vector3d {
    return Eigen::Vector3f(found.x[i], found.y[i], found.z[i]).cast<double>();
  };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < found.count; ++i) {
    const Eigen::Vector3d d = at(i) - at(0);
    mean += d;
    covariance += d * d.transpose();
  }
  mean /= k;
  covariance = covariance / k - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d l = solver.eigenvalues().cwiseMax(0.0);
  const double radius = std::sqrt(static_cast<double>(found.squaredRadius()));
  Sample result;
  result.radius = radius;
  result.flatness = l.sum() > 0.0 ? l(0) / l.sum() : 0.0;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  std::vector<double> residuals;
  for (std::size_t i = 0; i < found.count; ++i) {
    residuals.push_back(std::abs(normal.dot(at(i) - at(0) - mean)));
    result.points += multiplicity[static_cast<std::size_t>(found.ids[i])];
  }
  const double variance = varianceOfCore(residuals) * k / (k - 3.0);
  result.variance = variance * (1.0 + 2.0 * variance / (radius * radius));
  return result;
}

struct Sampling {
  std::vector<Sample> neighborhoods;
  std::size_t k = 0;
};

// What `judge` says of the k nearest of some positions, parallel to them.
template <typename Judge>
auto judgeNearest(const NeighborSearch& search, const std::vector<std::size_t>& ids, std::size_t k,
                  unsigned int threads, const Judge& judge) {
  std::vector<decltype(judge(Neighborhood()))> found(ids.size());
  const auto count = static_cast<std::ptrdiff_t>(ids.size());
#pragma omp parallel num_threads(threadsFor(threads))
  {
    NeighborSearch::Workspace workspace;
#pragma omp for schedule(dynamic, 32)
    for (std::ptrdiff_t j = 0; j < count; ++j) {
      const auto i = static_cast<std::size_t>(j);
      found[i] = judge(search.nearest(static_cast<pcl::index_t>(ids[i]), k, workspace));
    }
  }
  return found;
}

Sampling sampleNeighborhoods(const NeighborSearch& search, const DistinctPositions& positions,
                             std::mt19937& random, unsigned int threads) {
  const std::size_t n = positions.cloud->size();
  Sampling result;
  result.k = std::min(n, std::clamp(n / kPointsPerNeighbor, kMinNeighbors, kMaxNeighbors));
  result.neighborhoods = judgeNearest(
      search, drawStratified(n, std::min(n, kSamples), random), result.k, threads,
      [&](const Neighborhood& found) { return describe(found, positions.multiplicity); });
  return result;
}

struct CommonVariance {
  double mean = 0.0;
  double deviation = 0.0;  // of the mean
  double share = 0.0;      // of the neighbourhoods have it
};

// The variance that the flat neighbourhoods share. Each of their estimates scatters about it like
// chi-square with k - 3 degrees of freedom: relative deviation sqrt(2 / (k - 3)).
CommonVariance commonVariance(const Sampling& sampling, std::size_t num_positions) {
  std::vector<double> variances;
  for (const Sample& s : sampling.neighborhoods) {
    variances.push_back(s.variance);
  }
  const auto k = static_cast<double>(sampling.k);
  const double scatter = std::sqrt(2.0 / (k - 3.0));
  // Wilson and Hilferty: the cube root of chi-square is nearly normal.
  const double ninth = scatter * scatter / 9.0;
  const double root = 1.0 - ninth + kNoiseQuantile * std::sqrt(ninth);
  const double start = quantile(variances, kNoiseShare) / (root * root * root);
  const double limit = start * (1.0 + kAcceptedDeviations * scatter);
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const double v : variances) {
    if (v <= limit) {
      sum += v;
      squares += v * v;
      ++count;
    }
  }
  CommonVariance common;
  common.mean = sum / count;  // at least a quarter of the samples is below the start
  common.share = count / static_cast<double>(variances.size());
  // Neighbourhoods of a small cloud share their points.
  const double apart = std::min(count, common.share * static_cast<double>(num_positions) / k);
  const double spread = std::max(squares / count - common.mean * common.mean, 0.0);
  common.deviation = std::sqrt(spread / std::max(apart, 1.0));
  return common;
}

double medianRadius(const std::vector<Sample>& samples) {
  std::vector<double> radii;
  for (const Sample& s : samples) {
    radii.push_back(s.radius);
  }
  return quantile(radii, 0.5);
}

double surfaceDensity(std::vector<Sample> samples, double variance) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.flatness < b.flatness; });
  const auto flat =
      static_cast<std::size_t>(std::ceil(kFlatShare * static_cast<double>(samples.size())));
  std::vector<double> densities;
  for (std::size_t i = 0; i < flat; ++i) {
    const Sample& s = samples[i];
    // Of a ball about a noisy point, the plane meets a disc whose mean squared radius is
    // r^2 - 2 variance. The median of m / gamma(m) is m / (m - 1/3), and the query is no witness.
    const double disc = s.radius * s.radius - 2.0 * variance;
    if (disc > 0.0) {
      densities.push_back((s.points - 4.0 / 3.0) / (M_PI * disc));
    }
  }
  return densities.empty() ? 0.0 : quantile(densities, 0.5);
}

double medianSpacing(const NeighborSearch& search, std::mt19937& random, unsigned int threads) {
  const std::size_t n = search.size();
  std::vector<double> spacings = judgeNearest(
      search, drawStratified(n, std::min(n, kSamples), random), 2, threads,
      [](const Neighborhood& two) { return std::sqrt(static_cast<double>(two.squaredRadius())); });
  return quantile(spacings, 0.5);
}

double robustExtent(const Cloud& cloud, unsigned int threads) {
  double ends[6];  // lower and upper one of each axis
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t end = 0; end < 6; ++end) {
    std::vector<float> values(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) values[i] = cloud[i].data[end / 2];
    ends[end] = quantile(values, end % 2 == 0 ? kBoxQuantile : 1.0 - kBoxQuantile);
  }
  double squared = 0.0;
  for (int end = 0; end < 6; end += 2) squared += std::pow(ends[end + 1] - ends[end], 2);
  return std::sqrt(squared);
}

// One position of every kThinning that follow each other, at random.
void thin(DistinctPositions& positions, std::mt19937& random) {
  const Cloud& all = *positions.cloud;
  auto cloud = pcl::make_shared<Cloud>();
  std::vector<std::uint32_t> multiplicity;
  for (const std::size_t i : drawStratified(all.size(), all.size() / kThinning, random)) {
    cloud->push_back(all[i]);
    multiplicity.push_back(positions.multiplicity[i]);
  }
  positions.cloud = cloud;
  positions.multiplicity = multiplicity;
}

}  // namespace

CloudScale estimateCloudScale(const std::vector<Eigen::Vector3f>& input, std::uint32_t seed,
                              unsigned int threads) {
  CloudScale scale;
  DistinctPositions positions = findDistinctPositions(input, threads);
  positions.id_of_input = {};  // its memory is wanted
  if (positions.cloud->size() < 2) {
    return scale;
  }
  std::mt19937 random(seed);
  auto search = std::make_unique<NeighborSearch>(positions.cloud);
  scale.extent = robustExtent(*positions.cloud, threads);
  scale.spacing = medianSpacing(*search, random, threads);
  if (positions.cloud->size() < kMinPositions) {
    return scale;
  }
  const auto num_positions = static_cast<double>(positions.cloud->size());
  while (true) {
    const Sampling sampling = sampleNeighborhoods(*search, positions, random, threads);
    const CommonVariance variance = commonVariance(sampling, positions.cloud->size());
    const double kept_share = static_cast<double>(positions.cloud->size()) / num_positions;
    scale.noise = std::sqrt(variance.mean);
    scale.noise_deviation = scale.noise > 0.0 ? 0.5 * variance.deviation / scale.noise : 0.0;
    scale.noise_share = variance.share;
    scale.density = surfaceDensity(sampling.neighborhoods, variance.mean) / kept_share;
    if (medianRadius(sampling.neighborhoods) >= kFlatRadius * scale.noise ||
        positions.cloud->size() < kMinThinned * kThinning) {
      return scale;
    }
    thin(positions, random);
    search = std::make_unique<NeighborSearch>(positions.cloud);
  }
}

}  // namespace storey::detail
