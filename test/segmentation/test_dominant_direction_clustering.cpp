// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/search/brute_force.h>
#include <storey/segmentation/dominant_direction_clustering.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <pcl/search/impl/brute_force.hpp>
#include <pcl/search/impl/search.hpp>
#include <random>
#include <type_traits>
#include <vector>

#include "point_types.h"

namespace {

using storey::detail::AngleCluster;
using storey::detail::AngleHistogram;
using Clusters = std::vector<pcl::PointIndices>;

constexpr double kDegree = M_PI / 180.0;

double angleOf(const Eigen::Vector3d& direction) {
  return std::atan2(direction.y(), direction.x());
}

double angleBetween(double a, double b) { return std::abs(storey::detail::wrapAngle(a - b)); }

// --- the kernel -----------------------------------------------------------------------------

// The procedure as the paper has it: all pairs, again and again.
std::vector<double> mergeLiterally(std::vector<AngleCluster> clusters, double merge_angle) {
  while (clusters.size() > 1) {
    std::size_t first = 0;
    std::size_t second = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      for (std::size_t j = i + 1; j < clusters.size(); ++j) {
        const double apart = angleBetween(clusters[i].center, clusters[j].center);
        if (apart < least) {
          least = apart;
          first = i;
          second = j;
        }
      }
    }
    if (least > merge_angle) {
      break;
    }
    AngleCluster& merged = clusters[first];
    const AngleCluster other = clusters[second];
    const double turn = storey::detail::wrapAngle(other.center - merged.center);
    merged.weight += other.weight;
    merged.center = storey::detail::wrapAngle(merged.center + turn * other.weight / merged.weight);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
  std::vector<double> centers;
  for (const AngleCluster& cluster : clusters) {
    centers.push_back(cluster.center);
  }
  std::sort(centers.begin(), centers.end());
  return centers;
}

TEST(MergeOnCircle, EqualsTheLiteralProcedure) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::uniform_real_distribution<double> merge_angle(1.0 * kDegree, 60.0 * kDegree);
  for (int round = 0; round < 100; ++round) {
    std::vector<AngleCluster> points(60);
    for (AngleCluster& point : points) {
      point = {angle(random), 1.0};
    }
    std::sort(points.begin(), points.end(),
              [](const AngleCluster& a, const AngleCluster& b) { return a.center < b.center; });
    const double limit = merge_angle(random);
    const std::vector<double> expected = mergeLiterally(points, limit);
    const std::vector<AngleCluster> found = storey::detail::mergeOnCircle(points, limit);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].center, expected[i], 1e-9);
    }
  }
}

TEST(MergeOnCircle, HistogramEqualsTheLiteralProcedureUpToABin) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 2.0 * kDegree);
  std::uniform_real_distribution<double> turn(-M_PI, M_PI);
  for (int round = 0; round < 20; ++round) {
    const double start = turn(random);
    AngleHistogram histogram;
    std::vector<AngleCluster> points;
    for (int i = 0; i < 250; ++i) {
      const double angle =
          storey::detail::wrapAngle(start + 72.0 * kDegree * (i % 5) + noise(random));
      histogram.add(angle);
      points.push_back({angle, 1.0});
    }
    // 5 walls of +-8 degrees, 72 apart: whole walls merge before any two of them
    const std::vector<double> expected = mergeLiterally(points, 25.0 * kDegree);
    const auto found = storey::detail::mergeOnCircle(histogram.clusters(), 25.0 * kDegree);
    ASSERT_EQ(expected.size(), 5U);
    ASSERT_EQ(found.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_LE(angleBetween(found[i].center, expected[i]), AngleHistogram::kBinWidth);
    }
  }
}

TEST(AngleHistogram, SpreadOfOneWallAmongOthers) {
  for (const double degrees : {1.0, 3.0, 8.0}) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, degrees * kDegree);
    AngleHistogram histogram;
    for (int i = 0; i < 100000; ++i) {
      histogram.add(60.0 * kDegree * (i % 6) + noise(random));
    }
    // where the curve falls to a tenth it is steep: 10 % of noise there move it by 2 %; the two
    // neighbours at 60 degrees add less than 1 %
    EXPECT_NEAR(storey::detail::modeSpread(histogram), degrees * kDegree, 0.1 * degrees * kDegree);
  }
  EXPECT_EQ(storey::detail::modeSpread(AngleHistogram()), 0.0);
}

