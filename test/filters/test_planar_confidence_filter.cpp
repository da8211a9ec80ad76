// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/filters/passthrough.h>
#include <pcl/search/brute_force.h>
#include <storey/filters/planar_confidence_filter.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <pcl/search/impl/brute_force.hpp>
#include <pcl/search/impl/search.hpp>
#include <random>
#include <set>

#include "../point_types.h"

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
PointT makePoint(double x, double y, double z) {
  PointT p;
  p.x = static_cast<float>(x);
  p.y = static_cast<float>(y);
  p.z = static_cast<float>(z);
  p.normal_x = 0.0f;
  p.normal_y = 0.0f;
  p.normal_z = 1.0f;
  p.curvature = 0.25f;
  return p;
}

// A noisy wall of 400 points and a bush of 100 beside it.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeWallAndBush() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.02);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < 400; ++i) {
    cloud->push_back(makePoint<PointT>(10 * uniform(random), noise(random), 5 * uniform(random)));
  }
  for (int i = 0; i < 100; ++i) {
    cloud->push_back(
        makePoint<PointT>(15 + 2 * uniform(random), 2 * uniform(random), 2 * uniform(random)));
  }
  cloud->header.frame_id = "site";
  cloud->header.stamp = 17;
  cloud->sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  cloud->sensor_orientation_ = Eigen::Quaternionf(0, 1, 0, 0);
  return cloud;
}

// By brute force over all points, covariance about the mean in doubles.
template <typename PointT>
double bruteForceConfidence(const pcl::PointCloud<PointT>& cloud, std::size_t i, std::size_t k) {
  std::vector<std::pair<double, std::size_t>> order;
  const auto at = [&cloud](std::size_t j) -> Eigen::Vector3d {
    return cloud[j].getVector3fMap().template cast<double>();
  };
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    order.emplace_back((at(j) - at(i)).squaredNorm(), j);
  }
  std::sort(order.begin(), order.end());
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(k));
  for (std::size_t m = 0; m < k; ++m) {
    points.col(static_cast<Eigen::Index>(m)) = at(order[m].second);
  }
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d l = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues();
  return 1.0 - std::exp(-0.02 * l.squaredNorm() / (l(2) * l(2)));
}

template <typename PointT>
class PlanarConfidenceFilterOf : public testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Filter = storey::PlanarConfidenceFilter<PointT>;

  static std::vector<double> confidences(const typename Cloud::ConstPtr& cloud) {
    Filter filter;
    filter.setInputCloud(cloud);
    pcl::Indices kept;
    filter.filter(kept);
    return filter.getConfidences();
  }
};
TYPED_TEST_SUITE(PlanarConfidenceFilterOf, OrientedPointTypes);

TYPED_TEST(PlanarConfidenceFilterOf, ComputesTheFormulaOverTheNearest) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const std::vector<double> found = this->confidences(cloud);
  ASSERT_EQ(found.size(), cloud->size());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    ASSERT_NEAR(found[i], bruteForceConfidence(*cloud, i, 30), 1e-9) << i;
  }
}

TYPED_TEST(PlanarConfidenceFilterOf, KeepsTheShareAndReportsItsThreshold) {
  const auto cloud = makeWallAndBush<TypeParam>();
  typename TestFixture::Filter filter(true);
  filter.setInputCloud(cloud);
  EXPECT_TRUE(std::isnan(filter.getThreshold()));
  pcl::Indices kept;
  filter.filter(kept);
  const std::vector<double> confidences = filter.getConfidences();
  EXPECT_EQ(kept.size(), 425u);  // 85 % of 500
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  std::vector<double> sorted = confidences;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(filter.getThreshold(), sorted[75]);  // 15 % lie below
  std::set<pcl::index_t> all(kept.begin(), kept.end());
  all.insert(filter.getRemovedIndices()->begin(), filter.getRemovedIndices()->end());
  EXPECT_EQ(all.size(), 500u);
  EXPECT_EQ(filter.getRemovedIndices()->size(), 75u);
  EXPECT_TRUE(std::all_of(filter.getRemovedIndices()->begin(), filter.getRemovedIndices()->end(),
                          [](pcl::index_t i) { return i >= 400; }))
      << "the bush goes first";
  filter.filter(kept);
  EXPECT_EQ(filter.getRemovedIndices()->size(), 75u) << "accumulated over runs";

  filter.setThreshold(0.5);
  filter.filter(kept);
  EXPECT_EQ(filter.getThreshold(), 0.5);
  EXPECT_EQ(
      static_cast<std::ptrdiff_t>(kept.size()),
      std::count_if(confidences.begin(), confidences.end(), [](double c) { return c >= 0.5; }));
  filter.setKeptShare(1.0);
  filter.filter(kept);
  EXPECT_EQ(kept.size(), 500u);
}

