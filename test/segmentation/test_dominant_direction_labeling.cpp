// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/search/brute_force.h>
#include <storey/segmentation/dominant_direction_labeling.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <pcl/search/impl/brute_force.hpp>
#include <pcl/search/impl/search.hpp>
#include <random>
#include <thread>
#include <vector>

#include "../point_types.h"
#include "noisy_slice.h"

namespace {

using Labels = pcl::PointCloud<pcl::Label>;

double shareRight(const Labels& labels, const std::vector<std::uint32_t>& truth) {
  std::size_t right = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    right += labels[i].label == truth[i] ? 1U : 0U;
  }
  return static_cast<double>(right) / static_cast<double>(truth.size());
}

// E of (4)-(6) by the letter: all pairs of points sorted by distance.
double energyByTheLetter(const pcl::PointCloud<pcl::PointNormal>& cloud, const Labels& labels,
                         const Directions& directions, double lambda, std::size_t k) {
  double energy = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d normal = cloud[i].getNormalVector3fMap().cast<double>().normalized();
    energy += (directions[labels[i].label] - normal).squaredNorm();
    std::vector<std::pair<float, std::size_t>> others;
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      if (j != i) {
        others.emplace_back((cloud[i].getVector3fMap() - cloud[j].getVector3fMap()).squaredNorm(),
                            j);
      }
    }
    std::sort(others.begin(), others.end());
    for (std::size_t rank = 0; rank < std::min(k, others.size()); ++rank) {
      energy += labels[others[rank].second].label != labels[i].label ? lambda : 0.0;
    }
  }
  return energy;
}

template <typename PointT>
struct Exposed : storey::DominantDirectionLabeling<PointT> {
  using storey::DominantDirectionLabeling<PointT>::getClassName;
};

template <typename PointT>
class DominantDirectionLabelingTest : public ::testing::Test {
 protected:
  using Labeling = storey::DominantDirectionLabeling<PointT>;

  static Labels run(Labeling& labeling) {
    Labels labels;
    labels.resize(2);  // what was there before must go
    labeling.segment(labels);
    return labels;
  }
};
TYPED_TEST_SUITE(DominantDirectionLabelingTest, OrientedPointTypes);

TYPED_TEST(DominantDirectionLabelingTest, NoisyDecagonIsLabelledByItsWalls) {
  const Slice<TypeParam> slice = makeSlice<TypeParam>(10, 5000, 10.6, 1);
  typename TestFixture::Labeling labeling;
  labeling.setInputCloud(slice.cloud);
  labeling.setDirections(regularDirections(10));
  for (const bool per_point : {false, true}) {
    labeling.setPerPoint(per_point);
    const Labels labels = TestFixture::run(labeling);
    ASSERT_EQ(labels.size(), 5000U);
    EXPECT_EQ(labels.header.frame_id, "slice");
    EXPECT_EQ(labels.width, 5000U);
    EXPECT_EQ(labels.height, 1U);
    // nearest directions alone: P(|N(0, 10.6)| < 18) = 0.91. Wrong labels are left at the corners,
    // where the shortest boundary runs straight up: about one link (0.3) of 6.5 on both sides
    EXPECT_GT(shareRight(labels, slice.truth), 0.95);
    EXPECT_EQ(labeling.getUsedCellSize() > 0.0, !per_point);
  }
}

TYPED_TEST(DominantDirectionLabelingTest, InvalidPointsAreUnlabelled) {
  Slice<TypeParam> slice = makeSlice<TypeParam>(4, 200, 5.0, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  (*slice.cloud)[0].x = nan;
  (*slice.cloud)[1].normal_y = nan;
  (*slice.cloud)[2].getNormalVector3fMap().setZero();
  slice.cloud->is_dense = true;  // a lie that files tell
  typename TestFixture::Labeling labeling;
  labeling.setInputCloud(slice.cloud);
  labeling.setDirections(regularDirections(4));
  const Labels labels = TestFixture::run(labeling);
  ASSERT_EQ(labels.size(), 200U);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(labels[i].label == storey::kUnlabeled, i < 3);
  }
  EXPECT_TRUE(std::isfinite(labeling.getEnergy()));
}