// --- the class ------------------------------------------------------------------------------

template <typename PointT>
PointT makePoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  PointT p;
  p.getVector3fMap() = position.cast<float>();
  p.getNormalVector3fMap() = normal.cast<float>();
  return p;
}

// A unit vector about `degrees` (standard deviation) away from `normal` in a random direction.
Eigen::Vector3d disturb(const Eigen::Vector3d& normal, double degrees, std::mt19937& random) {
  std::normal_distribution<double> tilt(0.0, degrees * kDegree);
  std::uniform_real_distribution<double> turn(0.0, M_PI);
  const double around = turn(random);
  const Eigen::Vector3d axis = std::cos(around) * normal.unitOrthogonal() +
                               std::sin(around) * normal.cross(normal.unitOrthogonal());
  return Eigen::AngleAxisd(tilt(random), axis) * normal;
}

// A tower over a convex polygon, given by the angles of its walls' normals and their distances
// from the middle: walls of height 10, points at random in proportion to their lengths.
struct Tower {
  std::vector<double> angles;
  double inradius = 10.0;
  double position_noise = 0.1;
  double normal_noise = 15.0;  // degrees

  template <typename PointT>
  typename pcl::PointCloud<PointT>::Ptr sample(std::size_t num_points, unsigned int seed) const {
    std::mt19937 random(seed);
    const std::size_t n = angles.size();
    std::vector<Eigen::Vector3d> corners;  // of walls i and i + 1, on a common inscribed circle
    std::vector<double> lengths;
    for (std::size_t i = 0; i < n; ++i) {
      const double next = i + 1 < n ? angles[i + 1] : angles[0] + 2.0 * M_PI;
      const double middle = 0.5 * (angles[i] + next);
      corners.push_back(inradius / std::cos(0.5 * (next - angles[i])) *
                        Eigen::Vector3d(std::cos(middle), std::sin(middle), 0.0));
    }
    for (std::size_t i = 0; i < n; ++i) {
      lengths.push_back((corners[i] - corners[(i + n - 1) % n]).norm());
    }
    std::discrete_distribution<std::size_t> wall(lengths.begin(), lengths.end());
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, position_noise);
    auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
    for (std::size_t p = 0; p < num_points; ++p) {
      const std::size_t i = wall(random);
      const Eigen::Vector3d normal(std::cos(angles[i]), std::sin(angles[i]), 0.0);
      const double along = unit(random);
      Eigen::Vector3d position = (1.0 - along) * corners[(i + n - 1) % n] + along * corners[i];
      position.z() = 10.0 * unit(random);
      position += Eigen::Vector3d(noise(random), noise(random), noise(random));
      cloud->push_back(makePoint<PointT>(position, disturb(normal, normal_noise, random)));
    }
    return cloud;
  }
};

std::vector<double> regularAngles(std::size_t n, double start_degrees) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < n; ++i) {
    angles.push_back(start_degrees * kDegree +
                     2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n));
  }
  return angles;
}

// Every true direction is found, nothing else is.
void expectDirections(const std::vector<Eigen::Vector3d>& found, const std::vector<double>& truth,
                      double tolerance_degrees) {
  ASSERT_EQ(found.size(), truth.size());
  for (const double angle : truth) {
    double nearest = M_PI;
    for (const Eigen::Vector3d& direction : found) {
      nearest = std::min(nearest, angleBetween(angleOf(direction), angle));
    }
    EXPECT_LE(nearest / kDegree, tolerance_degrees) << "wall at " << angle / kDegree;
  }
}

template <typename PointT>
struct Exposed : storey::DominantDirectionClustering<PointT> {
  using storey::DominantDirectionClustering<PointT>::getClassName;
};

