// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>
#include <storey/segmentation/detail/region_components.h>
#include <storey/segmentation/edge_region_growing.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <pcl/segmentation/impl/conditional_euclidean_clustering.hpp>
#include <random>
#include <vector>

#include "../point_types.h"

namespace {

using Regions = std::vector<pcl::PointIndices>;
using Positions = std::vector<Eigen::Vector3d>;
using Numbers = std::vector<std::uint32_t>;
using storey::detail::labeledComponents;

// --- the kernel -----------------------------------------------------------------------------

// All pairs, again and again, until no number changes.
std::vector<std::size_t> componentsOfAllPairs(const Positions& points, const Numbers& labels,
                                              double radius) {
  std::vector<std::size_t> component(points.size());
  std::iota(component.begin(), component.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        const bool linked =
            labels[i] == labels[j] && (points[i] - points[j]).squaredNorm() <= radius * radius;
        if (linked && component[i] > component[j]) {
          component[i] = component[j];
          changed = true;
        }
      }
    }
  }
  return component;
}

TEST(LabeledComponents, EqualAllPairs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  for (int round = 0; round < 60; ++round) {
    const bool flat = round % 2 == 0;
    Positions points;
    Numbers labels;
    for (int i = 0; i < 300; ++i) {
      points.emplace_back(unit(random), unit(random), flat ? 0.0F : unit(random));
      labels.push_back(static_cast<std::uint32_t>(i % 3));
    }
    // around the radius at which 100 points of one label in the square or cube just hang together
    for (const double radius : {0.05, 0.12, 0.2, 0.4}) {
      EXPECT_EQ(labeledComponents(points, labels, radius),
                componentsOfAllPairs(points, labels, radius));
    }
  }
}

TEST(LabeledComponents, DistanceEqualToTheRadiusLinks) {
  const Numbers labels(3, 0);
  const Positions row = {{0.0, 0.0, 0.0}, {0.5, 0.0, 0.0}, {1.0 + 1e-9, 0.0, 0.0}};
  EXPECT_EQ(labeledComponents(row, labels, 0.5), (std::vector<std::size_t>{0, 0, 2}));
}

TEST(LabeledComponents, DenseCloudsApartByTheRadius) {
  // two discs of 100,000 points each, their nearest points a bit more, or a bit less, than the
  // radius apart: all pairs would take 10^10 steps
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Positions points = {{-0.6, 0.0, 0.0}, {0.6, 0.0, 0.0}};
  for (int i = 0; i < 200000; ++i) {
    const double r = 0.4 * std::sqrt(unit(random));
    const double angle = 2.0 * M_PI * unit(random);
    points.emplace_back((i % 2 == 0 ? -1.0 : 1.0) + r * std::cos(angle), r * std::sin(angle), 0.0);
  }
  const Numbers labels(points.size(), 7);
  const auto apart = labeledComponents(points, labels, 1.2 - 1e-9);
  const auto linked = labeledComponents(points, labels, 1.2 + 1e-9);
  EXPECT_EQ(std::count(apart.begin(), apart.end(), 0U), 100001);
  EXPECT_EQ(std::count(apart.begin(), apart.end(), 1U), 100001);
  EXPECT_EQ(std::count(linked.begin(), linked.end(), 0U), 200002);
}

TEST(LabeledComponents, FarAwayAndTinyRadius) {
  const Positions points = {{1e7, 1e7, 0.0},
                            {1e7 + 1.0, 1e7, 0.0},
                            {-1e18, 0.0, 0.0},
                            {1e18, 0.0, 0.0},
                            {1e18, 0.0, 0.0}};
  const Numbers labels(5, 0);
  EXPECT_EQ(labeledComponents(points, labels, 1.5), (std::vector<std::size_t>{0, 0, 2, 3, 3}));
  EXPECT_EQ(labeledComponents(points, labels, 1e-30), (std::vector<std::size_t>{0, 1, 2, 3, 3}));
}

