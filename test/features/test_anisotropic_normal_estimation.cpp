// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/features/anisotropic_normal_estimation.h>

#include <limits>
#include <pcl/features/impl/normal_3d.hpp>  // header-only: pcl_features would bring VTK
#include <pcl/features/impl/normal_3d_omp.hpp>

#include "../point_types.h"
#include "synthetic_clouds.h"

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
class AnisotropicNormals : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Estimation = storey::AnisotropicNormalEstimation<PointT>;
  typename Cloud::Ptr cloud = flattenedSlice<PointT>(2000, {0.02, 15.0 * kDegree, 5});

  static Estimation over(const typename Cloud::ConstPtr& input, int k = 30) {
    Estimation estimation;
    estimation.setInputCloud(input);
    estimation.setInputNormals(input);
    estimation.setKSearch(k);
    return estimation;
  }
};
TYPED_TEST_SUITE(AnisotropicNormals, OrientedPointTypes);

TYPED_TEST(AnisotropicNormals, ReducesTheNoiseAndKeepsPointSignAndLength) {
  this->cloud->header.frame_id = "site";
  this->cloud->sensor_origin_ = Eigen::Vector4f(1.0f, 2.0f, 3.0f, 0.0f);
  this->cloud->sensor_orientation_ = Eigen::Quaternionf(0.6f, 0.8f, 0.0f, 0.0f);
  const typename TestFixture::Cloud before = *this->cloud;
  auto estimation = this->over(this->cloud);
  typename TestFixture::Cloud out;
  typename pcl::Feature<TypeParam, TypeParam>& base = estimation;  // usable through its base
  base.compute(out);
  ASSERT_EQ(out.size(), before.size());
  double error_before = 0.0;
  double error_after = 0.0;
  const auto walls = wallsOf(rectangle(0, 0, 26, 26), 0, 1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_EQ(out[i].getVector3fMap(), before[i].getVector3fMap());
    EXPECT_EQ(out[i].curvature, 0.25f);
    EXPECT_NEAR(out[i].getNormalVector3fMap().norm(), 1.0f, 1e-5f);
    EXPECT_GE(out[i].getNormalVector3fMap().dot(before[i].getNormalVector3fMap()), 0.0f);
    const Eigen::Vector3f truth = walls[i / 500].normal.template cast<float>();
    error_before += (before[i].getNormalVector3fMap() - truth).squaredNorm();
    error_after += (out[i].getNormalVector3fMap() - truth).squaredNorm();
  }
  // The mean of 30 normals with noise of 15 degrees is off by 15 / sqrt(30) = 2.7 degrees, squared
  // 1/30 of the noise; corners are left out of no mean.
  EXPECT_LT(error_after, error_before / 10.0);
  EXPECT_TRUE(sameNormals(before, *this->cloud));
  EXPECT_EQ(out.header.frame_id, "site");
  EXPECT_EQ(out.sensor_origin_, before.sensor_origin_);
  EXPECT_EQ(out.sensor_orientation_.coeffs(), before.sensor_orientation_.coeffs());
  EXPECT_TRUE(out.is_dense);
  EXPECT_GT(estimation.getUsedIterations(), 0);
  EXPECT_GT(estimation.getUsedSigmaP(), 0.0);
}

TYPED_TEST(AnisotropicNormals, IndicesGiveTheValuesOfTheFullRun) {
  auto estimation = this->over(this->cloud);
  typename TestFixture::Cloud full;
  estimation.compute(full);
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{1500, 3, 700, 3});
  estimation.setIndices(indices);
  typename TestFixture::Cloud part;
  estimation.compute(part);
  ASSERT_EQ(part.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>((*indices)[k]);
    EXPECT_EQ(part[k].getVector3fMap(), full[i].getVector3fMap());
    EXPECT_EQ(part[k].getNormalVector3fMap(), full[i].getNormalVector3fMap());
  }
}

TYPED_TEST(AnisotropicNormals, ThreadsAndASharedTreeChangeNothing) {
  typename TestFixture::Cloud out[3];
  auto estimation = this->over(this->cloud);
  estimation.setNumberOfThreads(1);
  EXPECT_EQ(estimation.getNumberOfThreads(), 1u);
  estimation.compute(out[0]);
  estimation.setNumberOfThreads(4);
  estimation.compute(out[1]);
  const auto tree = pcl::make_shared<pcl::search::KdTree<TypeParam>>();
  tree->setInputCloud(this->cloud);
  estimation.setSearchMethod(tree);
  estimation.compute(out[2]);
  EXPECT_EQ(estimation.getSearchMethod(), tree);
  EXPECT_TRUE(sameNormals(out[0], out[1]));
  // A sorted tree lists the neighbours in another order: the sums differ in the last digits.
  for (std::size_t i = 0; i < out[0].size(); ++i) {
    EXPECT_LT((out[0][i].getNormalVector3fMap() - out[2][i].getNormalVector3fMap()).norm(), 1e-3f);
  }
}