TYPED_TEST(PlanarConfidenceFilterOf, HasDefinedConfidencesAtTheExtremes) {
  auto plane = pcl::make_shared<typename TestFixture::Cloud>();
  for (int i = 0; i < 100; ++i) {
    plane->push_back(makePoint<TypeParam>(i % 10, i / 10, 5.0));
  }
  for (const double c : this->confidences(plane)) {
    EXPECT_EQ(c, 1.0);
  }
  auto heap = pcl::make_shared<typename TestFixture::Cloud>();
  heap->assign(50, makePoint<TypeParam>(1, 2, 3));
  for (const double c : this->confidences(heap)) {
    EXPECT_EQ(c, 0.0);  // one position is no evidence of a plane
  }
}

// With all m copies of one point in a k-d tree every query there would visit all of them.
TYPED_TEST(PlanarConfidenceFilterOf, ManyCopiesCountOnceAndCostLittle) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const std::vector<double> expected = this->confidences(cloud);
  auto heavy = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  heavy->insert(heavy->end(), 1000000, (*cloud)[0]);
  const std::vector<double> found = this->confidences(heavy);
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin()));
  EXPECT_EQ(found.back(), expected[0]);
}

TYPED_TEST(PlanarConfidenceFilterOf, DropsInvalidPointsUnderBothSigns) {
  auto cloud = makeWallAndBush<TypeParam>();
  (*cloud)[7].y = kNaN;
  (*cloud)[8].z = std::numeric_limits<float>::infinity();
  (*cloud)[9].x = 1e30f;
  (*cloud)[10].normal_x = kNaN;
  (*cloud)[11].normal_z = 0.0f;  // normals do not matter
  cloud->is_dense = true;        // a lie that PCL's search would not survive
  typename TestFixture::Filter filter(true);
  filter.setInputCloud(cloud);
  filter.setSearchMethod(pcl::make_shared<pcl::search::BruteForce<TypeParam>>());
  pcl::Indices kept, others;
  filter.filter(kept);
  for (const std::size_t i : {7, 8, 9}) {
    EXPECT_TRUE(std::isnan(filter.getConfidences()[i]));
  }
  EXPECT_TRUE(std::isfinite(filter.getConfidences()[10] + filter.getConfidences()[11]));
  filter.setNegative(true);
  filter.filter(others);
  EXPECT_EQ(kept.size() + others.size(), 497u);
  kept.insert(kept.end(), others.begin(), others.end());
  for (const pcl::index_t i : {7, 8, 9}) {
    EXPECT_EQ(std::count(kept.begin(), kept.end(), i), 0);
    EXPECT_EQ(std::count(filter.getRemovedIndices()->begin(), filter.getRemovedIndices()->end(), i),
              1);
  }
  cloud->is_dense = false;
  typename TestFixture::Cloud output;
  filter.filter(output);
  EXPECT_TRUE(output.is_dense);
}

TYPED_TEST(PlanarConfidenceFilterOf, CopiesPointsHeaderAndPose) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const typename TestFixture::Cloud before = *cloud;
  typename TestFixture::Filter filter;
  filter.setInputCloud(cloud);
  pcl::Indices kept;
  filter.filter(kept);
  typename TestFixture::Cloud output;
  filter.filter(output);
  ASSERT_EQ(output.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const TypeParam& original = before[static_cast<std::size_t>(kept[i])];
    EXPECT_EQ(output[i].getVector3fMap(), original.getVector3fMap());
    EXPECT_EQ(output[i].getNormalVector3fMap(), original.getNormalVector3fMap());
    EXPECT_EQ(output[i].curvature, original.curvature);
  }
  EXPECT_EQ(output.header.frame_id, "site");
  EXPECT_EQ(output.header.stamp, 17u);
  EXPECT_EQ(output.sensor_origin_, before.sensor_origin_);
  EXPECT_EQ(output.sensor_orientation_.coeffs(), before.sensor_orientation_.coeffs());
  EXPECT_TRUE(filter.getRemovedIndices()->empty()) << "not asked for";
  ASSERT_EQ(cloud->size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ((*cloud)[i].getVector3fMap(), before[i].getVector3fMap()) << "the input is const";
  }
  filter.filter(*cloud);
  EXPECT_EQ(cloud->size(), output.size()) << "in place";
}

