// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/features/normal_side.h>
#include <storey/features/outward_normal_orientation.h>
#include <storey/features/pca_normals.h>

#include <algorithm>
#include <limits>

#include "../point_types.h"
#include "synthetic_clouds.h"

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const Noise kScanNoise{0.02, 5.0 * kDegree, 4};

std::vector<Eigen::Vector2d> reversed(std::vector<Eigen::Vector2d> polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Panel level(const std::vector<Eigen::Vector2d>& r, double z) {
  return {{r[0].x(), r[0].y(), z},
          {r[2].x() - r[0].x(), 0.0, 0.0},
          {0.0, r[2].y() - r[0].y(), 0.0},
          Eigen::Vector3d::UnitZ()};
}

// A ring of 30 x 30 round a courtyard of 10 x 10, 12 high.
std::vector<Panel> ring(bool with_roof) {
  std::vector<Panel> panels = wallsOf(rectangle(0, 0, 30, 30), 0, 12);
  for (const Panel& p : wallsOf(reversed(rectangle(10, 10, 20, 20)), 0, 12)) {
    panels.push_back(p);
  }
  if (with_roof) {
    panels.push_back(level(rectangle(0, 0, 30, 10), 12));
    panels.push_back(level(rectangle(0, 20, 30, 30), 12));
    panels.push_back(level(rectangle(0, 10, 10, 20), 12));
    panels.push_back(level(rectangle(20, 10, 30, 20), 12));
    panels.push_back(level(rectangle(-20, -20, 50, 0), 0));
    panels.push_back(level(rectangle(10, 10, 20, 20), 0));
  }
  return panels;
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr withRandomSigns(const pcl::PointCloud<PointT>& cloud) {
  std::mt19937 random(11);
  auto result = pcl::make_shared<pcl::PointCloud<PointT>>(cloud);
  for (PointT& p : *result) {
    if (random() % 2 == 0) {
      p.getNormalVector3fMap() *= -1.0f;
    }
  }
  return result;
}

template <typename PointT>
double shareOfSameSign(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same += a[i].getNormalVector3fMap().dot(b[i].getNormalVector3fMap()) > 0.0f ? 1 : 0;
  }
  return static_cast<double>(same) / static_cast<double>(a.size());
}

template <typename PointT>
class Orientation : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Estimation = storey::OutwardNormalOrientation<PointT>;
};
TYPED_TEST_SUITE(Orientation, OrientedPointTypes);

TYPED_TEST(Orientation, FindsTheSignsOfACourtyardBuildingInAnyFrame) {
  const auto truth = sampled<TypeParam>(ring(true), 40000, kScanNoise);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  const auto turned = transformed(*truth, rotation, {1000.0, 0.0, 0.0});
  typename TestFixture::Estimation orientation;
  orientation.setInputCloud(withRandomSigns(*turned));
  orientation.setUp(rotation.col(2));
  typename TestFixture::Cloud out;
  orientation.orient(out);
  ASSERT_EQ(out.size(), truth->size());
  EXPECT_GT(shareOfSameSign(out, *turned), 0.99);
  EXPECT_GT(orientation.getConfidence(), 0.8);
  ASSERT_EQ(orientation.getConfidences().size(), truth->size());
}

TYPED_TEST(Orientation, OnlyTurnsIndexedFiniteNormals) {
  const auto truth = sampled<TypeParam>(wallsOf(rectangle(0, 0, 20, 20), 0, 10), 8000, kScanNoise);
  auto cloud = transformed(*truth, Eigen::Matrix3d::Identity());
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].getNormalVector3fMap() *= -1.0f;
    if (i % 2 == 0) {
      indices->push_back(static_cast<pcl::index_t>(i));
    }
  }
  (*cloud)[0].x = kNaN;
  (*cloud)[2].normal_x = kNaN;
  (*cloud)[4].getNormalVector3fMap().setZero();
  typename TestFixture::Estimation orientation;
  orientation.setInputCloud(cloud);
  orientation.setIndices(indices);
  typename TestFixture::Cloud out;
  orientation.orient(out);
  ASSERT_EQ(out.size(), cloud->size());
  int turned = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool same = out[i].getNormalVector3fMap() == (*cloud)[i].getNormalVector3fMap();
    if (i % 2 == 1) {
      EXPECT_TRUE(same);
      EXPECT_EQ(orientation.getConfidences()[i], 0.0f);
    } else if (i > 4) {
      turned += same ? 0 : 1;
    }
  }
  EXPECT_GT(turned, 3900);
}