template <typename PointT>
class DominantDirectionClusteringTest : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Clustering = storey::DominantDirectionClustering<PointT>;

  // A box of 40 points a wall without noise; the walls' points in turn.
  static typename Cloud::Ptr makeBox() {
    auto cloud = pcl::make_shared<Cloud>();
    for (int i = 0; i < 160; ++i) {
      const double angle = 0.3 + M_PI_2 * (i % 4);
      const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3d along(-normal.y(), normal.x(), 0.0);
      const Eigen::Vector3d position =
          5.0 * normal + (0.2 * (i / 4) - 4.0) * along + 0.01 * i * Eigen::Vector3d::UnitZ();
      cloud->push_back(makePoint<PointT>(position, normal));
    }
    cloud->header.frame_id = "house";
    cloud->header.stamp = 42;
    return cloud;
  }

  static Clusters run(Clustering& clustering, const typename Cloud::ConstPtr& cloud) {
    Clusters clusters(3);  // what was there before must go
    clustering.setInputCloud(cloud);
    clustering.extract(clusters);
    return clusters;
  }
};
TYPED_TEST_SUITE(DominantDirectionClusteringTest, OrientedPointTypes);

TYPED_TEST(DominantDirectionClusteringTest, BoxHasFourOrientedDirections) {
  const auto cloud = TestFixture::makeBox();
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(5);
  const Clusters clusters = TestFixture::run(clustering, cloud);
  expectDirections(clustering.getDirections(), {0.3, 0.3 + M_PI_2, 0.3 - M_PI_2, 0.3 - M_PI}, 1e-4);
  ASSERT_EQ(clusters.size(), 4U);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(clusters[c].header.frame_id, "house");
    EXPECT_EQ(clusters[c].header.stamp, 42U);
    pcl::Indices expected(40);  // equal sizes: in the order of the first index
    for (std::size_t i = 0; i < 40; ++i) {
      expected[i] = static_cast<pcl::index_t>(4 * i + c);
    }
    EXPECT_EQ(clusters[c].indices, expected);
    const Eigen::Vector3d& direction = clustering.getDirections()[c];
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    EXPECT_EQ(direction.z(), 0.0);
    EXPECT_NEAR(angleBetween(angleOf(direction), 0.3 + M_PI_2 * static_cast<double>(c)), 0.0, 1e-6);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, InvalidAndHorizontalPointsAreInNoCluster) {
  auto cloud = TestFixture::makeBox();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[0].x = nan;
  (*cloud)[1].normal_x = nan;
  (*cloud)[2].getNormalVector3fMap().setZero();
  (*cloud)[3].getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
  (*cloud)[4].z = std::numeric_limits<float>::infinity();
  cloud->is_dense = true;  // a lie that files tell
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(2);
  const Clusters clusters = TestFixture::run(clustering, cloud);
  ASSERT_EQ(clusters.size(), 4U);
  std::vector<pcl::index_t> seen;
  for (const pcl::PointIndices& cluster : clusters) {
    EXPECT_TRUE(std::is_sorted(cluster.indices.begin(), cluster.indices.end()));
    seen.insert(seen.end(), cluster.indices.begin(), cluster.indices.end());
  }
  std::sort(seen.begin(), seen.end());
  pcl::Indices expected(155);
  std::iota(expected.begin(), expected.end(), 5);
  EXPECT_EQ(seen, expected);
}

