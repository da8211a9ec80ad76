// SPDX-License-Identifier: BSD-3-Clause
// What AnisotropicPositionRefinement computes; how it behaves as a PCL filter is tested in
// test_position_refinement_contract.cpp.
#include <algorithm>
#include <cmath>
#include <limits>

#include "position_refinement_clouds.h"

namespace {

constexpr double kSigmaN = 20 * M_PI / 180;

template <typename PointT, typename Residual>
double rms(const pcl::PointCloud<PointT>& cloud, std::size_t begin, std::size_t end,
           Residual residual) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    sum += std::pow(static_cast<double>(residual(cloud[i])), 2);
  }
  return std::sqrt(sum / static_cast<double>(end - begin));
}

// (7) with the k nearest by brute force in the initial positions, one region.
template <typename PointT>
double energy(const pcl::PointCloud<PointT>& initial, const pcl::PointCloud<PointT>& moved,
              std::size_t k, double sigma_p, double beta) {
  const auto at = [](const pcl::PointCloud<PointT>& cloud, std::size_t i) -> Eigen::Vector3d {
    return cloud[i].getVector3fMap().template cast<double>();
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t j = 0; j < initial.size(); ++j) {
      order.emplace_back((at(initial, j) - at(initial, i)).norm(), j);
    }
    std::sort(order.begin(), order.end());
    const Eigen::Vector3d n_i = initial[i].getNormalVector3fMap().template cast<double>();
    for (std::size_t m = 1; m <= k; ++m) {
      const auto [distance, j] = order[m];
      const double cosine = n_i.dot(initial[j].getNormalVector3fMap().template cast<double>());
      const double phi = std::exp(-std::pow(distance / sigma_p, 2));
      const double psi = std::exp(-std::pow((1 - cosine) / (1 - std::cos(kSigmaN)), 2));
      sum += std::pow(n_i.dot(at(moved, i) - at(moved, j)), 2) * phi * psi;
    }
    sum += beta * (at(moved, i) - at(initial, i)).squaredNorm();
  }
  return sum;
}

TYPED_TEST_SUITE(PositionRefinementOf, OrientedPointTypes);

// One step with equal weights and no beta replaces a point's offset by the mean of its k
// neighbours': 1 / sqrt(k) of the noise. The mean over n points scatters by sqrt(k / n) of that.
TYPED_TEST(PositionRefinementOf, OneStepAveragesTheNeighbors) {
  const auto cloud = makeLine<TypeParam>(4000);
  for (const int k : {10, 40}) {
    typename TestFixture::Refinement refinement;
    refinement.setKSearch(k);
    refinement.setSigmaP(1e6);
    refinement.setBeta(0.0);
    refinement.setIterations(1);
    const auto output = this->refine(cloud, refinement);
    const double expected = 0.01 / std::sqrt(k);
    const auto residual = [](const TypeParam& p) { return p.y; };
    EXPECT_NEAR(rms(output, 200, 3800, residual) / expected, 1.0, 3 * std::sqrt(k / 3600.0));
  }
}

// The fixed point of (8) on an endless line of equal steps is a linear filter: an offset wave of
// frequency w is kept by beta / (beta + sum_j phi_j (1 - cos j w)).
TYPED_TEST(PositionRefinementOf, ConvergesToTheFilterOfTheory) {
  const int k = 20;
  const double sigma_p = 0.25;
  const double beta = 0.5;
  double mean_square = 0.0;
  constexpr int kFrequencies = 20000;
  for (int f = 0; f < kFrequencies; ++f) {
    const double w = M_PI * (f + 0.5) / kFrequencies;
    double stiffness = 0.0;
    for (int j = 1; j <= k / 2; ++j) {
      stiffness += 2 * std::exp(-std::pow(0.05 * j / sigma_p, 2)) * (1 - std::cos(j * w));
    }
    mean_square += std::pow(beta / (beta + stiffness), 2) / kFrequencies;
  }
  typename TestFixture::Refinement refinement;
  refinement.setKSearch(k);
  refinement.setSigmaP(sigma_p);
  refinement.setBeta(beta);
  refinement.setIterations(300);
  const auto output = this->refine(makeLine<TypeParam>(8000), refinement);
  const auto residual = [](const TypeParam& p) { return p.y; };
  // The filter reaches over some 50 points: 7800 / 50 independent ones, deviation 1 / sqrt(2 x
  // 156).
  EXPECT_NEAR(rms(output, 100, 7900, residual) / (0.01 * std::sqrt(mean_square)), 1.0, 0.17);
}

