// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_io.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "../point_types.h"
#include "two_storey_building.h"

namespace {

using namespace storey;
using namespace storey::test;

template <typename PointT>
class MRFReconstruction : public ::testing::Test {};
TYPED_TEST_SUITE(MRFReconstruction, OrientedPointTypes);

TYPED_TEST(MRFReconstruction, OfSlicesIsAClosedSolid) {
  for (const double yaw : {0.0, 0.4}) {
    LayerwiseMRFReconstruction<TypeParam> reconstruction;
    reconstruction.setInputCloud(building<TypeParam>(yaw));
    reconstruction.setFloorplans(slices(yaw));
    pcl::PolygonMesh mesh;
    reconstruction.reconstruct(mesh);
    const Mesh result(mesh);
    expectClosed(result);
    EXPECT_NEAR(volumeOf(result), kVolume, 0.05 * kVolume);
    EXPECT_TRUE(reconstruction.getResult().check.ok());
    EXPECT_NEAR(reconstruction.getResult().check.volume, volumeOf(result), 1e-3 * kVolume);
    // Six walls, those of the tower one polygon with the L's below them; ground, two roofs.
    EXPECT_EQ(reconstruction.getModel().faces.size(), 9U);
    EXPECT_EQ(reconstruction.getResult().dominant.num_types, 2);
    EXPECT_TRUE(reconstruction.getResult().dominant.labeling.optimal);
  }
}

TYPED_TEST(MRFReconstruction, HasTheVolumeOfTheBuilding) {
  for (const bool given : {true, false}) {
    LayerwiseMRFReconstruction<TypeParam> reconstruction;
    reconstruction.setInputCloud(building<TypeParam>(0.4));
    if (given) reconstruction.setFloorplans(slices(0.4));
    pcl::PolygonMesh mesh;
    reconstruction.reconstruct(mesh);
    // A wall of area A has 25 A points and is good to 0.05 / sqrt(25 A), its volume to A times
    // that: 0.19 for all walls, 376 in area. A height is good to sqrt(0.05 / (0.9 L)), where
    // L = 25 x (length of the walls that end there) is the points per unit of height: 0.006, 0.009
    // and 0.008 for ground, lower and upper roof, areas 138, 54 and 84: 1.15. Both together 1.17.
    EXPECT_NEAR(volumeOf(Mesh(mesh)), kVolume, 4.0 * 1.17);
  }
}

TYPED_TEST(MRFReconstruction, OfALeaningCloudLeansWithIt) {
  // 0.3 degrees: over a height of 8 that is 0.04, a wall is good to 0.05 / sqrt(300) = 0.003.
  const auto upright = building<TypeParam>(0.4);
  const auto leaning = building<TypeParam>(0.4);
  const Eigen::Quaternionf tilt(Eigen::AngleAxisf(0.3F * static_cast<float>(M_PI) / 180.0F,
                                                  Eigen::Vector3f(0.6F, 0.8F, 0.0F)));
  for (TypeParam& p : *leaning) p.getVector3fMap() = tilt * p.getVector3fMap();
  pcl::PolygonMesh meshes[2];
  for (const bool leans : {false, true}) {
    LayerwiseMRFReconstruction<TypeParam> reconstruction;
    reconstruction.setInputCloud(leans ? leaning : upright);
    reconstruction.setFloorplans(slices(0.4));
    reconstruction.reconstruct(meshes[leans]);
    EXPECT_EQ(reconstruction.getResult().upright.isApprox(Eigen::Isometry3d::Identity()), !leans);
  }
  const Mesh straight(meshes[0]);
  const Mesh tilted(meshes[1]);
  ASSERT_EQ(straight.vertices.size(), tilted.vertices.size());
  for (const Eigen::Vector3d& v : straight.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& w : tilted.vertices) {
      nearest = std::min(nearest, (tilt.cast<double>() * v - w).norm());
    }
    EXPECT_LT(nearest, 0.015);
  }
}

TYPED_TEST(MRFReconstruction, WithoutFloorplansFindsThemItself) {
  LayerwiseMRFReconstruction<TypeParam> reconstruction;
  reconstruction.setInputCloud(building<TypeParam>(0.4));
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const Mesh result(mesh);
  expectClosed(result);
  EXPECT_NEAR(volumeOf(result), kVolume, 0.05 * kVolume);
}

