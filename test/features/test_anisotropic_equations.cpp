// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/features/anisotropic_normal_estimation.h>

#include <algorithm>
#include <utility>

#include "synthetic_clouds.h"

namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;
using Estimation = storey::AnisotropicNormalEstimation<PointT>;

// Equation (1) as it is written, in double precision, neighbours by brute force. psi may be taken
// at other normals than the ones judged.
double energyOf(const Cloud& solved, const Cloud& psi_at, const Cloud& prior, int k, double sigma_p,
                double sigma_n, double alpha) {
  double energy = 0.0;
  std::vector<std::pair<double, std::size_t>> order(prior.size());
  for (std::size_t i = 0; i < prior.size(); ++i) {
    const Eigen::Vector3d n = solved[i].getNormalVector3fMap().cast<double>();
    const Eigen::Vector3d n0 = prior[i].getNormalVector3fMap().cast<double>().normalized();
    for (std::size_t j = 0; j < prior.size(); ++j) {
      order[j] = {(prior[i].getVector3fMap() - prior[j].getVector3fMap()).squaredNorm(), j};
    }
    order[i].first = -1.0;  // itself first
    std::partial_sort(order.begin(), order.begin() + k, order.end());
    for (int m = 1; m < k; ++m) {
      const auto [squared, j] = order[static_cast<std::size_t>(m)];
      const Eigen::Vector3d nj = solved[j].getNormalVector3fMap().cast<double>();
      const double cosine = static_cast<double>(
          psi_at[i].getNormalVector3fMap().dot(psi_at[j].getNormalVector3fMap()));
      const double t = (1.0 - cosine) / (1.0 - std::cos(sigma_n));
      energy +=
          (n - nj).squaredNorm() * std::exp(-squared / (sigma_p * sigma_p)) * std::exp(-t * t);
    }
    energy += alpha * (n - n0).squaredNorm();
  }
  return energy;
}

TEST(AnisotropicEquations, OneUpdateIsEquationThree) {
  const auto cloud = pcl::make_shared<Cloud>();
  const auto add = [&cloud](float x, double angle, float length) {
    PointT p;
    p.x = x;
    p.normal_x = length * static_cast<float>(std::cos(angle));
    p.normal_y = length * static_cast<float>(std::sin(angle));
    cloud->push_back(p);
  };
  const double angles[3] = {0.0, 0.2, -0.1};
  add(0.0f, angles[0], 1.0f);
  add(0.3f, angles[1], 2.0f);  // priors need not be unit
  add(-0.5f, angles[2], 1.0f);
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud);
  estimation.setKSearch(3);
  estimation.setIterations(1);
  estimation.setSigmaP(0.4);
  estimation.setSigmaN(0.3);
  estimation.setAlpha(0.2);
  Cloud out;
  estimation.compute(out);
  const float at[3] = {0.0f, 0.3f, -0.5f};
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::Vector2d sum = 0.2 * Eigen::Vector2d(std::cos(angles[i]), std::sin(angles[i]));
    for (std::size_t j = 0; j < 3; ++j) {
      const double d = static_cast<double>(at[i] - at[j]) / 0.4;
      const double t = (1.0 - std::cos(angles[i] - angles[j])) / (1.0 - std::cos(0.3));
      const double weight = i == j ? 0.0 : std::exp(-d * d) * std::exp(-t * t);
      sum += weight * Eigen::Vector2d(std::cos(angles[j]), std::sin(angles[j]));
    }
    sum.normalize();
    EXPECT_NEAR(static_cast<double>(out[i].normal_x), sum.x(), 1e-6);
    EXPECT_NEAR(static_cast<double>(out[i].normal_y), sum.y(), 1e-6);
  }
}

TEST(AnisotropicEquations, NoUpdateIncreasesTheEnergyThatItTreatsAsQuadratic) {
  const auto cloud = flattenedSlice<PointT>(1500, {0.1, 15.0 * kDegree, 7});
  const auto energy = [&cloud](const Cloud& solved, const Cloud& psi_at) {
    return energyOf(solved, psi_at, *cloud, 30, 0.4, storey::kDefaultSigmaN, 0.1);
  };
  Cloud previous = *cloud;
  for (int iterations = 1; iterations <= 12; ++iterations) {
    Estimation estimation;
    estimation.setInputCloud(cloud);
    estimation.setInputNormals(cloud);
    estimation.setKSearch(30);
    estimation.setSigmaP(0.4);
    estimation.setIterations(iterations);
    Cloud out;
    estimation.compute(out);
    EXPECT_EQ(estimation.getUsedIterations(), iterations);
    EXPECT_LE(energy(out, previous), energy(previous, previous)) << "update " << iterations;
    previous = out;
  }
  // As a whole (1) falls too, although a pair drawn into the reach of psi may raise it for a while.
  EXPECT_LT(energy(previous, previous), 0.2 * energy(*cloud, *cloud));
}

TEST(FastExpOfMinus, KeepsItsRelativeErrorAndVanishes) {
  for (float x = 0.0f; x < 87.0f; x += 0.0137f) {
    const double truth = std::exp(-static_cast<double>(x));
    const double value = static_cast<double>(storey::detail::fastExpOfMinus(x));
    EXPECT_LT(std::abs(value - truth), (x < 4.0f ? 1e-6 : 1e-5) * truth) << x;
  }
  EXPECT_EQ(storey::detail::fastExpOfMinus(0.0f), 1.0f);
  EXPECT_EQ(storey::detail::fastExpOfMinus(88.0f), 0.0f);
  EXPECT_EQ(storey::detail::fastExpOfMinus(1e30f), 0.0f);
}

}  // namespace