TYPED_TEST(Orientation, ThreadsChangeNothingAndBadInputGivesNothing) {
  const auto cloud = withRandomSigns(*sampled<TypeParam>(ring(true), 20000, kScanNoise));
  typename TestFixture::Cloud out[2];
  typename TestFixture::Estimation orientation;
  EXPECT_EQ(orientation.getConfidence(), 0.0);
  out[0].resize(3);
  orientation.orient(out[0]);  // no input
  EXPECT_TRUE(out[0].empty());
  orientation.setInputCloud(cloud);
  for (const unsigned int threads : {1u, 4u}) {
    orientation.setNumberOfThreads(threads);
    EXPECT_EQ(orientation.getNumberOfThreads(), threads);
    orientation.orient(out[threads / 4]);
  }
  EXPECT_TRUE(sameNormals(out[0], out[1]));
  orientation.setUp(Eigen::Vector3d::Zero());
  orientation.orient(out[0]);
  EXPECT_TRUE(out[0].empty());
  orientation.setUp(Eigen::Vector3d::UnitZ());
  orientation.setVoxelSize(-1.0);
  EXPECT_EQ(orientation.getVoxelSize(), -1.0);
  out[0].resize(3);
  orientation.orient(out[0]);
  EXPECT_TRUE(out[0].empty());
  orientation.setVoxelSize(0.0);
  orientation.setInputCloud(pcl::make_shared<typename TestFixture::Cloud>());
  orientation.orient(out[0]);
  EXPECT_TRUE(out[0].empty());
}

TYPED_TEST(Orientation, PcaNormalsOfAPlaneAreExactAndInvalidPointsNaN) {
  auto cloud = sampled<TypeParam>({level(rectangle(0, 0, 10, 10), 3.0)}, 2000, Noise{});
  (*cloud)[7].y = kNaN;
  EXPECT_EQ(storey::estimateNormals(*cloud, 12), 12);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (i == 7) {
      EXPECT_FALSE(std::isfinite((*cloud)[i].normal_z));
    } else {
      EXPECT_NEAR(std::abs((*cloud)[i].normal_z), 1.0f, 1e-6f);
    }
  }
  EXPECT_EQ(storey::estimateNormals(*cloud, 2), 0);
  EXPECT_EQ(storey::estimateNormals(*cloud, -5), 0);
}

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;

TEST(OutwardNormalOrientation, WallsWithoutRoofsTellByTheSpacesTheyShare) {
  // No ray that leaves steeply says anything here; the yard is known from the ring around it.
  const auto truth = sampled<PointT>(ring(false), 40000, kScanNoise);
  storey::OutwardNormalOrientation<PointT> orientation;
  orientation.setInputCloud(withRandomSigns(*truth));
  Cloud out;
  orientation.orient(out);
  EXPECT_GT(shareOfSameSign(out, *truth), 0.98);
}

TEST(OutwardNormalOrientation, WorksOnNormalsEstimatedFromNoisyPositions) {
  const auto truth = sampled<PointT>(ring(true), 60000, {0.05, 0.0, 6});
  auto cloud = pcl::make_shared<Cloud>(*truth);
  EXPECT_GE(storey::estimateNormals(*cloud), 16);
  storey::OutwardNormalOrientation<PointT> orientation;
  orientation.setInputCloud(cloud);
  orientation.orient(*cloud);                        // in place
  EXPECT_GT(shareOfSameSign(*cloud, *truth), 0.97);  // edges have no clear normal
}