TYPED_TEST(MRFReconstruction, HoldsTheModelsVerticesAndTheInputsHeader) {
  const auto cloud = building<TypeParam>();
  LayerwiseMRFReconstruction<TypeParam> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setFloorplans(slices());
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const Mesh result(mesh);
  ASSERT_EQ(result.vertices.size(), reconstruction.getModel().vertices.size());
  // Six corners on the ground, four of the lower roof, four of the upper one: the tower's other
  // walls go through without a vertex.
  EXPECT_EQ(result.vertices.size(), 14U);
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    EXPECT_LT((result.vertices[i] - reconstruction.getModel().vertices[i]).norm(), 1e-5);
  }
  for (const pcl::PCLHeader& header : {mesh.header, mesh.cloud.header}) {
    EXPECT_EQ(header.frame_id, "building");
    EXPECT_EQ(header.stamp, 12345U);
    EXPECT_EQ(header.seq, 7U);
  }
}

TYPED_TEST(MRFReconstruction, BothOverloadsAgreeAndASecondCallGivesTheSame) {
  const auto cloud = building<TypeParam>();
  const pcl::PointCloud<TypeParam> copy = *cloud;
  LayerwiseMRFReconstruction<TypeParam> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setFloorplans(slices());
  pcl::PolygonMesh first;
  reconstruction.reconstruct(first);
  pcl::PolygonMesh second = first;
  second.polygons.resize(1);
  reconstruction.reconstruct(second);
  EXPECT_TRUE(sameMesh(first, second));
  pcl::PointCloud<TypeParam> points(3, 1);
  std::vector<pcl::Vertices> polygons(5);
  reconstruction.reconstruct(points, polygons);
  const Mesh mesh(first);
  ASSERT_EQ(points.size(), mesh.vertices.size());
  EXPECT_EQ(points.width * points.height, points.size());
  EXPECT_EQ(points.header.frame_id, "building");
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].getVector3fMap().template cast<double>(), mesh.vertices[i]);
  }
  ASSERT_EQ(polygons.size(), first.polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    EXPECT_EQ(polygons[i].vertices, first.polygons[i].vertices);
  }
  EXPECT_TRUE(sameBytes(*cloud, copy));
}

TYPED_TEST(MRFReconstruction, WithoutInputOrPointsTheOutputIsEmpty) {
  LayerwiseMRFReconstruction<TypeParam> reconstruction;
  const auto expectEmpty = [&] {
    pcl::PolygonMesh mesh;
    mesh.polygons.resize(3);
    mesh.cloud.width = 5;
    reconstruction.reconstruct(mesh);
    EXPECT_TRUE(mesh.polygons.empty());
    EXPECT_EQ(mesh.cloud.width, 0U);
    EXPECT_TRUE(mesh.cloud.data.empty());
    pcl::PointCloud<TypeParam> points(3, 1);
    std::vector<pcl::Vertices> polygons(5);
    reconstruction.reconstruct(points, polygons);
    EXPECT_TRUE(points.empty());
    EXPECT_TRUE(polygons.empty());
    EXPECT_TRUE(reconstruction.getModel().empty());
  };
  expectEmpty();
  reconstruction.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  expectEmpty();
  auto unusable = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  addUnusable(*unusable);
  reconstruction.setInputCloud(unusable);
  expectEmpty();
  reconstruction.setInputCloud(building<TypeParam>());
  std::vector<FloorplanLayer> none = slices();
  for (FloorplanLayer& layer : none) layer.plan = {};
  reconstruction.setFloorplans(none);
  expectEmpty();
  reconstruction.setFloorplans(slices());
  reconstruction.setNoise(-1.0);
  expectEmpty();
}

TYPED_TEST(MRFReconstruction, BadParametersGiveNothing) {
  using Tested = LayerwiseMRFReconstruction<TypeParam>;
  const auto cloud = building<TypeParam>();
  const auto expectRefused = [&](const auto& spoil) {
    Tested reconstruction;
    reconstruction.setInputCloud(cloud);
    reconstruction.setFloorplans(slices());
    spoil(reconstruction);
    pcl::PolygonMesh mesh;
    reconstruction.reconstruct(mesh);
    EXPECT_TRUE(mesh.polygons.empty());
  };
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expectRefused([&](Tested& r) { r.setNoise(bad); });
    expectRefused([&](Tested& r) { r.setDensity(bad); });
    expectRefused([&](Tested& r) { r.setGrid(bad); });
    expectRefused([&](Tested& r) { r.setSmoothness(bad); });
    expectRefused([&](Tested& r) { r.setLabelCost(bad); });
  }
  expectRefused([&](Tested& r) {
    r.setIndices(
        pcl::make_shared<pcl::Indices>(pcl::Indices{static_cast<pcl::index_t>(cloud->size())}));
  });
  expectRefused([](Tested& r) {
    auto layers = slices();
    std::reverse(layers.begin(), layers.end());
    r.setFloorplans(layers);
  });
  expectRefused([](Tested& r) {
    auto layers = slices();
    layers[2].z_max = layers[2].z_min;
    r.setFloorplans(layers);
  });
}