TYPED_TEST(PlanarConfidenceFilterOf, KeepsOrganizedCloudsOrganized) {
  auto cloud = makeWallAndBush<TypeParam>();
  cloud->width = 50;
  cloud->height = 10;
  typename TestFixture::Filter filter;
  filter.setInputCloud(cloud);
  filter.setKeepOrganized(true);
  typename TestFixture::Cloud output;
  filter.filter(output);
  EXPECT_EQ(output.width, 50u);
  EXPECT_EQ(output.height, 10u);
  EXPECT_FALSE(output.is_dense);
  const auto countOf = [&output](auto predicate) {
    return std::count_if(output.begin(), output.end(), predicate);
  };
  EXPECT_EQ(countOf([](const TypeParam& p) { return std::isnan(p.x); }), 75);
  filter.setUserFilterValue(-5.0f);
  filter.filter(output);
  EXPECT_EQ(countOf([](const TypeParam& p) { return p.x == -5.0f && p.y == -5.0f; }), 75);
  filter.setKeptShare(2.0);
  filter.filter(output);
  EXPECT_TRUE(output.empty()) << "bad parameter";
}

TYPED_TEST(PlanarConfidenceFilterOf, IndicesChooseWhatIsJudgedNotTheNeighbors) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const std::vector<double> full = this->confidences(cloud);
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{450, 3, 200, 499, 0});
  typename TestFixture::Filter filter;
  filter.setInputCloud(cloud);
  filter.setIndices(indices);
  filter.setThreshold(0.0);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(kept, *indices);
  ASSERT_EQ(filter.getConfidences().size(), 5u);
  for (std::size_t m = 0; m < 5; ++m) {
    EXPECT_EQ(filter.getConfidences()[m], full[static_cast<std::size_t>((*indices)[m])]);
  }
  indices->push_back(500);
  filter.filter(kept);
  EXPECT_TRUE(kept.empty()) << "index outside the cloud";
  (*indices)[5] = -1;
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
}

TYPED_TEST(PlanarConfidenceFilterOf, SharedSearchGivesTheSame) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const auto search = pcl::make_shared<pcl::search::BruteForce<TypeParam>>();
  typename TestFixture::Filter filter;
  filter.setInputCloud(cloud);
  filter.setSearchMethod(search);
  EXPECT_EQ(filter.getSearchMethod(), search);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(search->getInputCloud(), cloud);
  EXPECT_EQ(filter.getConfidences(), this->confidences(cloud));
}

TYPED_TEST(PlanarConfidenceFilterOf, ThreadsAndOrderDoNotMatter) {
  const auto cloud = makeWallAndBush<TypeParam>();
  std::vector<double> of_threads[2];
  for (const unsigned int threads : {1u, 4u}) {
    typename TestFixture::Filter filter;
    filter.setInputCloud(cloud);
    filter.setNumberOfThreads(threads);
    pcl::Indices kept;
    filter.filter(kept);
    of_threads[threads / 4] = filter.getConfidences();
  }
  EXPECT_EQ(of_threads[0], of_threads[1]);
  auto reversed = pcl::make_shared<typename TestFixture::Cloud>();
  reversed->assign(cloud->rbegin(), cloud->rend(), cloud->width);
  std::vector<double> of_reversed = this->confidences(reversed);
  std::reverse(of_reversed.begin(), of_reversed.end());
  EXPECT_EQ(of_reversed, of_threads[0]);
}

// k does not change under rigid motions. Floats near 1000 are multiples of 6e-5: against the wall's
// noise of 0.02 a change of l3 by 2 x 6e-5 / 0.02, less than 1 %.
TYPED_TEST(PlanarConfidenceFilterOf, IsInvariantUnderRigidMotion) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const std::vector<double> expected = this->confidences(cloud);
  auto moved = pcl::make_shared<typename TestFixture::Cloud>(*cloud);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  for (TypeParam& p : *moved) {
    const Eigen::Vector3d x = p.getVector3fMap().template cast<double>();
    p.getVector3fMap() = (turn * x + Eigen::Vector3d(1000, -1000, 1000)).template cast<float>();
  }
  const std::vector<double> found = this->confidences(moved);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 0.02);
  }
}