TYPED_TEST(DominantDirectionClusteringTest, SubsetInAnyOrderIsTheSubCloud) {
  const Tower tower{regularAngles(6, 10.0)};
  const auto cloud = tower.sample<TypeParam>(3000, 4);
  std::mt19937 random(5);
  pcl::Indices subset(3000);
  std::iota(subset.begin(), subset.end(), 0);
  std::shuffle(subset.begin(), subset.end(), random);
  subset.resize(2000);
  typename TestFixture::Clustering clustering;
  clustering.setIndices(pcl::make_shared<pcl::Indices>(subset));
  const Clusters of_subset = TestFixture::run(clustering, cloud);

  std::sort(subset.begin(), subset.end());
  const auto sub_cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud, subset);
  typename TestFixture::Clustering other;
  Clusters of_cloud = TestFixture::run(other, sub_cloud);
  ASSERT_EQ(of_subset.size(), 6U);
  ASSERT_EQ(of_subset.size(), of_cloud.size());
  for (std::size_t c = 0; c < of_cloud.size(); ++c) {
    for (pcl::index_t& i : of_cloud[c].indices) {
      i = subset[static_cast<std::size_t>(i)];
    }
    EXPECT_EQ(of_subset[c].indices, of_cloud[c].indices);
    EXPECT_EQ(clustering.getDirections()[c], other.getDirections()[c]);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, OrderOfPointsDoesNotMatter) {
  const Tower tower{regularAngles(5, 20.0)};
  const auto cloud = tower.sample<TypeParam>(4000, 6);
  std::vector<std::size_t> place(cloud->size());
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::mt19937 random(7);
  std::shuffle(place.begin(), place.end(), random);
  auto permuted = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  for (std::size_t i = 0; i < place.size(); ++i) {
    (*permuted)[place[i]] = (*cloud)[i];
  }
  typename TestFixture::Clustering clustering;
  clustering.setMaxSamples(1500);  // the sample must be the same points too
  Clusters clusters = TestFixture::run(clustering, cloud);
  const Clusters of_permuted = TestFixture::run(clustering, permuted);
  ASSERT_EQ(clusters.size(), 5U);
  ASSERT_EQ(of_permuted.size(), 5U);
  for (std::size_t c = 0; c < 5; ++c) {
    for (pcl::index_t& i : clusters[c].indices) {
      i = static_cast<pcl::index_t>(place[static_cast<std::size_t>(i)]);
    }
    std::sort(clusters[c].indices.begin(), clusters[c].indices.end());
    EXPECT_EQ(clusters[c].indices, of_permuted[c].indices);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, ThreadsGiveTheSameBytes) {
  const auto cloud = Tower{regularAngles(5, 33.0)}.sample<TypeParam>(3000, 8);
  typename TestFixture::Clustering clustering;
  clustering.setNumberOfThreads(1);
  const Clusters one = TestFixture::run(clustering, cloud);
  const std::vector<Eigen::Vector3d> directions = clustering.getDirections();
  clustering.setNumberOfThreads(4);
  const Clusters four = TestFixture::run(clustering, cloud);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    EXPECT_EQ(one[c].indices, four[c].indices);
    EXPECT_EQ(directions[c], clustering.getDirections()[c]);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, EquivariantUnderTurnAndShift) {
  const Tower tower{regularAngles(5, 0.0)};
  const auto cloud = tower.sample<TypeParam>(5000, 9);
  auto moved = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  const Eigen::AngleAxisf turn(0.7F, Eigen::Vector3f::UnitZ());
  for (TypeParam& p : *moved) {
    p.getVector3fMap() = turn * p.getVector3fMap() + Eigen::Vector3f(1000.0F, -1000.0F, 500.0F);
    p.getNormalVector3fMap() = turn * p.getNormalVector3fMap();
  }
  typename TestFixture::Clustering clustering;
  TestFixture::run(clustering, cloud);
  std::vector<double> expected;
  for (const Eigen::Vector3d& direction : clustering.getDirections()) {
    expected.push_back(angleOf(direction) + 0.7);
  }
  ASSERT_EQ(expected.size(), 5U);
  TestFixture::run(clustering, moved);
  expectDirections(clustering.getDirections(), expected, 0.1);  // a bin
}

TYPED_TEST(DominantDirectionClusteringTest, NothingInNothingOut) {
  typename TestFixture::Clustering clustering;
  Clusters clusters(2);
  clustering.extract(clusters);  // no input
  EXPECT_TRUE(clusters.empty());
  EXPECT_TRUE(clustering.getDirections().empty());
  EXPECT_TRUE(TestFixture::run(clustering, pcl::make_shared<pcl::PointCloud<TypeParam>>()).empty());
  EXPECT_EQ(TestFixture::run(clustering, TestFixture::makeBox()).size(), 4U);  // another size
  clustering.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  clustering.extract(clusters);
  EXPECT_TRUE(clusters.empty());
  EXPECT_TRUE(clustering.getDirections().empty());
}

TYPED_TEST(DominantDirectionClusteringTest, InputIsUnchanged) {
  const auto cloud = TestFixture::makeBox();
  const pcl::PointCloud<TypeParam> before = *cloud;
  typename TestFixture::Clustering clustering;
  TestFixture::run(clustering, cloud);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ((*cloud)[i].getVector3fMap(), before[i].getVector3fMap());
    EXPECT_EQ((*cloud)[i].getNormalVector3fMap(), before[i].getNormalVector3fMap());
  }
}