TYPED_TEST(MRFReconstruction, OnlyIndexedPointsCountAndASecondCloudIsAsGood) {
  auto both = building<TypeParam>();
  const auto size = both->size();
  WallCloudOptions other;
  other.z_max = 12.0;
  addWalls(box(0.3, 0.3, 15.7, 5.7), other, *both);  // inside, taller, and misleading
  addUnusable(*both);
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < size; ++i) indices->push_back(static_cast<pcl::index_t>(i));
  LayerwiseMRFReconstruction<TypeParam> reconstruction;
  reconstruction.setFloorplans(slices());
  reconstruction.setInputCloud(both);
  reconstruction.setIndices(indices);
  pcl::PolygonMesh part;
  reconstruction.reconstruct(part);
  LayerwiseMRFReconstruction<TypeParam> again;
  again.setInputCloud(building<TypeParam>(0.4));
  again.setFloorplans(slices(0.4));
  pcl::PolygonMesh alone;
  again.reconstruct(alone);
  again.setInputCloud(building<TypeParam>());
  again.setFloorplans(slices());
  again.reconstruct(alone);
  EXPECT_FALSE(alone.polygons.empty());
  EXPECT_TRUE(sameMesh(part, alone));
}

TYPED_TEST(MRFReconstruction, IsAPclClassWithGetters) {
  struct Named : LayerwiseMRFReconstruction<TypeParam> {
    std::string name() const { return this->getClassName(); }
  };
  EXPECT_EQ(Named().name(), "LayerwiseMRFReconstruction");
  typename LayerwiseMRFReconstruction<TypeParam>::Ptr r(new LayerwiseMRFReconstruction<TypeParam>);
  r->setNoise(0.1);
  r->setDensity(30.0);
  r->setSmoothness(0.2);
  r->setLabelCost(0.3);
  r->setMaxTypes(4);
  r->setGrid(0.001);
  r->setExactMinimization(false);
  r->setEncoding(FloorplanGrammar::Encoding::Turns);
  r->setFloorplans(slices());
  typename LayerwiseMRFReconstruction<TypeParam>::ConstPtr constant = r;
  EXPECT_EQ(constant->getNoise(), 0.1);
  EXPECT_EQ(constant->getDensity(), 30.0);
  EXPECT_EQ(constant->getSmoothness(), 0.2);
  EXPECT_EQ(constant->getLabelCost(), 0.3);
  EXPECT_EQ(constant->getMaxTypes(), 4U);
  EXPECT_EQ(constant->getGrid(), 0.001);
  EXPECT_FALSE(constant->getExactMinimization());
  EXPECT_EQ(constant->getEncoding(), FloorplanGrammar::Encoding::Turns);
  EXPECT_EQ(constant->getFloorplans().size(), 16U);
  std::shared_ptr<pcl::SurfaceReconstruction<TypeParam>> base = r;
  base->setInputCloud(building<TypeParam>());
  pcl::PolygonMesh mesh;
  base->reconstruct(mesh);
  expectClosed(Mesh(mesh));
}

// --- once is enough -----------------------------------------------------------------------------

