// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "apps/building_counts.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/sampling.h"

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using storey::FloorplanLayer;
using storey::synth::Building;
using storey::synth::makeBuilding;
using storey::synth::PointSource;
using storey::synth::sampleBuilding;
using storey::synth::SampledFaces;
using storey::synth::SamplingOptions;
using storey::synth::SyntheticCloud;

constexpr double kDegree = M_PI / 180.0;

struct Expected {
  const char* name;
  std::size_t types, directions, polygons, components_at_bottom;
  double height;
};

/// Syn1-3 as the paper's tables have them; the others by counting on a sketch (walls + caps).
class NamedBuildings : public ::testing::TestWithParam<Expected> {};

TEST_P(NamedBuildings, HaveTheRightNumbers) {
  const Expected& expected = GetParam();
  const std::vector<FloorplanLayer> layers = makeBuilding(expected.name).layers;
  ASSERT_EQ(layers.size(), expected.types);
  EXPECT_EQ(storey::synth::countDirections(layers), expected.directions);
  EXPECT_EQ(layers[0].plan.components.size(), expected.components_at_bottom);
  EXPECT_DOUBLE_EQ(layers.back().z_max, expected.height);
  EXPECT_EQ(countPolygons(layers), expected.polygons);
  EXPECT_EQ(storey::extrudeFloorplans(layers).faces.size(), expected.polygons);
  EXPECT_EQ(whyInvalid(layers), "");
}

INSTANTIATE_TEST_SUITE_P(
    All, NamedBuildings,
    ::testing::Values(
        Expected{"syn1", 3, 10, 28, 1, 62.0}, Expected{"syn2", 5, 6, 42, 4, 64.0},
        Expected{"syn3", 4, 6, 22, 1, 46.0}, Expected{"box", 1, 4, 6, 1, 24.0},
        Expected{"l_shape", 1, 4, 8, 1, 20.0}, Expected{"courtyard", 1, 4, 10, 1, 18.0},
        Expected{"two_towers", 2, 4, 16, 1, 34.0}, Expected{"hexagon", 1, 6, 8, 1, 26.0},
        // 1 + 1 caps at the ends, ceiling; three walls are new, one goes through
        Expected{"overhang", 2, 4, 10, 1, 22.0},
        // two walls go through, four do not; two strips of caps
        Expected{"shifted", 2, 4, 10, 1, 24.0}, Expected{"cylinder", 1, 64, 66, 1, 30.0}),
    [](const auto& named) { return std::string(named.param.name); });

TEST(Buildings, NamesOfThePaperHaveItsNumbersOfPoints) {
  EXPECT_EQ(makeBuilding("syn1").points, 933455u);
  EXPECT_EQ(makeBuilding("syn2").points, 1578415u);
  EXPECT_EQ(makeBuilding("syn3").points, 1865931u);
}

TEST(Buildings, UnknownNamesGiveNone) {
  for (const char* name : {"", "castle", "random:", "random:x", "random:-1", "random:3 ",
                           "random:99999999999999999999"}) {
    EXPECT_TRUE(makeBuilding(name).layers.empty()) << name;
  }
}

TEST(RandomBuildings, AreValidAndOfManyKinds) {
  std::map<std::size_t, int> types;
  std::map<std::size_t, int> components;
  int with_courtyard = 0;
  int with_near_pair = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<FloorplanLayer> layers = storey::synth::randomBuilding(seed);
    ASSERT_EQ(whyInvalid(layers), "") << seed;
    const storey::PolyhedralModel model = storey::extrudeFloorplans(layers);
    EXPECT_EQ(model.faces.size(), countPolygons(layers)) << seed;
    EXPECT_TRUE(checkModel(model).ok()) << seed;
    ++types[layers.size()];
    std::size_t most = 0;
    bool courtyard = false;
    for (const FloorplanLayer& layer : layers) {
      most = std::max(most, layer.plan.components.size());
      for (const auto& component : layer.plan.components) {
        EXPECT_GE(component.outer.size(), 3u);
        EXPECT_LE(component.outer.size(), 16u);
        courtyard = courtyard || !component.holes.empty();
      }
    }
    ++components[most];
    with_courtyard += courtyard ? 1 : 0;
    with_near_pair += smallestPlaneDistance(layers) < 0.3 ? 1 : 0;
  }
  EXPECT_EQ(types.begin()->first, 1u);
  EXPECT_EQ(types.rbegin()->first, 6u);
  EXPECT_EQ(types.size(), 6u);
  EXPECT_EQ(components.size(), 4u);
  EXPECT_EQ(components.rbegin()->first, 4u);
  EXPECT_GT(with_courtyard, 5);
  EXPECT_GT(with_near_pair, 5);
}

