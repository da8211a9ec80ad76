// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/gravity_slicing.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "../point_types.h"

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
PointT makePoint(double x, double y, double z, double nx, double ny, double nz) {
  PointT p;
  p.getVector3fMap() = Eigen::Vector3d(x, y, z).cast<float>();
  p.getNormalVector3fMap() = Eigen::Vector3d(nx, ny, nz).cast<float>();
  p.curvature = 0.25f;
  return p;
}

// Two walls of 20 x 30 and a flat roof on them, noise 0.1 on positions. z starts at `bottom`.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeHouse(double bottom = 0.0) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::normal_distribution<double> e(0.0, 0.1);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < 6000; ++i) {
    const double z = bottom + 30 * u(random);
    cloud->push_back(makePoint<PointT>(20 * u(random), e(random), z, 0, -1, 0));
    cloud->push_back(makePoint<PointT>(e(random), 20 * u(random), z, -1, 0, 0));
    cloud->push_back(
        makePoint<PointT>(20 * u(random), 20 * u(random), bottom + 30 + e(random), 0, 0, 1));
  }
  cloud->header.frame_id = "site";
  return cloud;
}

template <typename PointT>
class GravitySlicingOf : public testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Slicing = storey::GravitySlicing<PointT>;
  using Slices = std::vector<pcl::PointIndices>;

  static Slices slice(const typename Cloud::ConstPtr& cloud, Slicing& slicing) {
    Slices slices;
    slicing.setInputCloud(cloud);
    slicing.extract(slices);
    return slices;
  }
};
TYPED_TEST_SUITE(GravitySlicingOf, OrientedPointTypes);

TYPED_TEST(GravitySlicingOf, SlicesAreStackedAndHoldTheirPoints) {
  const auto cloud = makeHouse<TypeParam>(-7.0);
  typename TestFixture::Slicing slicing;
  slicing.setSliceThickness(1.25);
  const auto slices = this->slice(cloud, slicing);
  const auto& ranges = slicing.getSliceRanges();
  ASSERT_EQ(slices.size(), 24u);  // 30 / 1.25, the walls' points reach to within 0.01 of both ends
  ASSERT_EQ(ranges.size(), 24u);
  EXPECT_EQ(slicing.getSliceThickness(), 1.25);
  EXPECT_NEAR(ranges[0].first, -7.0, 0.02);
  std::size_t num_points = 0;
  for (std::size_t s = 0; s < 24; ++s) {
    EXPECT_NEAR(ranges[s].second - ranges[s].first, 1.25, 1e-9);
    EXPECT_TRUE(s == 0 || ranges[s].first == ranges[s - 1].second);
    EXPECT_TRUE(std::is_sorted(slices[s].indices.begin(), slices[s].indices.end()));
    EXPECT_EQ(slices[s].header.frame_id, "site");
    for (const pcl::index_t i : slices[s].indices) {
      const TypeParam& p = (*cloud)[static_cast<std::size_t>(i)];
      EXPECT_TRUE(ranges[s].first <= p.z && p.z < ranges[s].second);
      EXPECT_EQ(p.normal_z, 0.0f) << "a roof's point";
    }
    num_points += slices[s].indices.size();
  }
  EXPECT_EQ(num_points, 12000u);
}

// Density per wall area, noise and extent by the house's making; the formula by hand.
TYPED_TEST(GravitySlicingOf, DerivesItsThickness) {
  typename TestFixture::Slicing slicing;
  const auto slices = this->slice(makeHouse<TypeParam>(), slicing);
  const double extent = 0.98 * std::sqrt(20.0 * 20 + 20 * 20 + 30 * 30);
  const double expected = std::max(10 * 0.1, 30 / (12000.0 / (2 * 20 * 30) * extent / 50));
  EXPECT_GE(slicing.getSliceThickness(), 0.9 * expected);
  EXPECT_LE(slicing.getSliceThickness(), 1.2 * expected);
  EXPECT_NEAR(static_cast<double>(slices.size()) * slicing.getSliceThickness(), 30.0, 0.05);
}