TYPED_TEST(AnisotropicNormals, WhatCannotBeComputedIsNaN) {
  auto& points = *this->cloud;
  points[10].x = kNaN;
  points[20].normal_y = kNaN;
  points[30].getNormalVector3fMap().setZero();
  points[40].x = 1000.0f;  // nobody within the radius
  points.is_dense = false;
  auto estimation = this->over(this->cloud, 0);
  estimation.setRadiusSearch(0.5);
  typename TestFixture::Cloud out;
  estimation.compute(out);
  ASSERT_EQ(out.size(), points.size());
  EXPECT_FALSE(out.is_dense);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool computable = i != 10 && i != 20 && i != 30 && i != 40;
    EXPECT_EQ(std::isfinite(out[i].normal_x), computable) << i;
    EXPECT_EQ(std::isfinite(out[i].curvature), computable) << i;
  }
}

TYPED_TEST(AnisotropicNormals, RefusesBadParametersAndInput) {
  const auto empty = pcl::make_shared<typename TestFixture::Cloud>();
  typename TestFixture::Cloud out;
  const auto isRefused = [&out](typename TestFixture::Estimation& estimation) {
    out.resize(7);
    estimation.compute(out);
    return out.empty();
  };
  typename TestFixture::Estimation no_input;
  EXPECT_TRUE(isRefused(no_input));
  auto estimation = this->over(empty);
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud);
  estimation.setInputNormals(empty);
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud, 0);  // neither k nor radius
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud, -3);
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud);
  estimation.setRadiusSearch(1.0);  // both
  EXPECT_TRUE(isRefused(estimation));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    estimation = this->over(this->cloud);
    estimation.setSigmaP(bad);
    EXPECT_TRUE(isRefused(estimation));
    estimation = this->over(this->cloud);
    estimation.setSigmaN(bad);
    EXPECT_TRUE(isRefused(estimation));
    estimation = this->over(this->cloud);
    estimation.setAlpha(bad);
    EXPECT_TRUE(isRefused(estimation));
  }
  estimation = this->over(this->cloud);
  estimation.setIterations(-1);
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud);
  estimation.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 2000}));
  EXPECT_TRUE(isRefused(estimation));
  estimation = this->over(this->cloud);
  estimation.compute(*this->cloud);  // output is the input
  EXPECT_TRUE(this->cloud->empty());
}

TYPED_TEST(AnisotropicNormals, FullOrganisedInputStaysOrganisedAndTheObjectCanBeUsedAgain) {
  auto estimation = this->over(this->cloud);
  typename TestFixture::Cloud out;
  estimation.compute(out);
  EXPECT_EQ(out.height, 1u);
  const auto organised = flattenedSlice<TypeParam>(1200, {0.02, 0.2, 6});
  organised->width = 40;
  organised->height = 30;
  estimation.setInputCloud(organised);
  estimation.setInputNormals(organised);
  estimation.compute(out);
  EXPECT_EQ(out.width, 40u);
  EXPECT_EQ(out.height, 30u);
  for (const auto& p : out) {
    EXPECT_TRUE(std::isfinite(p.normal_x));
  }
}

TYPED_TEST(AnisotropicNormals, RotatedAndShiftedInputGivesRotatedNormals) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  auto estimation = this->over(this->cloud);
  estimation.setSigmaP(0.3);
  estimation.setIterations(5);
  typename TestFixture::Cloud here;
  estimation.compute(here);
  const auto moved = transformed(*this->cloud, rotation, {1000.0, 0.0, -1000.0});
  auto there_estimation = this->over(moved);
  there_estimation.setSigmaP(0.3);
  there_estimation.setIterations(5);
  typename TestFixture::Cloud there;
  there_estimation.compute(there);
  // Coordinates near 1000 are rounded to 6e-5: now and then the 30th neighbour is another one.
  int turned = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Eigen::Vector3f expected =
        rotation.cast<float>() * Eigen::Vector3f(here[i].getNormalVector3fMap());
    turned += (there[i].getNormalVector3fMap() - expected).norm() > 2e-3f ? 1 : 0;
  }
  EXPECT_LE(turned, 20);  // 1 %
}

TYPED_TEST(AnisotropicNormals, GettersReturnWhatWasSet) {
  struct Named : TestFixture::Estimation {
    std::string name() const { return this->getClassName(); }
  } estimation;
  estimation.setSigmaP(0.4);
  estimation.setSigmaN(0.5);
  estimation.setAlpha(0.6);
  estimation.setIterations(7);
  EXPECT_EQ(estimation.getSigmaP(), 0.4);
  EXPECT_EQ(estimation.getSigmaN(), 0.5);
  EXPECT_EQ(estimation.getAlpha(), 0.6);
  EXPECT_EQ(estimation.getIterations(), 7);
  EXPECT_EQ(estimation.name(), "AnisotropicNormalEstimation");
  const typename TestFixture::Estimation::Ptr shared(new typename TestFixture::Estimation);
  const typename TestFixture::Estimation::ConstPtr constant = shared;
  EXPECT_EQ(constant->getSigmaN(), storey::kDefaultSigmaN);
}

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;
using Estimation = storey::AnisotropicNormalEstimation<PointT>;