TEST(OutwardNormalOrientation, SurvivesCopiesOfOnePointAndOutliers) {
  auto copies = pcl::make_shared<Cloud>();
  PointT p;
  p.x = 1e7f;
  p.normal_x = 1.0f;
  copies->resize(200000, p);
  storey::OutwardNormalOrientation<PointT> orientation;
  orientation.setInputCloud(copies);
  Cloud out;
  orientation.orient(out);
  EXPECT_EQ(out.size(), copies->size());
  EXPECT_EQ(storey::estimateNormals(*copies), 16);
  EXPECT_FALSE(std::isfinite((*copies)[0].normal_x));

  const auto truth = sampled<PointT>(ring(true), 20000, kScanNoise);
  auto far = withRandomSigns(*truth);
  far->push_back(p);
  orientation.setInputCloud(far);
  orientation.orient(out);
  out.resize(truth->size());
  EXPECT_GT(shareOfSameSign(out, *truth), 0.98);
}

TEST(DetectNormalSide, TellsBuildingFromSpaceFromFacade) {
  const auto building = sampled<PointT>(ring(true), 20000, kScanNoise);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const auto solid = storey::detectNormalSide(*building, up);
  EXPECT_EQ(solid.side, storey::NormalSide::Building);
  // Walls of 30 and of 10: n.(x - c) = 15 and -5 on perimeters 120 and 40, so (1800 - 200) / (the
  // mean distance from the centre of a square of half side a is 1.148 a: 1.148 (1800 + 200)).
  EXPECT_NEAR(solid.outwardness, 1600.0 / 2296.0, 0.05);
  Cloud yard = *sampled<PointT>(wallsOf(reversed(rectangle(0, 0, 30, 20)), 0, 9), 9000, kScanNoise);
  EXPECT_EQ(storey::detectNormalSide(yard, up).side, storey::NormalSide::Space);
  for (std::size_t i = 0; i < 30000; ++i) {  // a dense corner of it has no more votes
    yard.push_back(yard[i % 50]);
  }
  EXPECT_EQ(storey::detectNormalSide(yard, up).side, storey::NormalSide::Space);
  // A front with two wings, seen from the front only: a U open to -y.
  const std::vector<Panel> front = {{{0, 0, 0}, {40, 0, 0}, {0, 0, 9}, -Eigen::Vector3d::UnitY()},
                                    {{0, -5, 0}, {0, 5, 0}, {0, 0, 9}, Eigen::Vector3d::UnitX()},
                                    {{40, -5, 0}, {0, 5, 0}, {0, 0, 9}, -Eigen::Vector3d::UnitX()}};
  const auto facade = storey::detectNormalSide(*sampled<PointT>(front, 9000, kScanNoise), up);
  EXPECT_GT(facade.one_sidedness, 0.4);
  EXPECT_EQ(facade.side, storey::NormalSide::Building);
}

TEST(DetectNormalSide, TellsAYardAmongOutliersFarAway) {
  const auto yard =
      sampled<PointT>(wallsOf(reversed(rectangle(0, 0, 30, 20)), 0, 9), 9000, kScanNoise);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double alone = storey::detectNormalSide(*yard, up).outwardness;
  for (int i = 0; i < 20; ++i) {
    PointT outlier = (*yard)[0];
    outlier.x = 1e6f * static_cast<float>(i - 10);
    outlier.y = 1e7f;
    yard->push_back(outlier);
  }
  EXPECT_NEAR(storey::detectNormalSide(*yard, up).outwardness, alone, 1e-6);  // another origin
}

TEST(DetectNormalSide, IsUndecidedWithoutEvidence) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(storey::detectNormalSide(Cloud(), up).side, storey::NormalSide::Undecided);
  const auto ground = sampled<PointT>({level(rectangle(0, 0, 9, 9), 0)}, 1000, kScanNoise);
  EXPECT_EQ(storey::detectNormalSide(*ground, up).side, storey::NormalSide::Undecided);
  const auto unsigned_walls = withRandomSigns(*sampled<PointT>(ring(false), 20000, kScanNoise));
  EXPECT_EQ(storey::detectNormalSide(*unsigned_walls, up).side, storey::NormalSide::Undecided);
  EXPECT_EQ(storey::detectNormalSide(*unsigned_walls, Eigen::Vector3d::Zero()).side,
            storey::NormalSide::Undecided);
}

}  // namespace