// --- the class ------------------------------------------------------------------------------

template <typename PointT>
struct Exposed : storey::EdgeRegionGrowing<PointT> {
  using storey::EdgeRegionGrowing<PointT>::getClassName;
};

pcl::PointCloud<pcl::Label>::Ptr makeLabels(const Numbers& numbers) {
  auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
  for (const std::uint32_t number : numbers) {
    pcl::Label label;
    label.label = number;
    labels->push_back(label);
  }
  return labels;
}

template <typename PointT>
class EdgeRegionGrowingTest : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Growing = storey::EdgeRegionGrowing<PointT>;

  // Points at random, and a label for each.
  void SetUp() override {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0F, 10.0F);
    cloud_ = pcl::make_shared<Cloud>();
    for (int i = 0; i < 400; ++i) {
      PointT p;
      p.getVector3fMap() = Eigen::Vector3f(unit(random), unit(random), 0.05F * unit(random));
      cloud_->push_back(p);
      numbers_.push_back(static_cast<std::uint32_t>(random() % 3));
    }
    cloud_->header.frame_id = "house";
    cloud_->header.seq = 5;
    growing_.setInputCloud(cloud_);
    growing_.setLabels(makeLabels(numbers_));
    growing_.setRadius(0.9);
    growing_.setMinRegionSize(1);
  }

  Regions run() {
    Regions regions(2);  // what was there before must go
    growing_.extract(regions);
    return regions;
  }

  typename Cloud::Ptr cloud_;
  Numbers numbers_;
  Growing growing_;
};
TYPED_TEST_SUITE(EdgeRegionGrowingTest, OrientedPointTypes);

TYPED_TEST(EdgeRegionGrowingTest, EqualsConditionalEuclideanClustering) {
  const Regions regions = this->run();
  // PCL's class takes no labels: they go into a field
  auto labeled = pcl::make_shared<pcl::PointCloud<pcl::PointXYZL>>();
  for (std::size_t i = 0; i < this->cloud_->size(); ++i) {
    pcl::PointXYZL p;
    p.getVector3fMap() = (*this->cloud_)[i].getVector3fMap();
    p.label = this->numbers_[i];
    labeled->push_back(p);
  }
  pcl::ConditionalEuclideanClustering<pcl::PointXYZL> reference;
  reference.setInputCloud(labeled);
  reference.setClusterTolerance(0.9F);
  const std::function<bool(const pcl::PointXYZL&, const pcl::PointXYZL&, float)> same_label =
      [](const auto& a, const auto& b, float) { return a.label == b.label; };
  reference.setConditionFunction(same_label);
  Regions expected;
  reference.segment(expected);
  for (pcl::PointIndices& region : expected) {
    std::sort(region.indices.begin(), region.indices.end());
  }
  std::sort(expected.begin(), expected.end(),
            [](const pcl::PointIndices& a, const pcl::PointIndices& b) {
              return a.indices.size() != b.indices.size() ? a.indices.size() > b.indices.size()
                                                          : a.indices < b.indices;
            });
  ASSERT_GT(regions.size(), 5U);
  ASSERT_EQ(regions.size(), expected.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    EXPECT_EQ(regions[r].indices, expected[r].indices);
    EXPECT_EQ(regions[r].header.frame_id, "house");
    EXPECT_EQ(regions[r].header.seq, 5U);
    for (const pcl::index_t i : regions[r].indices) {
      EXPECT_EQ(this->growing_.getRegionLabels()[r], this->numbers_[static_cast<std::size_t>(i)]);
    }
  }
  EXPECT_EQ(this->growing_.getUsedRadius(), 0.9);
}

