// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/anisotropic_position_refinement.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "../point_types.h"

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kSigmaN = 20 * M_PI / 180;

template <typename PointT>
PointT makePoint(double x, double y, double nx, double ny) {
  PointT p;
  p.getVector3fMap() = Eigen::Vector3d(x, y, 0).cast<float>();
  p.getNormalVector3fMap() = Eigen::Vector3d(nx, ny, 0).cast<float>();
  p.curvature = 0.25f;
  return p;
}

// n points at steps of 0.05 along x, noise 0.01 in y: a flattened wall.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeLine(int n, double noise = 0.01) {
  std::mt19937 random(3);
  std::normal_distribution<double> e(0.0, noise);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < n; ++i) {
    cloud->push_back(makePoint<PointT>(0.05 * i, e(random), 0, 1));
  }
  cloud->header.frame_id = "site";
  return cloud;
}

// Two walls of 500 points that meet in (0, 0): along x (first) and along y.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeCorner() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.0, 5.0);
  std::normal_distribution<double> e(0.0, 0.02);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < 500; ++i) {
    cloud->push_back(makePoint<PointT>(u(random), e(random), 0, -1));
  }
  for (int i = 0; i < 500; ++i) {
    cloud->push_back(makePoint<PointT>(e(random), u(random), -1, 0));
  }
  return cloud;
}

std::vector<pcl::PointIndices> cornerRegions() {
  std::vector<pcl::PointIndices> regions(2);
  for (int i = 0; i < 1000; ++i) {
    regions[i < 500 ? 0 : 1].indices.push_back(i);
  }
  return regions;
}

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

template <typename PointT>
class PositionRefinementOf : public testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Refinement = storey::AnisotropicPositionRefinement<PointT>;

  static Cloud refine(const typename Cloud::ConstPtr& cloud, Refinement& refinement) {
    Cloud output;
    output.push_back(PointT());  // must not survive
    refinement.setInputCloud(cloud);
    refinement.filter(output);
    return output;
  }

  static void expectSame(const Cloud& a, const Cloud& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].getVector3fMap(), b[i].getVector3fMap()) << i;
    }
  }
};
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

TYPED_TEST(PositionRefinementOf, IndicesChooseTheOutputOnly) {
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

TYPED_TEST(PositionRefinementOf, InvalidPointsStayAndDisturbNobody) {
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

TYPED_TEST(PositionRefinementOf, LengthOfNormalsDoesNotMatter) {
  const auto cloud = makeCorner<TypeParam>();
  auto scaled = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  for (TypeParam& p : *scaled) {
    p.getNormalVector3fMap() *= 4.0f;
  }
  typename TestFixture::Refinement refinement;
  this->expectSame(this->refine(scaled, refinement), this->refine(cloud, refinement));
}

TYPED_TEST(PositionRefinementOf, ManyCopiesMoveAlikeAndCostLittle) {
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

TYPED_TEST(PositionRefinementOf, ThreadsDoNotMatter) {
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
TYPED_TEST(PositionRefinementOf, FollowsRigidMotions) {
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

TYPED_TEST(PositionRefinementOf, KeepsFieldsShapeAndInput) {
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

TYPED_TEST(PositionRefinementOf, SurvivesNoInputEmptyInputAndANewInput) {
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

TYPED_TEST(PositionRefinementOf, RefusesBadParameters) {
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

TYPED_TEST(PositionRefinementOf, IsAPclFilter) {
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