TYPED_TEST(DominantDirectionClusteringTest, BadParametersGiveNothing) {
  using Subject = typename TestFixture::Clustering;
  const auto cloud = TestFixture::makeBox();
  const auto expect_nothing = [&](auto change) {
    Subject clustering;
    EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 4U);
    change(clustering);
    EXPECT_TRUE(TestFixture::run(clustering, cloud).empty());
    EXPECT_TRUE(clustering.getDirections().empty());
  };
  expect_nothing([](Subject& c) { c.setSmoothingNeighbors(0); });
  expect_nothing([](Subject& c) { c.setMergeAngle(-0.1); });
  expect_nothing([](Subject& c) { c.setMergeAngle(4.0); });
  expect_nothing([](Subject& c) { c.setMergeAngle(std::nan("")); });
  expect_nothing([](Subject& c) { c.setMaxTilt(0.0); });
  expect_nothing([](Subject& c) { c.setMaxTilt(2.0); });
  expect_nothing([](Subject& c) { c.setMinClusterShare(1.5); });
  expect_nothing([](Subject& c) {
    c.setMinClusterSize(5);
    c.setMaxClusterSize(4);
  });
  expect_nothing(
      [](Subject& c) { c.setInputNormals(pcl::make_shared<pcl::PointCloud<TypeParam>>(3, 1)); });
  for (const pcl::index_t bad : {-1, 160}) {
    Subject clustering;
    clustering.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, bad}));
    EXPECT_TRUE(TestFixture::run(clustering, cloud).empty());
  }
}

TYPED_TEST(DominantDirectionClusteringTest, GettersAndTypes) {
  using Subject = typename TestFixture::Clustering;
  typename Subject::Ptr clustering(new Subject);
  typename Subject::ConstPtr constant = clustering;
  pcl::PCLBase<TypeParam>& base = *clustering;
  const auto cloud = TestFixture::makeBox();
  base.setInputCloud(cloud);
  EXPECT_EQ(constant->getDirections().size(), 0U);
  EXPECT_EQ(clustering->getInputCloud(), cloud);
  clustering->setInputNormals(cloud);
  EXPECT_EQ(clustering->getInputNormals(), cloud);
  const typename pcl::search::Search<TypeParam>::Ptr tree(new pcl::search::BruteForce<TypeParam>);
  clustering->setSearchMethod(tree);
  EXPECT_EQ(clustering->getSearchMethod(), tree);
  clustering->setNumberOfThreads(3);
  EXPECT_EQ(clustering->getNumberOfThreads(), 3U);
  clustering->setSmoothingNeighbors(7);
  EXPECT_EQ(clustering->getSmoothingNeighbors(), 7);
  clustering->setMaxSamples(70);
  EXPECT_EQ(clustering->getMaxSamples(), 70U);
  clustering->setMergeAngle(0.2);
  EXPECT_EQ(clustering->getMergeAngle(), 0.2);
  clustering->setMaxTilt(0.3);
  EXPECT_EQ(clustering->getMaxTilt(), 0.3);
  clustering->setMinClusterShare(0.1);
  EXPECT_EQ(clustering->getMinClusterShare(), 0.1);
  clustering->setMinClusterSize(3);
  EXPECT_EQ(clustering->getMinClusterSize(), 3U);
  clustering->setMaxClusterSize(333);
  EXPECT_EQ(clustering->getMaxClusterSize(), 333U);
  Clusters clusters;
  clustering->extract(clusters);
  EXPECT_EQ(clusters.size(), 4U);
  EXPECT_EQ(clustering->getUsedMergeAngle(), 0.2);
  EXPECT_EQ(tree->getInputCloud()->size(), 160U);  // the given tree was used
  EXPECT_STREQ(Exposed<TypeParam>().getClassName(), "DominantDirectionClustering");
}