TYPED_TEST(PositionRefinementOf, NeverRaisesTheEnergy) {
  const auto cloud = makeCorner<TypeParam>();
  double previous = std::numeric_limits<double>::infinity();
  double first = 0.0;
  for (const int iterations : {0, 1, 2, 3, 4, 6, 10, 20, 50}) {
    typename TestFixture::Refinement refinement;
    refinement.setKSearch(12);
    refinement.setSigmaP(0.1);
    refinement.setIterations(iterations);
    const double now = energy(*cloud, this->refine(cloud, refinement), 12, 0.1, 0.1);
    EXPECT_LE(now, previous * (1 + 1e-6)) << iterations;  // positions are floats
    previous = now;
    first = iterations == 0 ? now : first;
  }
  EXPECT_LT(previous, 0.1 * first);
}

TYPED_TEST(PositionRefinementOf, KeepsACornerSharp) {
  const auto cloud = makeCorner<TypeParam>();
  typename TestFixture::Refinement refinement;
  refinement.setRegions(cornerRegions());
  const auto output = this->refine(cloud, refinement);
  const auto offX = [](const TypeParam& p) { return p.y; };
  const auto offY = [](const TypeParam& p) { return p.x; };
  EXPECT_LT(rms(output, 0, 500, offX), 0.25 * rms(*cloud, 0, 500, offX));
  EXPECT_LT(rms(output, 500, 1000, offY), 0.25 * rms(*cloud, 500, 1000, offY));
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(output[i].x, (*cloud)[i].x) << "only along the normal";
    if (output[i].x < 0.3f) {  // rounding would leave points off by a part of the distance
      EXPECT_LT(std::abs(output[i].y), 0.02f);
    }
  }
}

// Parallel walls 0.1 apart with the same normal: only the regions keep them apart.
TYPED_TEST(PositionRefinementOf, RegionsDoNotPullAtEachOther) {
  auto cloud = makeLine<TypeParam>(1000, 0.005);
  for (std::size_t i = 1; i < 1000; i += 2) {
    (*cloud)[i].y += 0.1f;
  }
  std::vector<pcl::PointIndices> regions(2);
  for (int i = 0; i < 990; ++i) {
    regions[static_cast<std::size_t>(i % 2)].indices.push_back(i);
  }
  typename TestFixture::Refinement refinement;
  refinement.setSigmaP(0.5);
  refinement.setRegions(regions);
  EXPECT_EQ(refinement.getRegions().size(), 2u);
  const auto apart = this->refine(cloud, refinement);
  for (std::size_t i = 0; i < 990; ++i) {
    EXPECT_NEAR(apart[i].y, i % 2 == 0 ? 0.0 : 0.1, 0.01);
  }
  for (std::size_t i = 990; i < 1000; ++i) {
    EXPECT_EQ(apart[i].y, (*cloud)[i].y) << "a point of no region";
  }
  refinement.setRegions({});
  this->expectSame(this->refine(cloud, refinement), *cloud);
  refinement.clearRegions();
  const auto mixed = this->refine(cloud, refinement);
  EXPECT_NEAR(mixed[500].y, 0.05, 0.02);
}

TYPED_TEST(PositionRefinementOf, RadiusAndNumberAgree) {
  const auto cloud = makeLine<TypeParam>(500, 0.001);
  typename TestFixture::Refinement by_number;
  by_number.setKSearch(8);  // four steps to either side
  typename TestFixture::Refinement by_radius;
  by_radius.setKSearch(0);
  by_radius.setRadiusSearch(0.22);
  EXPECT_EQ(by_radius.getRadiusSearch(), 0.22);
  by_number.setSigmaP(0.2);
  by_radius.setSigmaP(0.2);
  by_number.setIterations(5);
  by_radius.setIterations(5);
  const auto a = this->refine(cloud, by_number);
  const auto b = this->refine(cloud, by_radius);
  for (std::size_t i = 30; i < 470; ++i) {  // ends have fewer within the radius
    EXPECT_NEAR(a[i].y, b[i].y, 1e-8);
  }
}

// sigma_p = 5 deviations where these exceed 2 spacings. The median of 300 neighbourhoods of 40
// offsets is good to a few percent.
TYPED_TEST(PositionRefinementOf, DerivesSigmaPInAnyUnit) {
  for (const double unit : {0.001, 1.0, 1000.0}) {
    auto cloud = makeLine<TypeParam>(4000, 0.03);
    for (TypeParam& p : *cloud) {
      p.getVector3fMap() *= static_cast<float>(unit);
    }
    typename TestFixture::Refinement refinement;
    this->refine(cloud, refinement);
    EXPECT_NEAR(refinement.getSigmaP() / (5 * 0.03 * unit), 1.0, 0.1);
    refinement.setSigmaP(0.7);
    this->refine(cloud, refinement);
    EXPECT_EQ(refinement.getSigmaP(), 0.7);
  }
  typename TestFixture::Refinement refinement;
  this->refine(makeLine<TypeParam>(4000, 0.0), refinement);
  EXPECT_NEAR(refinement.getSigmaP(), 2 * 0.05, 1e-3);
}

}  // namespace