TYPED_TEST(DominantDirectionLabelingTest, SubsetInAnyOrderIsTheSubCloud) {
  const Slice<TypeParam> slice = makeSlice<TypeParam>(6, 2000, 10.0, 3);
  pcl::Indices subset(2000);
  std::iota(subset.begin(), subset.end(), 0);
  std::mt19937 random(4);
  std::shuffle(subset.begin(), subset.end(), random);
  subset.resize(1200);
  typename TestFixture::Labeling labeling;
  labeling.setInputCloud(slice.cloud);
  labeling.setDirections(regularDirections(6));
  labeling.setIndices(pcl::make_shared<pcl::Indices>(subset));
  const Labels of_subset = TestFixture::run(labeling);
  typename TestFixture::Labeling other;
  other.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>(*slice.cloud, subset));
  other.setDirections(regularDirections(6));
  const Labels of_cloud = TestFixture::run(other);
  ASSERT_EQ(of_subset.size(), 1200U);
  ASSERT_EQ(of_cloud.size(), 1200U);
  for (std::size_t i = 0; i < 1200; ++i) {
    EXPECT_EQ(of_subset[i].label, of_cloud[i].label);
  }
  EXPECT_EQ(labeling.getEnergy(), other.getEnergy());
}

TYPED_TEST(DominantDirectionLabelingTest, NothingInNothingOut) {
  typename TestFixture::Labeling labeling;
  labeling.setDirections(regularDirections(4));
  EXPECT_TRUE(TestFixture::run(labeling).empty());  // no input
  labeling.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  EXPECT_TRUE(TestFixture::run(labeling).empty());
  labeling.setInputCloud(makeSlice<TypeParam>(4, 60, 1.0, 5).cloud);
  EXPECT_EQ(TestFixture::run(labeling).size(), 60U);
  EXPECT_GT(labeling.getEnergy(), 0.0);
  labeling.setInputCloud(makeSlice<TypeParam>(4, 1, 1.0, 5).cloud);  // another size
  const Labels one = TestFixture::run(labeling);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].label, 0U);
}