TYPED_TEST(DominantDirectionClusteringTest, SizesAreHonoured) {
  auto cloud = TestFixture::makeBox();
  cloud->resize(142);  // 36, 36, 35, 35
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(1);
  const Clusters all = TestFixture::run(clustering, cloud);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].indices.size(), 36U);
  EXPECT_EQ(all[3].indices.size(), 35U);
  clustering.setMinClusterSize(36);
  EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 2U);
  EXPECT_EQ(clustering.getDirections().size(), 2U);
  clustering.setMinClusterSize(1);
  clustering.setMaxClusterSize(35);
  const Clusters small = TestFixture::run(clustering, cloud);
  ASSERT_EQ(small.size(), 2U);
  EXPECT_EQ(small[0].indices, all[2].indices);
  clustering.setMaxClusterSize(1000);
  clustering.setMinClusterShare(0.25);  // of 142: 35.5
  EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 2U);
}

using Clustering = storey::DominantDirectionClustering<pcl::PointNormal>;

TEST(DominantDirectionClustering, SeparateCloudOfNormals) {
  auto positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto box = Tower{regularAngles(4, 5.0), 10.0, 0.0, 0.0}.sample<pcl::PointNormal>(400, 1);
  for (const pcl::PointNormal& p : *box) {
    positions->push_back(pcl::PointXYZ(p.x, p.y, p.z));
    normals->push_back(pcl::Normal(p.normal_x, p.normal_y, p.normal_z));
  }
  storey::DominantDirectionClustering<pcl::PointXYZ, pcl::Normal> clustering;
  clustering.setInputCloud(positions);
  Clusters clusters;
  clustering.extract(clusters);
  EXPECT_TRUE(clusters.empty());  // no normals
  clustering.setInputNormals(normals);
  clustering.setSmoothingNeighbors(1);
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), regularAngles(4, 5.0), 1e-4);
}

TEST(DominantDirectionClustering, NoisyDecagonToHalfADegree) {
  // 15 degrees of noise, averaged over 30: 2 degrees; over 10,000 points a wall 0.02
  const std::vector<double> truth = regularAngles(10, 7.0);
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(200000, 2);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, WallsOfUnequalLength) {
  // turns of 36 +- 10 degrees: the lengths differ by a factor of 2
  const std::vector<double> turns = {26, 46, 30, 42, 36, 26, 46, 36, 30, 42};
  std::vector<double> truth = {0.2};
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    truth.push_back(truth.back() + turns[i] * kDegree);
  }
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(200000, 3);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, MoreNeighborsSeparateTwelveDegrees) {
  std::vector<double> truth = regularAngles(4, 0.0);
  truth.insert(truth.begin() + 1, 12.0 * kDegree);
  const auto cloud = Tower{truth, 40.0}.sample<pcl::PointNormal>(150000, 4);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setSmoothingNeighbors(100);  // 1.1 degrees of noise
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, RawNormalsOfABoxNeedNoNeighbors) {
  const std::vector<double> truth = regularAngles(4, 40.0);
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(20000, 5);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setSmoothingNeighbors(1);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.6);  // 3 x 10.6 degrees / sqrt(4000)
}

TEST(DominantDirectionClustering, FacesOfAThinWallDoNotCancel) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-5.0, 5.0);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (int i = 0; i < 2000; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Eigen::Vector3d normal = disturb({side, 0.0, 0.0}, 10.0, random);
    cloud->push_back(
        makePoint<pcl::PointNormal>({0.01 * side, unit(random), unit(random)}, normal));
  }
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), {0.0, M_PI}, 0.7);  // 3 x 7 degrees / sqrt(1000)
  for (const pcl::PointIndices& cluster : clusters) {
    EXPECT_EQ(cluster.indices.size(), 1000U);
  }
}

TEST(DominantDirectionClustering, AMillionCopiesAndAFarawayPoint) {
  auto cloud = Tower{regularAngles(4, 0.0), 10.0, 0.0, 0.0}.sample<pcl::PointNormal>(1000, 7);
  cloud->resize(1001000, (*cloud)[0]);
  cloud->push_back(makePoint<pcl::PointNormal>({3e38, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
  cloud->push_back(makePoint<pcl::PointNormal>({1e7, 1e7, 0.0}, Eigen::Vector3d::UnitY()));
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setMinClusterShare(0.0);
  clustering.setMaxSamples(0);
  Clusters clusters;
  clustering.extract(clusters);
  ASSERT_GE(clusters.size(), 4U);
  EXPECT_GE(clusters[0].indices.size(), 1000000U);
}

}  // namespace
