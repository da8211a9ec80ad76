// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "io/cloud_reader.h"
#include "io/failure.h"
#include "io/raw_cloud.h"
#include "reconstruct/pipeline.h"
#include "stages/parts.h"
#include "stages/stage_cloud_io.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/sampling.h"
#include "temporary_files.h"

namespace storey {
namespace {

using test::TemporaryDirectory;
using Place = std::array<float, 3>;

synth::SyntheticCloud sample(std::size_t points) {
  synth::SamplingOptions sampling;
  sampling.points = points;
  return synth::sampleBuilding(synth::makeBuilding("l_shape").layers, sampling);
}

void add(const Eigen::Vector3d& position, std::size_t times, synth::SyntheticCloud& cloud) {
  cloud.positions.insert(cloud.positions.end(), times, position);
  cloud.normals.insert(cloud.normals.end(), times, Eigen::Vector3d::UnitX());
}

io::LoadedCloud readThinned(const std::string& path, std::uint64_t max_points) {
  io::CloudReaderOptions options;
  options.limits.max_points = max_points;
  return io::readCloud(path, options);
}

std::vector<Place> placesOf(const io::LoadedCloud& loaded) {
  std::vector<Place> places;
  for (const pcl::PointNormal& p : *loaded.cloud) places.push_back({p.x, p.y, p.z});
  return places;
}

/// The points of a cloud that are at some places, in its order.
synth::SyntheticCloud pointsAt(const std::vector<Place>& places,
                               const synth::SyntheticCloud& cloud) {
  const std::set<Place> wanted(places.begin(), places.end());
  synth::SyntheticCloud part;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = cloud.positions[i].cast<float>();
    if (wanted.count({p.x(), p.y(), p.z()}) == 0) continue;
    part.positions.push_back(cloud.positions[i]);
    part.normals.push_back(cloud.normals[i]);
    part.sources.push_back(cloud.sources[i]);
  }
  return part;
}

reconstruct::Result reconstructFile(const std::string& path, int max_points) {
  reconstruct::Options options;
  options.input = path;
  options.max_points = max_points;
  return reconstruct::reconstruct(options);
}

// Each step leaves out an eighth: more than 7/8 of the limit stay, but for chance (100 points are
// more than ten deviations of the number below a limit).
TEST(Thinning, KeepsAboutTheLimit) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  synth::writeCloudPly(path, sample(20000), false, true);
  const io::LoadedCloud whole = io::readCloud(path);
  const io::LoadedCloud thinned = readThinned(path, 2000);
  EXPECT_LE(thinned.cloud->size(), 2000u);
  EXPECT_GE(thinned.cloud->size(), 1650u);
  EXPECT_EQ(thinned.declared, 20000u);
  EXPECT_EQ(thinned.thinned_out, 20000u - thinned.cloud->size());
  const std::vector<Place> all = placesOf(whole);
  for (const Place& place : placesOf(thinned)) {
    ASSERT_NE(std::find(all.begin(), all.end(), place), all.end());
  }
  EXPECT_EQ(readThinned(path, 20000).cloud->size(), whole.cloud->size());
}

TEST(Thinning, DoesNotDependOnTheOrderOfThePoints) {
  const TemporaryDirectory directory;
  synth::SyntheticCloud cloud = sample(20000);
  synth::writeCloudPly(directory.file("a.ply"), cloud, false, false);
  std::mt19937 random(5);
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), random);
  synth::writeCloudPly(directory.file("b.ply"), cloud, false, false);
  const auto placesIn = [&](const char* name) {
    return placesOf(readThinned(directory.file(name), 1500));
  };
  EXPECT_EQ(placesIn("a.ply"), placesIn("b.ply"));
}

// What a scanner writes where nothing came back: of twenty such places, whatever their hash, some
// are below the limit of the sample and some are not.
TEST(Thinning, CopiesOfAPointCountOnce) {
  const TemporaryDirectory directory;
  synth::SyntheticCloud cloud = sample(20000);
  for (int place = 0; place < 20; ++place) add(Eigen::Vector3d(0.0, 0.0, place), 1, cloud);
  synth::writeCloudPly(directory.file("once.ply"), cloud, false, true);
  for (int place = 0; place < 20; ++place) add(Eigen::Vector3d(0.0, 0.0, place), 3000, cloud);
  synth::writeCloudPly(directory.file("last.ply"), cloud, false, true);
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  synth::writeCloudPly(directory.file("first.ply"), cloud, false, true);
  for (const std::uint64_t limit : {1500, 6000}) {
    const auto placesIn = [&](const char* name) {
      return placesOf(readThinned(directory.file(name), limit));
    };
    const std::vector<Place> places = placesIn("once.ply");
    EXPECT_GT(places.size(), limit * 3 / 4);
    EXPECT_EQ(placesIn("last.ply"), places);
    EXPECT_EQ(placesIn("first.ply"), places);
  }
}

// Of each half of the building (in x) as large a share as of the whole, to four deviations.
TEST(Thinning, IsFair) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  synth::writeCloudPly(path, sample(20000), false, true);
  const auto shareBelow = [](const std::vector<Place>& places, float x) {
    const auto below = std::count_if(places.begin(), places.end(),
                                     [=](const Place& place) { return place[0] < x; });
    return static_cast<double>(below) / static_cast<double>(places.size());
  };
  const std::vector<Place> all = placesOf(io::readCloud(path));
  const std::vector<Place> some = placesOf(readThinned(path, 4000));
  for (const float x : {-8.0f, -2.0f, 3.0f, 9.0f}) {
    const double share = shareBelow(all, x);
    const double deviation = std::sqrt(share * (1.0 - share) / static_cast<double>(some.size()));
    EXPECT_NEAR(shareBelow(some, x), share, 4.0 * deviation) << x;
  }
}