TYPED_TEST(EdgeRegionGrowingTest, SubsetInAnyOrderIsTheSubCloud) {
  std::mt19937 random(4);
  pcl::Indices subset(400);
  std::iota(subset.begin(), subset.end(), 0);
  std::shuffle(subset.begin(), subset.end(), random);
  subset.resize(300);
  Numbers of_subset;
  for (const pcl::index_t i : subset) {
    of_subset.push_back(this->numbers_[static_cast<std::size_t>(i)]);
  }
  this->growing_.setIndices(pcl::make_shared<pcl::Indices>(subset));
  this->growing_.setLabels(makeLabels(of_subset));
  this->growing_.setRadius(0.0);
  const Regions regions = this->run();
  const Numbers labels = this->growing_.getRegionLabels();

  std::sort(subset.begin(), subset.end());
  Numbers of_sub_cloud;
  for (const pcl::index_t i : subset) {
    of_sub_cloud.push_back(this->numbers_[static_cast<std::size_t>(i)]);
  }
  storey::EdgeRegionGrowing<TypeParam> other;
  other.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>(*this->cloud_, subset));
  other.setLabels(makeLabels(of_sub_cloud));
  other.setMinRegionSize(1);
  Regions expected;
  other.extract(expected);
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(regions.size(), expected.size());
  EXPECT_EQ(labels, other.getRegionLabels());
  EXPECT_EQ(this->growing_.getUsedRadius(), other.getUsedRadius());
  for (std::size_t r = 0; r < expected.size(); ++r) {
    for (pcl::index_t& i : expected[r].indices) {
      i = subset[static_cast<std::size_t>(i)];
    }
    EXPECT_EQ(regions[r].indices, expected[r].indices);
  }
}

TYPED_TEST(EdgeRegionGrowingTest, InvalidPointsAreInNoRegion) {
  (*this->cloud_)[10].x = std::numeric_limits<float>::quiet_NaN();
  (*this->cloud_)[11].z = std::numeric_limits<float>::infinity();
  this->numbers_[12] = storey::kUnlabeled;
  this->growing_.setLabels(makeLabels(this->numbers_));
  for (const double radius : {0.0, 0.9}) {
    this->growing_.setRadius(radius);
    std::vector<int> seen(400, 0);
    for (const pcl::PointIndices& region : this->run()) {
      for (const pcl::index_t i : region.indices) {
        ++seen[static_cast<std::size_t>(i)];
      }
    }
    for (std::size_t i = 0; i < 400; ++i) {
      EXPECT_EQ(seen[i], i < 10 || i > 12 ? 1 : 0);
    }
  }
}

TYPED_TEST(EdgeRegionGrowingTest, RegionsBySizeAndNoneTooSmall) {
  const Regions all = this->run();
  for (std::size_t r = 1; r < all.size(); ++r) {
    const std::size_t before = all[r - 1].indices.size();
    EXPECT_GE(before, all[r].indices.size());
    EXPECT_TRUE(before > all[r].indices.size() ||
                all[r - 1].indices.front() < all[r].indices.front());
  }
  this->growing_.setMinRegionSize(5);
  const Regions large = this->run();
  ASSERT_LT(large.size(), all.size());
  EXPECT_EQ(this->growing_.getRegionLabels().size(), large.size());
  for (std::size_t r = 0; r < all.size(); ++r) {
    EXPECT_EQ(all[r].indices.size() >= 5, r < large.size());
  }
}

TYPED_TEST(EdgeRegionGrowingTest, NothingInNothingOut) {
  storey::EdgeRegionGrowing<TypeParam> growing;
  Regions regions(2);
  growing.extract(regions);  // no input
  EXPECT_TRUE(regions.empty());
  growing.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  growing.setLabels(makeLabels({}));
  growing.extract(regions);
  EXPECT_TRUE(regions.empty());
  EXPECT_FALSE(this->run().empty());
  this->growing_.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());  // another size
  this->growing_.setLabels(makeLabels({}));
  EXPECT_TRUE(this->run().empty());
  EXPECT_TRUE(this->growing_.getRegionLabels().empty());
}