TYPED_TEST(DominantDirectionLabelingTest, BadParametersGiveNothing) {
  const Slice<TypeParam> slice = makeSlice<TypeParam>(4, 60, 1.0, 6);
  const auto expect_nothing = [&](auto change) {
    typename TestFixture::Labeling labeling;
    labeling.setInputCloud(slice.cloud);
    labeling.setDirections(regularDirections(4));
    EXPECT_EQ(TestFixture::run(labeling).size(), 60U);
    change(labeling);
    EXPECT_TRUE(TestFixture::run(labeling).empty());
    EXPECT_EQ(labeling.getEnergy(), 0.0);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  expect_nothing([](auto& l) { l.setDirections({}); });
  expect_nothing([](auto& l) { l.setDirections({Eigen::Vector3d::Zero()}); });
  expect_nothing([=](auto& l) { l.setDirections({Eigen::Vector3d(infinity, 0.0, 0.0)}); });
  expect_nothing([](auto& l) { l.setLambda(-1.0); });
  expect_nothing([=](auto& l) { l.setLambda(infinity); });
  expect_nothing([](auto& l) { l.setKSearch(0); });
  expect_nothing([](auto& l) { l.setCellSize(-1.0); });
  expect_nothing([](auto& l) { l.setCellSize(std::nan("")); });
  expect_nothing(
      [](auto& l) { l.setInputNormals(pcl::make_shared<pcl::PointCloud<TypeParam>>(3, 1)); });
  expect_nothing([](auto& l) { l.setIndices(pcl::make_shared<pcl::Indices>(1, -1)); });
  expect_nothing([](auto& l) { l.setIndices(pcl::make_shared<pcl::Indices>(1, 60)); });
}

TYPED_TEST(DominantDirectionLabelingTest, GettersAndTypes) {
  using Subject = typename TestFixture::Labeling;
  typename Subject::Ptr labeling(new Subject);
  typename Subject::ConstPtr constant = labeling;
  const Slice<TypeParam> slice = makeSlice<TypeParam>(4, 60, 1.0, 7);
  pcl::PCLBase<TypeParam>& base = *labeling;
  base.setInputCloud(slice.cloud);
  EXPECT_EQ(constant->getLambda(), 1.0);
  labeling->setLambda(0.5);
  EXPECT_EQ(labeling->getLambda(), 0.5);
  labeling->setKSearch(5);
  EXPECT_EQ(labeling->getKSearch(), 5);
  labeling->setCellSize(2.5);
  EXPECT_EQ(labeling->getCellSize(), 2.5);
  labeling->setPerPoint(true);
  EXPECT_TRUE(labeling->getPerPoint());
  labeling->setPerPoint(false);
  labeling->setDirections(regularDirections(4));
  EXPECT_EQ(labeling->getDirections(), regularDirections(4));
  labeling->setInputNormals(slice.cloud);
  EXPECT_EQ(labeling->getInputNormals(), slice.cloud);
  const typename pcl::search::Search<TypeParam>::Ptr tree(new pcl::search::BruteForce<TypeParam>);
  labeling->setSearchMethod(tree);
  EXPECT_EQ(labeling->getSearchMethod(), tree);
  EXPECT_EQ(TestFixture::run(*labeling).size(), 60U);
  EXPECT_EQ(labeling->getUsedCellSize(), 2.5);
  EXPECT_EQ(tree->getInputCloud()->size(), 60U);  // the given tree was used
  EXPECT_STREQ(Exposed<TypeParam>().getClassName(), "DominantDirectionLabeling");
}

TYPED_TEST(DominantDirectionLabelingTest, TurnedSliceAndUnchangedInput) {
  const Slice<TypeParam> slice = makeSlice<TypeParam>(5, 2000, 10.0, 8);
  const pcl::PointCloud<TypeParam> before = *slice.cloud;
  typename TestFixture::Labeling labeling;
  labeling.setInputCloud(slice.cloud);
  labeling.setDirections(regularDirections(5));
  const Labels labels = TestFixture::run(labeling);
  const double energy = labeling.getEnergy();
  const Eigen::AngleAxisf turn(0.4F, Eigen::Vector3f::UnitZ());
  auto moved = pcl::make_shared<pcl::PointCloud<TypeParam>>(*slice.cloud);
  for (std::size_t i = 0; i < moved->size(); ++i) {
    EXPECT_EQ((*slice.cloud)[i].getVector3fMap(), before[i].getVector3fMap());
    EXPECT_EQ((*slice.cloud)[i].getNormalVector3fMap(), before[i].getNormalVector3fMap());
    TypeParam& p = (*moved)[i];
    p.getVector3fMap() = turn * p.getVector3fMap() + Eigen::Vector3f(1000.0F, 500.0F, -200.0F);
    p.getNormalVector3fMap() = turn * p.getNormalVector3fMap();
  }
  Directions turned = regularDirections(5);
  for (Eigen::Vector3d& direction : turned) {
    direction = turn.cast<double>() * direction;
  }
  labeling.setDirections(turned);
  labeling.setInputCloud(moved);
  const Labels of_moved = TestFixture::run(labeling);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    equal += labels[i].label == of_moved[i].label ? 1U : 0U;
  }
  EXPECT_GT(equal, 1980U);  // the cells lie otherwise: a few points at corners may differ
  EXPECT_NEAR(labeling.getEnergy(), energy, 0.02 * energy);
}

using Labeling = storey::DominantDirectionLabeling<pcl::PointNormal>;

TEST(DominantDirectionLabeling, EnergyIsThatOfThePaper) {
  const auto slice = makeSlice<pcl::PointNormal>(6, 400, 20.0, 9);
  for (const double lambda : {0.05, 1.0}) {
    Labeling labeling;
    labeling.setInputCloud(slice.cloud);
    labeling.setDirections(regularDirections(6));
    labeling.setLambda(lambda);
    labeling.setKSearch(5);
    Labels labels;
    labeling.segment(labels);
    const double expected =
        energyByTheLetter(*slice.cloud, labels, regularDirections(6), lambda, 5);
    EXPECT_NEAR(labeling.getEnergy(), expected, 1e-9 * expected);
  }
}

TEST(DominantDirectionLabeling, WithoutLambdaTheNearestDirection) {
  const auto slice = makeSlice<pcl::PointNormal>(8, 1000, 30.0, 10);
  Labeling labeling;
  labeling.setInputCloud(slice.cloud);
  labeling.setDirections(regularDirections(8));
  labeling.setLambda(0.0);
  Labels labels;
  labeling.segment(labels);
  for (std::size_t i = 0; i < 1000; ++i) {
    const pcl::PointNormal& p = (*slice.cloud)[i];
    const double angle = std::atan2(p.normal_y, p.normal_x);
    EXPECT_EQ(labels[i].label, static_cast<std::uint32_t>(std::lround(angle / M_PI_4) + 8) % 8);
  }
}