TEST(Thinning, MemoryIsThatOfThePointsKept) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  synth::writeCloudPly(path, sample(20000), false, true);
  io::CloudReaderOptions options;
  options.limits.bytes_per_point = 450;
  options.limits.max_memory = 450 * 2000;
  EXPECT_THROW(io::readCloud(path, options), io::Failure);
  options.limits.max_points = 2000;
  EXPECT_LE(io::readCloud(path, options).cloud->size(), 2000u);
}

// A sample of less than a cloud is not the fault of the file.
TEST(Thinning, TooFewPointsKept) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  synth::writeCloudPly(path, sample(20000), false, true);
  try {
    readThinned(path, 1);
    FAIL() << "a point is no cloud";
  } catch (const io::Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("keep more of them"), std::string::npos);
  }
}

// Part by part a file gives all its points, in its order.
TEST(Thinning, PartsAreTheWholeFile) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  const synth::SyntheticCloud cloud = sample(20000);
  synth::writeCloudPly(path, cloud, true, true);
  for (const std::uint64_t size : {1U, 3000U, 5000U, 20000U, 30000U}) {
    std::vector<double> positions;
    std::vector<float> normals;
    const auto take = [&](const io::RawCloud& part) {
      EXPECT_LE(part.size(), size);
      positions.insert(positions.end(), part.positions.begin(), part.positions.end());
      normals.insert(normals.end(), part.normals.begin(), part.normals.end());
    };
    io::ReadLimits limits;
    limits.max_points = size;
    limits.take_part = take;
    io::InputFile file(path, io::kDefaultMaxFileBytes);
    take(io::readRawCloud(file, limits));
    ASSERT_EQ(positions.size(), 3 * cloud.size());
    ASSERT_EQ(normals.size(), 3 * cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_EQ(positions[3 * i], cloud.positions[i].x());
      ASSERT_EQ(normals[3 * i + 2], static_cast<float>(cloud.normals[i].z()));
    }
  }
}

// The second reading leaves out what the first does: copies, what is no point, and what is too far.
TEST(Thinning, PartsAreOfDistinctPoints) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  synth::SyntheticCloud cloud = sample(20000);
  const std::vector<Eigen::Vector3d> once = cloud.positions;
  add(once.front(), 30000, cloud);
  add(Eigen::Vector3d(1e30, 0.0, 0.0), 1, cloud);
  add(Eigen::Vector3d(std::nan(""), 0.0, 0.0), 1, cloud);
  synth::writeCloudPly(path, cloud, false, true);
  io::LoadedCloud loaded = readThinned(path, 2000);
  const stages::StageCloud sampled = stages::fromLoaded(loaded, path);
  const stages::PartSource parts = stages::partsOf(loaded, sampled, {}, 1);
  ASSERT_TRUE(parts);
  std::set<Place> places;
  std::size_t count = 0;
  parts([&](const stages::Cloud& part) {
    for (const pcl::PointNormal& p : part) places.insert({p.x, p.y, p.z});
    count += part.size();
  });
  EXPECT_EQ(count, once.size());
  std::set<Place> expected;
  for (const Eigen::Vector3d& p : once) {
    const Eigen::Vector3f q = p.cast<float>();
    expected.insert({q.x(), q.y(), q.z()});
  }
  EXPECT_EQ(places, expected);
}

// A tenth of the points tells the polygons of the model, and all of them where they are. A file
// that does not come in parts (its normals are estimated) gives the very model of a file of just
// that tenth.
TEST(Thinning, ModelIsThatOfAllPoints) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud.ply");
  const std::string part = directory.file("part.ply");
  const synth::SyntheticCloud cloud = sample(300000);
  synth::writeCloudPly(path, cloud, false, true);
  const PolyhedralModel whole = reconstructFile(path, 0).model.model;
  const reconstruct::Result thinned = reconstructFile(path, 30000);
  const PolyhedralModel& model = thinned.model.model;
  EXPECT_TRUE(thinned.fitted_to_all);
  EXPECT_TRUE(thinned.model.check.ok());
  EXPECT_EQ(model.faces.size(), whole.faces.size());
  EXPECT_EQ(model.vertices.size(), whole.vertices.size());
  // The smallest wall has 30,000 points: its plane is known to noise / sqrt(30000) in the middle
  // and to twice that at its ends, where it meets another one. Both models know it so, and the one
  // from a tenth would be off by three times as much.
  const double far = 2.0 * std::sqrt(2.0) * 0.1 / std::sqrt(30000.0);
  for (const Eigen::Vector3d& vertex : model.vertices) {
    double nearest = 1e9;
    for (const Eigen::Vector3d& other : whole.vertices) {
      nearest = std::min(nearest, (vertex - other).norm());
    }
    EXPECT_LT(nearest, far);
  }
  synth::writeCloudPly(path, cloud, false, false);
  synth::writeCloudPly(part, pointsAt(placesOf(readThinned(path, 30000)), cloud), false, false);
  const reconstruct::Result just_part = reconstructFile(path, 30000);
  EXPECT_FALSE(just_part.fitted_to_all);
  EXPECT_EQ(just_part.model.model.vertices, reconstructFile(part, 0).model.model.vertices);
}

}  // namespace
}  // namespace storey
