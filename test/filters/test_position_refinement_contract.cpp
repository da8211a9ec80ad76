// SPDX-License-Identifier: BSD-3-Clause
// AnisotropicPositionRefinement as a PCL filter: indices, invalid points, errors, threads, motions.
#include <algorithm>
#include <cmath>

#include "position_refinement_clouds.h"

namespace {

template <typename PointT>
using PositionRefinementContractOf = PositionRefinementOf<PointT>;
TYPED_TEST_SUITE(PositionRefinementContractOf, OrientedPointTypes);

TYPED_TEST(PositionRefinementContractOf, IndicesChooseTheOutputOnly) {
  const auto cloud = makeCorner<TypeParam>();
  typename TestFixture::Refinement refinement;
  const auto full = this->refine(cloud, refinement);
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{700, 3, 999, 0});
  refinement.setIndices(indices);
  const auto some = this->refine(cloud, refinement);
  ASSERT_EQ(some.size(), 4u);
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(some[m].getVector3fMap(),
              full[static_cast<std::size_t>((*indices)[m])].getVector3fMap());
  }
  indices->push_back(1000);
  EXPECT_TRUE(this->refine(cloud, refinement).empty());
}

TYPED_TEST(PositionRefinementContractOf, InvalidPointsStayAndDisturbNobody) {
  const auto cloud = makeCorner<TypeParam>();
  typename TestFixture::Refinement refinement;
  const auto expected = this->refine(cloud, refinement);
  auto spoiled = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  spoiled->push_back(makePoint<TypeParam>(kNaN, 0, 1, 0));
  spoiled->push_back(makePoint<TypeParam>(1, 1e30, 1, 0));
  spoiled->push_back(makePoint<TypeParam>(1, 0.1, kNaN, 0));
  spoiled->push_back(makePoint<TypeParam>(1, 0.1, 0, 0));
  spoiled->is_dense = true;  // a lie
  auto found = this->refine(spoiled, refinement);
  ASSERT_EQ(found.size(), 1004u);
  EXPECT_TRUE(std::isnan(found[1000].x));
  EXPECT_EQ(found[1001].y, 1e30f);
  EXPECT_EQ(found[1002].y, 0.1f);
  EXPECT_EQ(found[1003].y, 0.1f);
  found.erase(found.begin() + 1000, found.end());
  this->expectSame(found, expected);
}

TYPED_TEST(PositionRefinementContractOf, LengthOfNormalsDoesNotMatter) {
  const auto cloud = makeCorner<TypeParam>();
  auto scaled = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  for (TypeParam& p : *scaled) {
    p.getNormalVector3fMap() *= 4.0f;
  }
  typename TestFixture::Refinement refinement;
  this->expectSame(this->refine(scaled, refinement), this->refine(cloud, refinement));
}

TYPED_TEST(PositionRefinementContractOf, ManyCopiesMoveAlikeAndCostLittle) {
  auto cloud = makeLine<TypeParam>(200);
  typename TestFixture::Refinement refinement;
  refinement.setSigmaP(0.2);
  const auto expected = this->refine(cloud, refinement);
  cloud->insert(cloud->end(), 300000, (*cloud)[100]);
  const auto found = this->refine(cloud, refinement);
  for (std::size_t i = 0; i < cloud->size(); i = i < 200 ? i + 1 : i + 997) {
    EXPECT_EQ(found[i].y, expected[i < 200 ? i : 100].y);
  }
}

TYPED_TEST(PositionRefinementContractOf, ThreadsDoNotMatter) {
  const auto cloud = makeLine<TypeParam>(60000);  // one region above the size for several threads
  typename TestFixture::Refinement one;
  typename TestFixture::Refinement four;
  one.setNumberOfThreads(1);
  four.setNumberOfThreads(4);
  EXPECT_EQ(four.getNumberOfThreads(), 4u);
  this->expectSame(this->refine(cloud, one), this->refine(cloud, four));
  const auto corner = makeCorner<TypeParam>();
  one.setRegions(cornerRegions());
  four.setRegions(cornerRegions());
  this->expectSame(this->refine(corner, one), this->refine(corner, four));
}

// Floats near 1000 are multiples of 6e-5.
TYPED_TEST(PositionRefinementContractOf, FollowsRigidMotions) {
  const auto cloud = makeCorner<TypeParam>();
  const Eigen::AngleAxisf turn(0.7f, Eigen::Vector3f(1, 2, 3).normalized());
  const auto move = [&turn](TypeParam& p) {
    p.getVector3fMap() = turn * p.getVector3fMap() + Eigen::Vector3f(1000, -1000, 1000);
    p.getNormalVector3fMap() = turn * p.getNormalVector3fMap();
  };
  auto moved = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  std::for_each(moved->begin(), moved->end(), move);
  typename TestFixture::Refinement refinement;
  refinement.setRegions(cornerRegions());
  auto expected = this->refine(cloud, refinement);
  std::for_each(expected.begin(), expected.end(), move);
  const auto found = this->refine(moved, refinement);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i].getVector3fMap() - expected[i].getVector3fMap()).norm(), 2e-3f);
  }
}