TEST(DominantDirectionLabeling, CellsComeNearToPoints) {
  // raw normals at 36 degrees, the worst of what the stage before leaves, and smoothed ones
  for (const double noise : {10.6, 2.0}) {
    const auto slice = makeSlice<pcl::PointNormal>(10, 15000, noise, 11);
    Labeling labeling;
    labeling.setInputCloud(slice.cloud);
    labeling.setDirections(regularDirections(10));
    Labels labels;
    labeling.segment(labels);
    const double by_cells = labeling.getEnergy();
    labeling.setPerPoint(true);
    labeling.segment(labels);
    EXPECT_LE(by_cells, 1.01 * labeling.getEnergy());
  }
}

TEST(DominantDirectionLabeling, FacesOfAThinWallStayApart) {
  std::mt19937 random(12);
  std::uniform_real_distribution<float> unit(-5.0F, 5.0F);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (int i = 0; i < 1000; ++i) {
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    pcl::PointNormal p;
    p.getVector3fMap() = Eigen::Vector3f(0.3F * side, unit(random), 0.1F * unit(random));
    p.getNormalVector3fMap() = Eigen::Vector3f(side, 0.0F, 0.0F);
    cloud->push_back(p);
  }
  Labeling labeling;
  labeling.setInputCloud(cloud);
  labeling.setDirections(regularDirections(4));
  labeling.setCellSize(5.0);  // both faces in one cell
  // |l - n|^2 = 4 on the wrong face, against 8 neighbours that pay twice at most
  labeling.setLambda(0.2);
  Labels labels;
  labeling.segment(labels);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(labels[i].label, i % 2 == 0 ? 0U : 2U);
  }
}

TEST(DominantDirectionLabeling, ObjectsInThreadsDoNotDisturbEachOther) {
  const auto slice = makeSlice<pcl::PointNormal>(7, 4000, 12.0, 13);
  std::vector<Labels> results(4);
  std::vector<std::thread> threads;
  for (Labels& result : results) {
    threads.emplace_back([&slice, &result] {
      Labeling labeling;
      labeling.setInputCloud(slice.cloud);
      labeling.setDirections(regularDirections(7));
      labeling.segment(result);
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const Labels& result : results) {
    ASSERT_EQ(result.size(), 4000U);
    for (std::size_t i = 0; i < 4000; ++i) {
      EXPECT_EQ(result[i].label, results[0][i].label);
    }
  }
}

TEST(DominantDirectionLabeling, SeparateCloudOfNormals) {
  const auto slice = makeSlice<pcl::PointNormal>(4, 100, 1.0, 14);
  auto positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  for (const pcl::PointNormal& p : *slice.cloud) {
    positions->push_back(pcl::PointXYZ(p.x, p.y, p.z));
    normals->push_back(pcl::Normal(p.normal_x, p.normal_y, p.normal_z));
  }
  storey::DominantDirectionLabeling<pcl::PointXYZ, pcl::Normal> labeling;
  labeling.setInputCloud(positions);
  labeling.setDirections(regularDirections(4));
  Labels labels;
  labeling.segment(labels);
  EXPECT_TRUE(labels.empty());  // no normals
  labeling.setInputNormals(normals);
  labeling.setLambda(0.0);
  labeling.segment(labels);
  EXPECT_EQ(shareRight(labels, slice.truth), 1.0);
}

TEST(DominantDirectionLabeling, AMillionCopiesAndFarawayPoints) {
  auto cloud = makeSlice<pcl::PointNormal>(4, 500, 1.0, 15).cloud;
  cloud->resize(1000500, (*cloud)[0]);
  cloud->push_back((*cloud)[1]);
  cloud->back().x = 1e12F;
  Labeling labeling;
  labeling.setInputCloud(cloud);
  labeling.setDirections(regularDirections(4));
  Labels labels;
  labeling.segment(labels);
  ASSERT_EQ(labels.size(), 1000501U);
  for (std::size_t i = 500; i < 1000500; ++i) {
    ASSERT_EQ(labels[i].label, labels[0].label);
  }
}

}  // namespace