TYPED_TEST(GravitySlicingOf, ThicknessFollowsTheUnit) {
  const auto metres = makeHouse<TypeParam>();
  auto millimetres = pcl::make_shared<typename TestFixture::Cloud>(*metres);
  for (TypeParam& p : *millimetres) {
    p.getVector3fMap() *= 1024.0f;  // exact
  }
  typename TestFixture::Slicing a;
  typename TestFixture::Slicing b;
  const auto in_metres = this->slice(metres, a);
  const auto in_millimetres = this->slice(millimetres, b);
  EXPECT_DOUBLE_EQ(b.getSliceThickness(), 1024 * a.getSliceThickness());
  ASSERT_EQ(in_metres.size(), in_millimetres.size());
  for (std::size_t s = 0; s < in_metres.size(); ++s) {
    EXPECT_EQ(in_metres[s].indices, in_millimetres[s].indices);
  }
}

TYPED_TEST(GravitySlicingOf, TurningAndShiftingThePlanChangesNothing) {
  const auto cloud = makeHouse<TypeParam>();
  auto moved = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  for (TypeParam& p : *moved) {
    const float x = p.x;
    p.x = 0.8f * x - 0.6f * p.y + 1000.0f;
    p.y = 0.6f * x + 0.8f * p.y - 1000.0f;
    const float nx = p.normal_x;
    p.normal_x = 0.8f * nx - 0.6f * p.normal_y;
    p.normal_y = 0.6f * nx + 0.8f * p.normal_y;
  }
  typename TestFixture::Slicing a;
  typename TestFixture::Slicing b;
  a.setSliceThickness(2.0);
  b.setSliceThickness(2.0);
  const auto expected = this->slice(cloud, a);
  const auto found = this->slice(moved, b);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t s = 0; s < found.size(); ++s) {
    EXPECT_EQ(found[s].indices, expected[s].indices);
  }
}

TYPED_TEST(GravitySlicingOf, EmptySlicesKeepTheirPlace) {
  auto cloud = pcl::make_shared<typename TestFixture::Cloud>();
  for (int i = 0; i < 10; ++i) {
    cloud->push_back(makePoint<TypeParam>(i, 0, 0.05 * i, 0, 1, 0));
    cloud->push_back(makePoint<TypeParam>(i, 0, 9.5 + 0.05 * i, 0, 1, 0));
  }
  typename TestFixture::Slicing slicing;
  slicing.setSliceThickness(1.0);
  const auto slices = this->slice(cloud, slicing);
  ASSERT_EQ(slices.size(), 10u);
  EXPECT_EQ(slices[0].indices.size(), 10u);
  EXPECT_EQ(slices[9].indices.size(), 10u);
  for (std::size_t s = 1; s < 9; ++s) {
    EXPECT_TRUE(slices[s].indices.empty());
  }
}

TYPED_TEST(GravitySlicingOf, TiltAndMissingNormalsDecideWhatIsAWall) {
  auto cloud = pcl::make_shared<typename TestFixture::Cloud>();
  const auto leaning = [](double degrees, double length) {
    const double a = degrees * M_PI / 180;
    return makePoint<TypeParam>(0, 0, 1, length * std::cos(a), 0, length * std::sin(a));
  };
  cloud->push_back(leaning(0, 1));
  cloud->push_back(leaning(34, 1));
  cloud->push_back(leaning(36, 1));
  cloud->push_back(leaning(-34, 7));  // the length does not matter
  cloud->push_back(leaning(-90, 1));
  cloud->push_back(makePoint<TypeParam>(0, 0, 1, 0, 0, 0));
  cloud->push_back(makePoint<TypeParam>(0, 0, 1, kNaN, 0, 0));
  cloud->push_back(makePoint<TypeParam>(kNaN, 0, 1, 1, 0, 0));
  cloud->push_back(makePoint<TypeParam>(0, 0, kNaN, 1, 0, 0));
  typename TestFixture::Slicing slicing;
  auto slices = this->slice(cloud, slicing);
  ASSERT_EQ(slices.size(), 1u);
  EXPECT_EQ(slices[0].indices, (pcl::Indices{0, 1, 3}));
  slicing.setKeepPointsWithoutNormals(true);
  slices = this->slice(cloud, slicing);
  EXPECT_EQ(slices.at(0).indices, (pcl::Indices{0, 1, 3, 5, 6}));
  slicing.setKeepPointsWithoutNormals(false);
  slicing.setMaxTilt(40 * M_PI / 180);
  slices = this->slice(cloud, slicing);
  EXPECT_EQ(slices.at(0).indices, (pcl::Indices{0, 1, 2, 3}));
}

