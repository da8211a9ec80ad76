// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/features/vertical_direction_estimation.h>

#include <limits>

#include "../point_types.h"
#include "synthetic_clouds.h"

namespace {

const Noise kPaperNoise{0.1, 15.0 * kDegree, 1};  // [Sui et al. 2016, section 6]

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Matrix3d tilt(double degrees) {
  return (Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d(1.0, 0.3, 0.0).normalized()) *
          Eigen::AngleAxisd(0.37, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

template <typename PointT>
class VerticalDirection : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Estimation = storey::VerticalDirectionEstimation<PointT>;

  static typename Cloud::Ptr box(int n, double degrees, const Noise& noise = kPaperNoise) {
    return transformed(*sampled<PointT>(wallsOf(rectangle(0, 0, 26, 26), 0, 60), n, noise),
                       tilt(degrees));
  }
};
TYPED_TEST_SUITE(VerticalDirection, OrientedPointTypes);

TYPED_TEST(VerticalDirection, FindsATiltOf1000thsOfADegreeUnderThePapersNoise) {
  const auto cloud = this->box(20000, 1.5);
  typename TestFixture::Estimation estimation;
  estimation.setInputCloud(cloud);
  Eigen::Vector3d up;
  ASSERT_TRUE(estimation.compute(up));
  // A wall of 5000 points leans by 0.1 / (sqrt(5000) * 60 / sqrt(12)) rad = 0.0047 degrees; two
  // pairs of walls: 0.0033 for each angle.
  EXPECT_LT(angleBetween(up, tilt(1.5).col(2)), 0.02 * kDegree);
  EXPECT_NEAR(up.norm(), 1.0, 1e-12);
  EXPECT_LT((estimation.getRotation() * up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(estimation.getUp(), up);
  EXPECT_FALSE(estimation.getQuality().one_wall_direction);
  EXPECT_GT(estimation.getConfidence(), 0.5);
}

TYPED_TEST(VerticalDirection, IndicesGiveTheResultOfTheExtractedCloud) {
  auto cloud = this->box(20000, 2.0);
  const auto part = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < part->size(); ++i) {
    indices->push_back(static_cast<pcl::index_t>(i));
  }
  for (int i = 0; i < 5000; ++i) {  // more points, all wrong
    auto p = (*part)[static_cast<std::size_t>(i)];
    p.normal_x = 0.6f;
    p.normal_z = 0.8f;
    p.x += 0.5f * p.z;
    cloud->push_back(p);
  }
  typename TestFixture::Estimation whole;
  whole.setColumnSize(1.2);
  whole.setInputCloud(part);
  typename TestFixture::Estimation indexed;
  indexed.setColumnSize(1.2);
  indexed.setInputCloud(cloud);
  indexed.setIndices(indices);
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  ASSERT_TRUE(whole.compute(a));
  ASSERT_TRUE(indexed.compute(b));
  EXPECT_EQ(a, b);
}

TYPED_TEST(VerticalDirection, LeavesOutInvalidPoints) {
  const auto clean = this->box(10000, 1.0);
  auto dirty = pcl::make_shared<typename TestFixture::Cloud>(*clean);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (int k = 0; k < 3; ++k) {
    auto p = (*clean)[static_cast<std::size_t>(k)];
    if (k == 0) p.x = kNaN;
    if (k == 1) p.normal_y = kNaN;
    if (k == 2) p.getNormalVector3fMap().setZero();
    dirty->push_back(p);
  }
  dirty->is_dense = false;
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  typename TestFixture::Estimation estimation;
  estimation.setColumnSize(1.2);
  estimation.setInputCloud(clean);
  ASSERT_TRUE(estimation.compute(a));
  estimation.setInputCloud(dirty);  // another size on the same object
  ASSERT_TRUE(estimation.compute(b));
  EXPECT_EQ(a, b);
}

TYPED_TEST(VerticalDirection, FailsWithoutUsableInput) {
  typename TestFixture::Estimation estimation;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  EXPECT_FALSE(estimation.compute(up));  // no input
  EXPECT_EQ(up, Eigen::Vector3d::UnitZ());
  estimation.setInputCloud(pcl::make_shared<typename TestFixture::Cloud>());
  EXPECT_FALSE(estimation.compute(up));
  const auto cloud = this->box(100, 0.0);
  estimation.setInputCloud(cloud);
  estimation.setColumnSize(-1.0);
  EXPECT_FALSE(estimation.compute(up));
  estimation.setColumnSize(0.0);
  estimation.setInitialUp({0.0, std::numeric_limits<double>::quiet_NaN(), 1.0});
  EXPECT_FALSE(estimation.compute(up));
  estimation.setInitialUp(Eigen::Vector3d::Zero());
  estimation.setInputNormals(pcl::make_shared<typename TestFixture::Cloud>());
  EXPECT_FALSE(estimation.compute(up));  // 0 normals for 100 points
  estimation.setInputNormals(nullptr);
  auto outside = pcl::make_shared<pcl::Indices>(pcl::Indices{0, 100});
  estimation.setIndices(outside);
  EXPECT_FALSE(estimation.compute(up));
  EXPECT_EQ(estimation.getConfidence(), 0.0);
}

TYPED_TEST(VerticalDirection, IsTheSameForAnyNumberOfThreadsAndLeavesTheInputAlone) {
  const auto cloud = this->box(10000, 1.0);
  const typename TestFixture::Cloud before = *cloud;
  Eigen::Vector3d up[2];
  for (const unsigned int threads : {1u, 4u}) {
    typename TestFixture::Estimation estimation;
    estimation.setNumberOfThreads(threads);
    EXPECT_EQ(estimation.getNumberOfThreads(), threads);
    estimation.setInputCloud(cloud);
    ASSERT_TRUE(estimation.compute(up[threads / 4]));
  }
  EXPECT_EQ(up[0], up[1]);
  EXPECT_TRUE(sameNormals(before, *cloud));
}

using PointT = pcl::PointNormal;
using Estimation = storey::VerticalDirectionEstimation<PointT>;

Eigen::Vector3d upOf(const pcl::PointCloud<PointT>::Ptr& cloud,
                     const Eigen::Vector3d& initial = Eigen::Vector3d::Zero()) {
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setInitialUp(initial);
  Eigen::Vector3d up;
  EXPECT_TRUE(estimation.compute(up));
  return up;
}

TEST(VerticalDirectionEstimation, ReachesTheGoalOnBoxesAndHexagonsOfThePapersKind) {
  for (const int sides : {4, 6}) {
    for (const double degrees : {0.0, 1.5, 5.0}) {
      const auto cloud = transformed(
          *sampled<PointT>(wallsOf(regularPolygon(sides, 18.4), 0, 60), 200000, kPaperNoise),
          tilt(degrees));
      EXPECT_LT(angleBetween(upOf(cloud), tilt(degrees).col(2)), 0.01 * kDegree)
          << sides << " sides, tilt " << degrees;
    }
  }
}

TEST(VerticalDirectionEstimation, FindsAnyAxisFromTheWallsAlone) {
  const auto hexagon = sampled<PointT>(wallsOf(regularPolygon(6, 18.4), 0, 60), 20000, kPaperNoise);
  for (const double degrees : {40.0, 75.0, 110.0}) {
    const Eigen::Vector3d up = upOf(transformed(*hexagon, tilt(degrees)));
    const Eigen::Vector3d truth = tilt(degrees).col(2);
    // Walls cannot tell up from down: the end nearer to +z is taken.
    EXPECT_LT(angleBetween(up, truth.z() < 0.0 ? Eigen::Vector3d(-truth) : truth), 0.03 * kDegree);
  }
}

TEST(VerticalDirectionEstimation, RoofsAndGroundDoNotOutvoteTheGivenFrame) {
  std::vector<Panel> panels = wallsOf(rectangle(0, 0, 20, 20), 0, 10);
  panels.push_back({{-30, -30, 0}, {80, 0, 0}, {0, 80, 0}, Eigen::Vector3d::UnitZ()});
  const auto cloud = sampled<PointT>(panels, 50000, {0.02, 3.0 * kDegree, 2});
  EXPECT_LT(angleBetween(upOf(transformed(*cloud, tilt(1.0))), tilt(1.0).col(2)), 0.05 * kDegree);
}

TEST(VerticalDirectionEstimation, TheInitialUpChoosesTheEnd) {
  const auto cloud = sampled<PointT>(wallsOf(rectangle(0, 0, 26, 26), 0, 60), 20000, kPaperNoise);
  const Eigen::Vector3d down = upOf(cloud, {0.05, 0.0, -2.0});
  EXPECT_LT(angleBetween(down, -Eigen::Vector3d::UnitZ()), 0.02 * kDegree);
}

TEST(VerticalDirectionEstimation, OneWallLeavesTheTiltAlongItToLevelPointsOrTheStart) {
  // Walls facing +y only, tilted about y: the walls cannot see it.
  const Eigen::Matrix3d lean =
      Eigen::AngleAxisd(3.0 * kDegree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  std::vector<Panel> panels = {{{0, 0, 0}, {40, 0, 0}, {0, 0, 15}, Eigen::Vector3d::UnitY()}};
  const Noise noise{0.02, 5.0 * kDegree, 3};
  Estimation estimation;
  Eigen::Vector3d up;
  estimation.setInputCloud(transformed(*sampled<PointT>(panels, 20000, noise), lean));
  ASSERT_TRUE(estimation.compute(up));
  EXPECT_TRUE(estimation.getQuality().one_wall_direction);
  EXPECT_LT(angleBetween(up, Eigen::Vector3d::UnitZ()), 0.5 * kDegree);  // stays at the start
  panels.push_back({{0, 0, 0}, {40, 0, 0}, {0, 20, 0}, Eigen::Vector3d::UnitZ()});
  estimation.setInputCloud(transformed(*sampled<PointT>(panels, 40000, noise), lean));
  ASSERT_TRUE(estimation.compute(up));
  // 20,000 level normals with noise of 5 / sqrt(2) degrees along the wall: 0.03 degrees.
  EXPECT_LT(angleBetween(up, lean.col(2)), 0.15 * kDegree);
}

TEST(VerticalDirectionEstimation, ScaleOffsetAndRotationDoNotMatter) {
  const auto cloud = sampled<PointT>(wallsOf(rectangle(0, 0, 26, 26), 0, 60), 20000, kPaperNoise);
  const Eigen::Vector3d up = upOf(cloud);
  const auto far = transformed(*cloud, tilt(2.0), {1000.0, -2000.0, 500.0});
  EXPECT_LT(angleBetween(upOf(far), tilt(2.0) * up), 0.02 * kDegree);
  const auto small = transformed(*cloud, 0.001 * Eigen::Matrix3d::Identity());
  // Points at the borders of columns change place by rounding.
  EXPECT_LT(angleBetween(upOf(small), up), 5e-3 * kDegree);
}

TEST(VerticalDirectionEstimation, SeparateNormalsAndDegenerateClouds) {
  const auto cloud = sampled<PointT>(wallsOf(rectangle(0, 0, 26, 26), 0, 60), 5000, kPaperNoise);
  auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  for (const PointT& p : *cloud) {
    points->push_back({p.x, p.y, p.z});
    normals->push_back({p.normal_x, p.normal_y, p.normal_z});
  }
  storey::VerticalDirectionEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  Eigen::Vector3d up;
  EXPECT_FALSE(estimation.compute(up));  // no normals
  estimation.setInputNormals(normals);
  ASSERT_TRUE(estimation.compute(up));
  EXPECT_EQ(up, upOf(cloud));
  const auto copies = pcl::make_shared<pcl::PointCloud<PointT>>();
  copies->resize(200000, (*cloud)[0]);
  EXPECT_TRUE(upOf(copies).allFinite());
}

}  // namespace