TEST(RandomBuildings, SameSeedSameBuilding) {
  const auto a = storey::synth::randomBuilding(7);
  const auto b = storey::synth::randomBuilding(7);
  const auto c = storey::synth::randomBuilding(8);
  EXPECT_EQ(a[0].plan.components[0].outer.vertices, b[0].plan.components[0].outer.vertices);
  EXPECT_NE(a[0].plan.components[0].outer.vertices, c[0].plan.components[0].outer.vertices);
}

SamplingOptions smallOptions() {
  SamplingOptions options;
  options.points = 20000;
  return options;
}

bool isInside(const std::vector<FloorplanLayer>& layers, const Vector3d& point) {
  return std::any_of(layers.begin(), layers.end(), [&](const FloorplanLayer& layer) {
    return point.z() > layer.z_min && point.z() < layer.z_max &&
           contains(layer.plan, Vector2d(point.head<2>()));
  });
}

/// A point is on the surface, and its normal outward, if a small step along the normal leaves the
/// solid and the opposite step enters it. Steps fail only within their length of an edge of the
/// solid: with 1e-6 that is one point in millions.
TEST(Sampling, WithoutNoiseAllPointsAreOnExposedFaces) {
  for (const char* name : {"syn1", "syn2", "two_towers", "courtyard", "overhang", "random:5"}) {
    const std::vector<FloorplanLayer> layers = makeBuilding(name).layers;
    SamplingOptions options = smallOptions();
    options.noise = options.normal_noise = 0.0;
    options.faces = SampledFaces::All;
    const SyntheticCloud cloud = sampleBuilding(layers, options);
    ASSERT_EQ(cloud.size(), options.points);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector3d step = 1e-6 * cloud.normals[i];
      ASSERT_FALSE(isInside(layers, cloud.positions[i] + step)) << name << " " << i;
      ASSERT_TRUE(isInside(layers, cloud.positions[i] - step)) << name << " " << i;
    }
  }
}

/// Counts on the faces of a box are binomial: within 4.5 deviations of n times their share.
TEST(Sampling, IsUniformByArea) {
  SamplingOptions options = smallOptions();
  options.noise = options.normal_noise = 0.0;
  options.faces = SampledFaces::All;
  const SyntheticCloud cloud = sampleBuilding(makeBuilding("box").layers, options);
  const Vector3d size(20.0, 14.0, 24.0);
  const double half_area = size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  const auto n = static_cast<double>(cloud.size());
  for (int axis = 0; axis < 3; ++axis) {
    const double share = size.prod() / size[axis] / (2.0 * half_area);
    for (const double sign : {1.0, -1.0}) {
      const auto count = std::count_if(cloud.normals.begin(), cloud.normals.end(),
                                       [&](const Vector3d& m) { return m[axis] * sign > 0.5; });
      EXPECT_NEAR(static_cast<double>(count), n * share, 4.5 * std::sqrt(n * share * (1 - share)));
    }
  }
}