TEST(AnisotropicNormalEstimation, AnExactPlaneStaysAndACreaseIsSharperThanByPca) {
  const std::vector<Panel> crease = {
      {{0, 0, 0}, {10, 0, 0}, {0, 0, 10}, -Eigen::Vector3d::UnitY()},
      {{10, 0, 0}, {0, 10, 0}, {0, 0, 10}, Eigen::Vector3d::UnitX()}};
  const auto exact = sampled<PointT>(crease, 4000, {0.0, 0.0, 8});
  const auto noisy = sampled<PointT>(crease, 4000, {0.02, 10.0 * kDegree, 8});
  Cloud out;
  Estimation estimation;
  estimation.setKSearch(30);
  estimation.setInputCloud(exact);
  estimation.setInputNormals(exact);
  estimation.compute(out);
  for (std::size_t i = 0; i < out.size(); ++i) {  // walls at 90 degrees do not touch each other
    EXPECT_LT((out[i].getNormalVector3fMap() - (*exact)[i].getNormalVector3fMap()).norm(), 1e-5f);
  }
  estimation.setInputCloud(noisy);
  estimation.setInputNormals(noisy);
  estimation.compute(out);
  pcl::NormalEstimationOMP<PointT, PointT> pca;
  pca.setInputCloud(noisy);
  pca.setKSearch(30);
  Cloud by_pca;
  pca.compute(by_pca);
  double ours = 0.0;
  double theirs = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Eigen::Vector3f truth = (*exact)[i].getNormalVector3fMap();
    if (std::hypot((*exact)[i].x - 10.0f, (*exact)[i].y) < 0.3f) {  // at the crease
      ours += static_cast<double>(1.0f - out[i].getNormalVector3fMap().dot(truth));
      theirs += static_cast<double>(1.0f - std::abs(by_pca[i].getNormalVector3fMap().dot(truth)));
    }
  }
  EXPECT_LT(ours, 0.5 * theirs);
}

TEST(AnisotropicNormalEstimation, ASearchSurfaceGivesItsNormalsToOtherPoints) {
  const auto surface = flattenedSlice<PointT>(2000, {0.02, 15.0 * kDegree, 9});
  Estimation on_surface;
  on_surface.setInputCloud(surface);
  on_surface.setInputNormals(surface);
  on_surface.setKSearch(30);
  Cloud expected;
  on_surface.compute(expected);
  const auto queries = pcl::make_shared<Cloud>();
  queries->push_back((*surface)[5]);
  PointT between;  // before the wall y = 0
  between.x = 13.0f;
  between.y = 0.05f;
  queries->push_back(between);
  queries->push_back(PointT(kNaN, 0.0f, 0.0f));
  queries->is_dense = false;
  Estimation estimation;
  estimation.setInputCloud(queries);
  estimation.setSearchSurface(surface);
  estimation.setInputNormals(surface);
  estimation.setKSearch(30);
  Cloud out;
  estimation.compute(out);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[0].getNormalVector3fMap(), expected[5].getNormalVector3fMap());
  EXPECT_GT(out[1].getNormalVector3fMap().dot(-Eigen::Vector3f::UnitY()),
            std::cos(8.0f * 0.01745f));
  EXPECT_FALSE(std::isfinite(out[2].normal_x));
}

TEST(AnisotropicNormalEstimation, DuplicatesAndHugeCoordinatesAreHarmless) {
  auto cloud = pcl::make_shared<Cloud>();
  PointT p;
  p.x = 1e7f;
  p.normal_x = 1.0f;
  cloud->resize(200000, p);  // a plain k-d tree would take minutes
  for (const bool radius : {false, true}) {
    Estimation estimation;
    estimation.setInputCloud(cloud);
    estimation.setInputNormals(cloud);
    if (radius) {
      estimation.setRadiusSearch(1.0);
    } else {
      estimation.setKSearch(30);
    }
    Cloud out;
    estimation.compute(out);
    ASSERT_EQ(out.size(), cloud->size());
    EXPECT_LT((out[777].getNormalVector3fMap() - Eigen::Vector3f::UnitX()).norm(), 1e-6f);
  }
  (*cloud)[3].x = kNaN;
  cloud->resize(4);
  for (PointT& q : *cloud) {
    q.x = kNaN;  // all, although is_dense says otherwise
  }
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud);
  estimation.setKSearch(30);
  Cloud out;
  estimation.compute(out);
  EXPECT_EQ(out.size(), 4u);
  EXPECT_FALSE(out.is_dense);
}

}  // namespace