TEST(MRFReconstructionOnce, BlocksOfPlanarPointsMayEndShortOfTheRoof) {
  // 30 neighbours at 25 points per unit of area fill a disc of radius 0.618: so near to the ground
  // and the roof points of walls are not planar. What is left is 62 deviations of noise short.
  const double gap = std::sqrt(30.0 / (M_PI * 25.0));
  const Floorplan plan = planOf(kTower, 0.0);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  WallCloudOptions options;
  options.density = 25.0;
  options.noise = 0.01;
  options.z_max = 10.0;
  addWalls(moved(kTower, 0.0, {1, 2}), options, *cloud);
  addCap(plan, 0.0, -1.0, *cloud);
  addCap(plan, 10.0, 1.0, *cloud);
  for (const double density : {0.0, 25.0}) {
    LayerwiseMRFReconstruction<pcl::PointNormal> reconstruction;
    reconstruction.setInputCloud(cloud);
    reconstruction.setDensity(density);
    reconstruction.setBlocks({{gap, 10.0 - gap, plan}});
    pcl::PolygonMesh mesh;
    reconstruction.reconstruct(mesh);
    const std::vector<HeightFit>& levels = reconstruction.getResult().levels;
    ASSERT_EQ(levels.size(), 2U);
    // Walls of length 38 alone tell heights to sqrt(0.01 / (0.9 x 950)) = 0.0034.
    EXPECT_NEAR(levels[0].z, 0.0, 4.0 * 0.0034);
    EXPECT_NEAR(levels[1].z, 10.0, 4.0 * 0.0034);
  }
}

TEST(MRFReconstructionOnce, FacesWithHolesAreTriangulated) {
  // A courtyard: ground and roof have a hole each.
  const Corners outer = box(0, 0, 16, 12);
  const Corners court = clockwise(box(5, 4, 11, 8));
  WallCloudOptions options;
  options.noise = kNoise;
  options.density = 25.0;
  options.z_max = 5.0;
  std::vector<FloorplanLayer> layers;
  for (int i = 0; i < 10; ++i) {
    FloorplanLayer layer{0.5 * i, 0.5 * (i + 1), {}};
    layer.plan.components.push_back({ringOf(outer), {ringOf(court)}});
    layers.push_back(layer);
  }
  LayerwiseMRFReconstruction<pcl::PointNormal> reconstruction;
  reconstruction.setInputCloud(wallCloud<pcl::PointNormal>({outer, court}, options));
  reconstruction.setFloorplans(layers);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosed(Mesh(mesh));
  const double volume = (16.0 * 12.0 - 6.0 * 4.0) * 5.0;
  EXPECT_NEAR(volumeOf(Mesh(mesh)), volume, 0.01 * volume);
  EXPECT_EQ(reconstruction.getModel().faces.size(), 10U);
}

TEST(MRFReconstructionOnce, ExpansionIsNoBetterThanTheMinimum) {
  LayerwiseMRFReconstruction<pcl::PointNormal> reconstruction;
  reconstruction.setInputCloud(building<pcl::PointNormal>());
  auto layers = slices();
  for (const std::size_t i : {2U, 9U, 12U}) {
    layers[i].plan = planOf(box(0, 0, 3.0 + static_cast<double>(i), 9), 0.0);
  }
  reconstruction.setFloorplans(layers);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const double exact = reconstruction.getResult().dominant.labeling.energy;
  reconstruction.setExactMinimization(false);
  reconstruction.reconstruct(mesh);
  EXPECT_GE(reconstruction.getResult().dominant.labeling.energy, exact - 1e-9);
}

TEST(MRFReconstructionOnce, SavedMeshesAreReadAgainWithEqualCounts) {
  LayerwiseMRFReconstruction<pcl::PointNormal> reconstruction;
  reconstruction.setInputCloud(building<pcl::PointNormal>());
  reconstruction.setFloorplans(slices());
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const std::string stem = ::testing::TempDir() + "layerwise_mrf_reconstruction";
  ASSERT_EQ(pcl::io::savePLYFile(stem + ".ply", mesh, 9), 0);
  pcl::PolygonMesh ply;
  ASSERT_EQ(pcl::io::loadPLYFile(stem + ".ply", ply), 0);
  EXPECT_EQ(ply.cloud.width * ply.cloud.height, mesh.cloud.width * mesh.cloud.height);
  EXPECT_EQ(ply.polygons.size(), mesh.polygons.size());
  ASSERT_EQ(pcl::io::saveVTKFile(stem + ".vtk", mesh, 9), 0);
  std::ifstream vtk(stem + ".vtk");
  std::map<std::string, std::size_t> counts;
  for (std::string word; vtk >> word;) {
    if (word == "POINTS" || word == "POLYGONS") vtk >> counts[word];
  }
  EXPECT_EQ(counts["POINTS"], mesh.cloud.width * mesh.cloud.height);
  EXPECT_EQ(counts["POLYGONS"], mesh.polygons.size());
  std::remove((stem + ".ply").c_str());
  std::remove((stem + ".vtk").c_str());
}

}  // namespace