TYPED_TEST(GravitySlicingOf, GhostsAddNoSlices) {
  auto cloud = makeHouse<TypeParam>();
  for (int i = 0; i < 5; ++i) {
    cloud->push_back(makePoint<TypeParam>(0, 0, -14 - i, 1, 0, 0));
    cloud->push_back(makePoint<TypeParam>(0, 0, 1e7 * (i + 1), 1, 0, 0));
  }
  typename TestFixture::Slicing slicing;
  slicing.setSliceThickness(1.0);
  const auto slices = this->slice(cloud, slicing);
  EXPECT_LE(slices.size(), 33u);  // 30, and a margin of 5 % at both ends
  std::set<pcl::index_t> seen;
  for (const auto& slice : slices) {
    seen.insert(slice.indices.begin(), slice.indices.end());
  }
  EXPECT_EQ(seen.size(), 12000u);
  EXPECT_LT(*seen.rbegin(), 18000);
}

TYPED_TEST(GravitySlicingOf, IndicesSelectAsExtractionWould) {
  const auto cloud = makeHouse<TypeParam>();
  pcl::Indices some(cloud->size());
  std::iota(some.begin(), some.end(), 0);
  std::shuffle(some.begin(), some.end(), std::mt19937(2));
  some.resize(9000);
  typename TestFixture::Slicing slicing;
  slicing.setIndices(pcl::make_shared<pcl::Indices>(some));
  const auto found = this->slice(cloud, slicing);

  std::sort(some.begin(), some.end());
  const auto extracted = pcl::make_shared<typename TestFixture::Cloud>(*cloud, some);
  typename TestFixture::Slicing plain;
  const auto expected = this->slice(extracted, plain);
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(plain.getSliceRanges(), slicing.getSliceRanges());
  for (std::size_t s = 0; s < found.size(); ++s) {
    pcl::Indices mapped;
    for (const pcl::index_t i : expected[s].indices) {
      mapped.push_back(some[static_cast<std::size_t>(i)]);
    }
    EXPECT_EQ(found[s].indices, mapped);
  }
  typename TestFixture::Slicing outside;
  outside.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 18000}));
  EXPECT_TRUE(this->slice(cloud, outside).empty());
}

TYPED_TEST(GravitySlicingOf, DegenerateCloudsGiveNoOrOneSlice) {
  typename TestFixture::Slicing slicing;
  typename TestFixture::Slices slices(3);
  slicing.extract(slices);
  EXPECT_TRUE(slices.empty()) << "no input";
  EXPECT_TRUE(this->slice(pcl::make_shared<typename TestFixture::Cloud>(), slicing).empty());
  auto level = pcl::make_shared<typename TestFixture::Cloud>();
  level->assign(1000, makePoint<TypeParam>(1, 2, 3, 1, 0, 0));
  slices = this->slice(level, slicing);
  ASSERT_EQ(slices.size(), 1u);
  EXPECT_EQ(slices[0].indices.size(), 1000u);
  EXPECT_EQ(slicing.getSliceThickness(), 0.0);
  EXPECT_EQ(slicing.getSliceRanges()[0], (std::pair<double, double>(3.0, 3.0)));
  auto roof = pcl::make_shared<typename TestFixture::Cloud>();
  roof->assign(10, makePoint<TypeParam>(1, 2, 3, 0, 0, 1));
  EXPECT_TRUE(this->slice(roof, slicing).empty());
  EXPECT_TRUE(slicing.getSliceRanges().empty());
  EXPECT_FALSE(this->slice(makeHouse<TypeParam>(), slicing).empty()) << "a new input";
}