TYPED_TEST(PlanarConfidenceFilterOf, SurvivesNoInputEmptyInputAndANewInput) {
  typename TestFixture::Filter filter;
  typename TestFixture::Cloud output;
  output.push_back(makePoint<TypeParam>(1, 1, 1));
  filter.filter(output);
  EXPECT_EQ(output.size(), 1u) << "without input the output stays as it was";
  filter.setInputCloud(pcl::make_shared<typename TestFixture::Cloud>());
  filter.filter(output);
  EXPECT_TRUE(output.empty());
  EXPECT_TRUE(std::isnan(filter.getThreshold()));
  // 20 points share one neighbourhood, 3 have none: equal confidences all reach T_k.
  const std::vector<std::pair<std::size_t, std::size_t>> sizes_in_and_out{
      {500, 425}, {20, 20}, {3, 3}, {400, 340}};
  for (const auto& [size_in, size_out] : sizes_in_and_out) {
    auto cloud = makeWallAndBush<TypeParam>();
    cloud->erase(cloud->begin() + static_cast<std::ptrdiff_t>(size_in), cloud->end());
    filter.setInputCloud(cloud);
    filter.filter(output);
    EXPECT_EQ(output.size(), size_out);
  }
}

TYPED_TEST(PlanarConfidenceFilterOf, RefusesBadParameters) {
  const auto cloud = makeWallAndBush<TypeParam>();
  const auto countKept = [&cloud](auto spoil) {
    typename TestFixture::Filter filter;
    filter.setInputCloud(cloud);
    spoil(filter);
    pcl::Indices kept{1, 2};
    filter.filter(kept);
    return kept.size();
  };
  EXPECT_EQ(countKept([](auto& f) { f.setKSearch(3); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setKSearch(-1); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setKeptShare(0.0); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setKeptShare(1.01); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setKeptShare(std::nan("")); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setThreshold(-0.1); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setThreshold(std::nan("")); }), 0u);
  EXPECT_EQ(countKept([](auto& f) { f.setKSearch(1000000); }), 500u) << "one neighbourhood";
}

TYPED_TEST(PlanarConfidenceFilterOf, IsAPclFilter) {
  struct Named : TestFixture::Filter {
    const std::string& name() const { return this->getClassName(); }
  };
  Named named;
  EXPECT_EQ(named.name(), "PlanarConfidenceFilter");
  named.setKSearch(12);
  named.setNumberOfThreads(3);
  named.setKeptShare(0.5);
  EXPECT_EQ(named.getKSearch(), 12);
  EXPECT_EQ(named.getNumberOfThreads(), 3u);
  EXPECT_EQ(named.getKeptShare(), 0.5);

  typename TestFixture::Filter::Ptr made(new typename TestFixture::Filter);
  const typename TestFixture::Filter::ConstPtr read_only = made;
  EXPECT_EQ(read_only->getKSearch(), 30);
  const typename pcl::Filter<TypeParam>::Ptr base = made;
  typename TestFixture::Cloud output;
  base->setInputCloud(makeWallAndBush<TypeParam>());
  base->filter(output);
  EXPECT_EQ(output.size(), 425u);
}

TEST(PlanarConfidenceFilter, StandsInAListOfFilters) {
  auto pass = pcl::make_shared<pcl::PassThrough<pcl::PointNormal>>();
  pass->setFilterFieldName("x");
  pass->setFilterLimits(0.0f, 12.0f);  // the wall
  const std::vector<pcl::Filter<pcl::PointNormal>::Ptr> filters{
      pass, pcl::make_shared<storey::PlanarConfidenceFilter<pcl::PointNormal>>()};
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud = makeWallAndBush<pcl::PointNormal>();
  for (const auto& filter : filters) {
    auto output = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
    filter->setInputCloud(cloud);
    filter->filter(*output);
    cloud = output;
  }
  EXPECT_EQ(cloud->size(), 340u);  // 85 % of 400
}

}  // namespace