TYPED_TEST(EdgeRegionGrowingTest, BadParametersGiveNothing) {
  ASSERT_FALSE(this->run().empty());
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    this->growing_.setRadius(bad);
    EXPECT_TRUE(this->run().empty());
  }
  this->growing_.setRadius(1.0);
  this->growing_.setLabels(makeLabels({1, 2, 3}));
  EXPECT_TRUE(this->run().empty());
  this->growing_.setLabels(nullptr);
  EXPECT_TRUE(this->run().empty());
  this->growing_.setLabels(makeLabels({1, 2}));
  for (const pcl::index_t bad : {-1, 400}) {
    this->growing_.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, bad}));
    EXPECT_TRUE(this->run().empty());
  }
}

TYPED_TEST(EdgeRegionGrowingTest, GettersAndTypes) {
  using Subject = storey::EdgeRegionGrowing<TypeParam>;
  typename Subject::Ptr growing(new Subject);
  typename Subject::ConstPtr constant = growing;
  pcl::PCLBase<TypeParam>& base = *growing;
  base.setInputCloud(this->cloud_);
  EXPECT_EQ(constant->getRadius(), 0.0);
  EXPECT_EQ(constant->getMinRegionSize(), 10U);
  growing->setRadius(0.4);
  EXPECT_EQ(growing->getRadius(), 0.4);
  growing->setMinRegionSize(4);
  EXPECT_EQ(growing->getMinRegionSize(), 4U);
  const auto labels = makeLabels(this->numbers_);
  growing->setLabels(labels);
  EXPECT_EQ(growing->getLabels(), labels);
  EXPECT_STREQ(Exposed<TypeParam>().getClassName(), "EdgeRegionGrowing");
}

TYPED_TEST(EdgeRegionGrowingTest, InputIsUnchangedAndShiftDoesNotMatter) {
  const pcl::PointCloud<TypeParam> before = *this->cloud_;
  const Regions here = this->run();
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ((*this->cloud_)[i].getVector3fMap(), before[i].getVector3fMap());
  }
  for (TypeParam& p : *this->cloud_) {  // 1024 leaves the grid of floats at 2^-13
    p.getVector3fMap() += Eigen::Vector3f(1024.0F, -1024.0F, 0.0F);
  }
  const Regions there = this->run();
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t r = 0; r < here.size(); ++r) {
    EXPECT_EQ(here[r].indices, there[r].indices);
  }
}

TEST(EdgeRegionGrowing, DerivedRadiusKeepsWallsWholeAndApart) {
  // the long sides of a rectangle, of one label, 3 apart, with 2000 points of noise 0.1 each
  std::mt19937 random(5);
  std::uniform_real_distribution<float> along(0.0F, 20.0F);
  std::normal_distribution<float> noise(0.0F, 0.1F);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (int i = 0; i < 4000; ++i) {
    pcl::PointNormal p;
    p.getVector3fMap() =
        Eigen::Vector3f(along(random), 3.0F * static_cast<float>(i % 2) + noise(random), 0.0F);
    cloud->push_back(p);
  }
  storey::EdgeRegionGrowing<pcl::PointNormal> growing;
  growing.setInputCloud(cloud);
  growing.setLabels(makeLabels(Numbers(4000, 2)));
  Regions regions;
  growing.extract(regions);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_GE(regions[1].indices.size(), 1998U);  // a single point may lie 4 deviations off
  EXPECT_GT(growing.getUsedRadius(), 0.0);
}

TEST(EdgeRegionGrowing, AMillionCopiesOfAPoint) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  cloud->resize(1000000);
  storey::EdgeRegionGrowing<pcl::PointNormal> growing;
  growing.setInputCloud(cloud);
  growing.setLabels(makeLabels(Numbers(1000000, 0)));
  for (const double radius : {0.0, 0.5}) {
    growing.setRadius(radius);
    Regions regions;
    growing.extract(regions);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].indices.size(), 1000000U);
  }
}

}  // namespace