TEST(Sampling, FacesCanBeChosen) {
  SamplingOptions options = smallOptions();
  options.normal_noise = 0.0;
  const auto lowest_and_highest = [&](SampledFaces faces) {
    options.faces = faces;
    const SyntheticCloud cloud = sampleBuilding(makeBuilding("overhang").layers, options);
    double low = 1.0;
    double high = -1.0;
    for (const Vector3d& normal : cloud.normals) {
      low = std::min(low, normal.z());
      high = std::max(high, normal.z());
    }
    return Vector2d(low, high);
  };
  EXPECT_LT((lowest_and_highest(SampledFaces::Walls) - Vector2d(0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((lowest_and_highest(SampledFaces::WallsAndRoofs) - Vector2d(0.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((lowest_and_highest(SampledFaces::All) - Vector2d(-1.0, 1.0)).norm(), 1e-12);
}

/// With the same seed the noise is the difference to the cloud without noise. The mean of n normal
/// numbers has the deviation s / sqrt(n), their deviation s / sqrt(2 n); both within 4.5 of these.
TEST(Sampling, NoiseIsThePapers) {
  SamplingOptions options = smallOptions();
  const std::vector<FloorplanLayer> layers = makeBuilding("syn3").layers;
  const SyntheticCloud noisy = sampleBuilding(layers, options);
  options.noise = options.normal_noise = 0.0;
  const SyntheticCloud exact = sampleBuilding(layers, options);
  ASSERT_EQ(noisy.size(), exact.size());
  const auto n = static_cast<double>(noisy.size());
  Vector3d sum = Vector3d::Zero();
  Vector3d squares = Vector3d::Zero();
  double squared_angles = 0.0;
  double sum_xy = 0.0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    const Vector3d noise = noisy.positions[i] - exact.positions[i];
    sum += noise;
    squares += noise.cwiseProduct(noise);
    sum_xy += noise.x() * noise.y();
    const double sine = noisy.normals[i].cross(exact.normals[i]).norm();
    squared_angles += std::pow(std::atan2(sine, noisy.normals[i].dot(exact.normals[i])), 2);
    ASSERT_NEAR(noisy.normals[i].norm(), 1.0, 1e-12);
  }
  const double s = 0.1;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / n, 0.0, 4.5 * s / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares[axis] / n), s, 4.5 * s / std::sqrt(2.0 * n));
  }
  EXPECT_NEAR(sum_xy / n, 0.0, 4.5 * s * s / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squared_angles / n), 15.0 * kDegree,
              4.5 * 15.0 * kDegree / std::sqrt(2.0 * n));
}

TEST(Sampling, PoseMovesEverything) {
  SamplingOptions options = smallOptions();
  options.points = 500;
  const std::vector<FloorplanLayer> layers = makeBuilding("l_shape").layers;
  const SyntheticCloud plain = sampleBuilding(layers, options);
  options.pose.yaw = 0.3;
  options.pose.tilt = 5.0 * kDegree;
  options.pose.scale = 1000.0;
  options.pose.offset = Vector3d(5e5, 4e6, -20.0);
  const SyntheticCloud posed = sampleBuilding(layers, options);
  const Eigen::Matrix3d rotation = options.pose.rotation();
  EXPECT_NEAR(rotation(2, 2), std::cos(5.0 * kDegree), 1e-12);
  EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const Vector3d expected = options.pose.offset + 1000.0 * (rotation * plain.positions[i]);
    ASSERT_LT((posed.positions[i] - expected).norm(), 1e-8);
    ASSERT_LT((posed.normals[i] - rotation * plain.normals[i]).norm(), 1e-12);
  }
}

std::string fileBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(Sampling, SameSeedSameBytes) {
  SamplingOptions options = smallOptions();
  options.points = 2000;
  options.defects.missing_patches = 0.2;
  options.defects.trees = options.defects.ground = options.defects.outliers = 0.1;
  const std::vector<FloorplanLayer> layers = makeBuilding("syn2").layers;
  const std::string path = ::testing::TempDir() + "storey_same_seed.ply";
  const auto bytes = [&](std::uint64_t seed) {
    options.seed = seed;
    const SyntheticCloud cloud = sampleBuilding(layers, options);
    storey::synth::writeCloudPly(path, cloud, false, true);
    return fileBytes(path);
  };
  const std::string first = bytes(3);
  EXPECT_EQ(first, bytes(3));
  EXPECT_NE(first, bytes(4));
  std::remove(path.c_str());
}

TEST(Sampling, FarOffCloudsNeedDouble) {
  SamplingOptions options = smallOptions();
  options.points = 100;
  const std::vector<FloorplanLayer> layers = makeBuilding("box").layers;
  EXPECT_FALSE(storey::synth::needsDouble(sampleBuilding(layers, options)));
  options.pose.offset.x() = 5e5;
  EXPECT_TRUE(storey::synth::needsDouble(sampleBuilding(layers, options)));
}

TEST(Sampling, ImpossibleOptionsGiveNothing) {
  const std::vector<FloorplanLayer> layers = makeBuilding("box").layers;
  EXPECT_EQ(sampleBuilding({}, smallOptions()).size(), 0u);
  SamplingOptions options = smallOptions();
  options.noise = -1.0;
  EXPECT_EQ(sampleBuilding(layers, options).size(), 0u);
  options = smallOptions();
  options.defects.missing_patches = 1.0;
  EXPECT_EQ(sampleBuilding(layers, options).size(), 0u);
  options = smallOptions();
  options.defects.density_falloff = 0.5;
  EXPECT_EQ(sampleBuilding(layers, options).size(), 0u);
  options = smallOptions();
  options.pose.scale = NAN;
  EXPECT_EQ(sampleBuilding(layers, options).size(), 0u);
}

}  // namespace