TYPED_TEST(PositionRefinementContractOf, KeepsFieldsShapeAndInput) {
  auto cloud = makeCorner<TypeParam>();
  cloud->width = 100;
  cloud->height = 10;
  cloud->sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  cloud->header.stamp = 17;
  const typename TestFixture::Cloud before = *cloud;
  typename TestFixture::Refinement refinement;
  const auto output = this->refine(cloud, refinement);
  this->expectSame(*cloud, before);
  EXPECT_EQ(output.width, 100u);
  EXPECT_EQ(output.height, 10u);
  EXPECT_EQ(output.header.stamp, 17u);
  EXPECT_EQ(output.sensor_origin_, before.sensor_origin_);
  EXPECT_EQ(output[5].curvature, 0.25f);
  EXPECT_EQ(output[5].getNormalVector3fMap(), before[5].getNormalVector3fMap());
  refinement.filter(*cloud);
  this->expectSame(*cloud, output);  // in place
}

TYPED_TEST(PositionRefinementContractOf, SurvivesNoInputEmptyInputAndANewInput) {
  typename TestFixture::Refinement refinement;
  typename TestFixture::Cloud output;
  output.push_back(makePoint<TypeParam>(1, 1, 1, 0));
  refinement.filter(output);
  EXPECT_EQ(output.size(), 1u) << "without input the output stays as it was";
  EXPECT_TRUE(this->refine(pcl::make_shared<typename TestFixture::Cloud>(), refinement).empty());
  for (const int n : {500, 1, 2, 40}) {
    EXPECT_EQ(this->refine(makeLine<TypeParam>(n), refinement).size(), static_cast<std::size_t>(n));
  }
}

TYPED_TEST(PositionRefinementContractOf, RefusesBadParameters) {
  const auto cloud = makeLine<TypeParam>(100);
  const auto count = [&](auto spoil) {
    typename TestFixture::Refinement refinement;
    spoil(refinement);
    return this->refine(cloud, refinement).size();
  };
  const double nan = std::nan("");
  EXPECT_EQ(count([](auto& r) { r.setKSearch(-1); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setKSearch(0); }), 0u) << "neither k nor radius";
  EXPECT_EQ(count([](auto& r) { r.setRadiusSearch(1.0); }), 0u) << "both";
  EXPECT_EQ(count([nan](auto& r) { r.setRadiusSearch(nan); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setSigmaP(-1); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setSigmaN(0); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setSigmaN(4); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setBeta(-0.1); }), 0u);
  EXPECT_EQ(count([nan](auto& r) { r.setBeta(nan); }), 0u);
  EXPECT_EQ(count([](auto& r) { r.setIterations(-1); }), 0u);
  EXPECT_EQ(count([](auto& r) {
              r.setRegions(std::vector<pcl::PointIndices>(1));
              auto regions = r.getRegions();
              regions[0].indices = {0, 100};
              r.setRegions(regions);
            }),
            0u);
  EXPECT_EQ(count([](auto& r) {
              std::vector<pcl::PointIndices> regions(2);
              regions[0].indices = {0, 5};
              regions[1].indices = {5, 6};
              r.setRegions(regions);
            }),
            0u);
  EXPECT_EQ(count([](auto& r) { r.setKSearch(1000000); }), 100u) << "all are taken";
  EXPECT_EQ(count([](auto& r) { r.setSigmaP(1e-300); }), 100u);
  EXPECT_EQ(count([](auto& r) { r.setSigmaN(1e-12); }), 100u);
}

TYPED_TEST(PositionRefinementContractOf, IsAPclFilter) {
  struct Named : TestFixture::Refinement {
    const std::string& name() const { return this->getClassName(); }
  };
  Named named;
  EXPECT_EQ(named.name(), "AnisotropicPositionRefinement");
  named.setKSearch(12);
  named.setSigmaN(0.5);
  named.setBeta(0.2);
  named.setIterations(7);
  EXPECT_EQ(named.getKSearch(), 12);
  EXPECT_EQ(named.getSigmaN(), 0.5);
  EXPECT_EQ(named.getBeta(), 0.2);
  EXPECT_EQ(named.getIterations(), 7);
  typename TestFixture::Refinement::Ptr made(new typename TestFixture::Refinement);
  const typename TestFixture::Refinement::ConstPtr read_only = made;
  EXPECT_EQ(read_only->getSigmaP(), 0.0);
  const typename pcl::Filter<TypeParam>::Ptr base = made;
  base->setInputCloud(makeLine<TypeParam>(50));
  typename TestFixture::Cloud output;
  base->filter(output);
  EXPECT_EQ(output.size(), 50u);
}

}  // namespace