TYPED_TEST(GravitySlicingOf, RefusesBadParameters) {
  const auto cloud = makeHouse<TypeParam>();
  const auto count = [&](double thickness, double tilt) {
    typename TestFixture::Slicing slicing;
    slicing.setSliceThickness(thickness);
    slicing.setMaxTilt(tilt);
    EXPECT_TRUE(slicing.getSliceThickness() == thickness || std::isnan(thickness));
    EXPECT_TRUE(slicing.getMaxTilt() == tilt || std::isnan(tilt));
    return this->slice(cloud, slicing).size();
  };
  EXPECT_EQ(count(-1.0, 0.6), 0u);
  EXPECT_EQ(count(std::nan(""), 0.6), 0u);
  EXPECT_EQ(count(std::numeric_limits<double>::infinity(), 0.6), 0u);
  EXPECT_EQ(count(1e-6, 0.6), 0u) << "thirty million slices";
  EXPECT_EQ(count(1e-320, 0.6), 0u);
  EXPECT_EQ(count(1.0, 0.0), 0u);
  EXPECT_EQ(count(1.0, 1.6), 0u);
  EXPECT_EQ(count(1.0, std::nan("")), 0u);
  EXPECT_EQ(count(1.0, M_PI_2), 31u) << "with the roof's points, noise above 30";
}

TYPED_TEST(GravitySlicingOf, IsAPclClass) {
  typename TestFixture::Slicing::Ptr slicing(new typename TestFixture::Slicing);
  const typename TestFixture::Slicing::ConstPtr read_only = slicing;
  pcl::PCLBase<TypeParam>& base = *slicing;
  const auto cloud = makeHouse<TypeParam>();
  const typename TestFixture::Cloud before = *cloud;
  base.setInputCloud(cloud);
  typename TestFixture::Slices slices;
  slicing->extract(slices);
  EXPECT_EQ(read_only->getSliceRanges().size(), slices.size());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), cloud->begin(),
                         [](const TypeParam& a, const TypeParam& b) {
                           return a.getVector3fMap() == b.getVector3fMap();
                         }))
      << "the input is const";
}

TYPED_TEST(GravitySlicingOf, ProjectionFlattensPositionsAndNormals) {
  typename TestFixture::Cloud cloud;
  cloud.push_back(makePoint<TypeParam>(1, 2, 3, 0.6, 0, 0.8));
  cloud.push_back(makePoint<TypeParam>(4, 5, 6, 0, 0, 1));
  cloud.push_back(makePoint<TypeParam>(7, 8, 9, -3, 4, 1));
  cloud.push_back(makePoint<TypeParam>(7, 8, 9, kNaN, 4, 1));
  cloud.header.frame_id = "site";
  pcl::PointIndices slice;
  slice.indices = {2, 0, 1, 3};
  typename TestFixture::Cloud flat;
  storey::projectSlice(cloud, slice, 2.5, flat);
  ASSERT_EQ(flat.size(), 4u);
  EXPECT_EQ(flat.header.frame_id, "site");
  EXPECT_TRUE(flat.is_dense);
  EXPECT_EQ(flat[0].getVector3fMap(), Eigen::Vector3f(7, 8, 2.5f));
  EXPECT_TRUE(flat[0].getNormalVector3fMap().isApprox(Eigen::Vector3f(-0.6f, 0.8f, 0)));
  EXPECT_EQ(flat[1].getNormalVector3fMap(), Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(flat[1].curvature, 0.25f);
  for (const std::size_t i : {2, 3}) {
    EXPECT_TRUE(flat[i].getNormalVector3fMap().array().isNaN().all());
  }
  storey::projectSlice(cloud, slice, 0.0, cloud);
  EXPECT_EQ(cloud.size(), 4u) << "in place";
  slice.indices = {4};
  storey::projectSlice(cloud, slice, 0.0, flat);
  EXPECT_TRUE(flat.empty()) << "index outside the cloud";
}

}  // namespace
