// SPDX-License-Identifier: BSD-3-Clause
// Good files of every flavour give the points that were written, here by hand or by PCL.
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "io/cloud_reader.h"
#include "io/cloud_writer.h"
#include "io/failure.h"
#include "loaded_points.h"
#include "temporary_files.h"

namespace storey {
namespace {

using io::LoadedCloud;
using io::readCloud;
using test::pointAt;
using test::TemporaryDirectory;

using Points = std::vector<Eigen::Vector3d>;

/// n points spread over a box of 40 x 30 x 12 times `scale` at `origin`.
Points boxPoints(int n, const Eigen::Vector3d& origin, double scale = 1.0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Points points;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p(40.0 * unit(random), 30.0 * unit(random), 12.0 * unit(random));
    points.push_back(origin + scale * p);
  }
  return points;
}

template <typename T>
void append(std::string& bytes, T value, bool big_endian) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// A binary PLY of points of type T with colours between and a face list after them.
template <typename T>
std::string binaryPly(const Points& points, const std::string& type, bool big_endian) {
  std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                      "_endian 1.0\ncomment x\nelement vertex " + std::to_string(points.size()) +
                      "\nproperty " + type + " x\nproperty uchar red\nproperty " + type +
                      " y\nproperty short w\nproperty " + type +
                      " z\nelement face 2\nproperty list uchar int vertex_indices\nproperty "
                      "double area\nend_header\n";
  for (const Eigen::Vector3d& p : points) {
    append(bytes, static_cast<T>(p.x()), big_endian);
    append(bytes, std::uint8_t{200}, big_endian);
    append(bytes, static_cast<T>(p.y()), big_endian);
    append(bytes, std::int16_t{-3}, big_endian);
    append(bytes, static_cast<T>(p.z()), big_endian);
  }
  for (int face = 0; face < 2; ++face) {
    append(bytes, std::uint8_t{3}, big_endian);
    for (int corner = 0; corner < 3; ++corner) append(bytes, corner, big_endian);
    append(bytes, 0.5, big_endian);
  }
  return bytes;
}

/// Largest distance between the loaded points in the file's coordinates and the expected ones.
double maxError(const LoadedCloud& loaded, const Points& expected) {
  EXPECT_EQ(loaded.declared, expected.size());
  EXPECT_EQ(loaded.cloud->size(), expected.size());
  if (loaded.cloud->size() != expected.size()) return 1e300;
  double error = 0.0;
  for (const Eigen::Vector3d& point : expected) {
    const Eigen::Vector3f local = pointAt(loaded, point).getVector3fMap();
    error = std::max(error, (local.cast<double>() + loaded.offset - point).norm());
  }
  return error;
}

std::string asciiCloud(const std::vector<std::string>& fields, const std::string& rows, int n) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(n) + "\n";
  for (const std::string& field : fields) text += "property double " + field + "\n";
  return text + "end_header\n" + rows;
}

// A float of a coordinate below 8 extents E resolves 2^-24 of 8 E: here E = 40, 2e-5.
TEST(CloudReader, DoublesKeepTheirPrecisionAtAnyOffset) {
  const TemporaryDirectory directory;
  const Eigen::Vector3d origins[] = {{0, 0, 0},
                                     {447123.456, 5411987.654, 312.5},         // UTM
                                     {1141745.25, 5391160.125, 3201808.0625},  // ECEF
                                     {-3950000.5, -1e7, 1e7}};
  for (const Eigen::Vector3d& origin : origins) {
    const Points points = boxPoints(500, origin);
    for (const bool big_endian : {false, true}) {
      const std::string path =
          directory.write("d.ply", binaryPly<double>(points, "double", big_endian));
      const LoadedCloud loaded = readCloud(path);
      EXPECT_LT(maxError(loaded, points), 2e-5) << origin.transpose();
      EXPECT_LT(maxError(loaded, points), 1e-9 * std::max(origin.norm(), 2e4));
      EXPECT_EQ(loaded.format,
                big_endian ? "ply binary_big_endian float64" : "ply binary_little_endian float64");
      EXPECT_TRUE(loaded.cloud->is_dense);
      EXPECT_FALSE(loaded.has_normals);
    }
  }
}

TEST(CloudReader, FloatsAreKeptBitForBit) {
  const TemporaryDirectory directory;
  Points points = boxPoints(500, {-10, 5, 0});
  for (Eigen::Vector3d& p : points) p = p.cast<float>().cast<double>();
  for (const bool big_endian : {false, true}) {
    const std::string path =
        directory.write("f.ply", binaryPly<float>(points, "float", big_endian));
    EXPECT_EQ(maxError(readCloud(path), points), 0.0);
  }
}

TEST(CloudReader, IntegerCoordinates) {
  const TemporaryDirectory directory;
  const Points points = {{-5, 0, 7}, {100, -32768, 32767}, {1, 2, 3}};
  const std::string path = directory.write("i.ply", binaryPly<std::int16_t>(points, "short", true));
  EXPECT_EQ(maxError(readCloud(path), points), 0.0);
}

// The offset is a round number, as large as needed for a float to resolve the cloud, at any scale.
TEST(CloudReader, OffsetIsRoundAndScaleFree) {
  const TemporaryDirectory directory;
  for (const double scale : {1e-5, 1e-3, 1.0, 1e3}) {
    const Eigen::Vector3d origin = scale * Eigen::Vector3d(44712.345, -5412.678, 3.0);
    const Points points = boxPoints(500, origin, scale);
    const LoadedCloud loaded =
        readCloud(directory.write("s.ply", binaryPly<double>(points, "double", false)));
    EXPECT_LT(maxError(loaded, points), 2e-5 * scale);
    const double unit = 10.0 * scale;  // the power of ten below the extent of 40 scale
    EXPECT_NEAR(loaded.offset.x(), 44710 * scale, 0.1 * unit);
    EXPECT_NEAR(loaded.offset.y(), -5420 * scale, 0.1 * unit);
    EXPECT_EQ(loaded.offset.z(), 0.0);
    for (const double o : loaded.offset) {
      const double steps = o / unit;
      EXPECT_NEAR(steps, std::round(steps), 1e-9 * std::abs(steps)) << o;
    }
  }
}

TEST(CloudReader, StrayPointsDoNotDecideTheOffset) {
  const TemporaryDirectory directory;
  Points points = boxPoints(1000, {489123.0, 2134567.0, 2200.0});
  points.push_back({0, 0, 0});
  points.push_back({1e7, 0, 0});
  const LoadedCloud loaded =
      readCloud(directory.write("s.ply", binaryPly<double>(points, "double", false)));
  EXPECT_NEAR(loaded.offset.x(), 489123.0, 100.0);
  EXPECT_NEAR(loaded.offset.y(), 2134567.0, 100.0);
}

TEST(CloudReader, OffsetDoesNotDependOnTheOrderOfThePoints) {
  const TemporaryDirectory directory;
  Points points = boxPoints(200000, {489123.0, 2134569.9, 2200.0});  // more than are sampled
  const auto offsetOf = [&] {
    return readCloud(directory.write("o.ply", binaryPly<double>(points, "double", false))).offset;
  };
  const Eigen::Vector3d first = offsetOf();
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  EXPECT_EQ(offsetOf(), first);
}

TEST(CloudReader, WhatPclWritesIsReadBack) {
  const TemporaryDirectory directory;
  pcl::PointCloud<pcl::PointXYZINormal> cloud;
  for (const Eigen::Vector3d& p : boxPoints(20000, {3, 4, 5})) {
    pcl::PointXYZINormal point;
    // Coarse coordinates, so that the compression finds something to refer back to.
    point.getVector3fMap() = (p.cast<float>() * 4.0f).array().round() / 4.0f;
    point.x += static_cast<float>(cloud.size()) / 65536.0f;
    point.getNormalVector3fMap() = Eigen::Vector3f(0.0f, 0.6f, -0.8f);
    point.intensity = 3.0f;
    cloud.push_back(point);
  }
  const std::string path = directory.file("pcl.pcd");
  pcl::PCDWriter writer;
  const auto check = [&](const std::string& format) {
    const LoadedCloud loaded = readCloud(path);
    EXPECT_EQ(loaded.format, format);
    EXPECT_TRUE(loaded.has_normals);
    ASSERT_EQ(loaded.cloud->size(), cloud.size());
    for (const auto& point : cloud) {
      const auto& found = pointAt(loaded, point.getVector3fMap().template cast<double>());
      ASSERT_EQ(found.getVector3fMap(), point.getVector3fMap());
      ASSERT_TRUE(found.getNormalVector3fMap().isApprox(point.getNormalVector3fMap(), 1e-6f));
    }
  };
  ASSERT_EQ(writer.writeASCII(path, cloud, 9), 0);  // 9 digits tell all floats apart
  check("pcd ascii float32");
  ASSERT_EQ(writer.writeBinary(path, cloud), 0);
  check("pcd binary float32");
  ASSERT_EQ(writer.writeBinaryCompressed(path, cloud), 0);
  check("pcd binary_compressed float32");
  io::writeCloud(path, cloud);
  check("pcd binary float32");
}

TEST(CloudReader, DuplicatesAreCollapsedInLinearTime) {
  const TemporaryDirectory directory;
  Points points(1000000, Eigen::Vector3d(1, 2, 3));
  points[10] = {4, 5, 6};
  points[500000] = {-0.0, 0.0, 0.0};
  points[999999] = {0.0, -0.0, -0.0};  // the same place
  const LoadedCloud loaded =
      readCloud(directory.write("c.ply", binaryPly<float>(points, "float", false)));
  EXPECT_EQ(loaded.cloud->size(), 3u);
  EXPECT_EQ(loaded.collapsed_duplicates, 999997u);
  EXPECT_EQ(pointAt(loaded, {4, 5, 6}).x, 4.0f);
  EXPECT_FALSE(std::signbit(pointAt(loaded, {0, 0, 0}).x));
}

TEST(CloudReader, NonFinitePointsAreDroppedAndCounted) {
  const TemporaryDirectory directory;
  const LoadedCloud loaded = readCloud(directory.write(
      "n.ply", asciiCloud({"x", "y", "z"},
                          "0 0 0\nnan 1 2\n1 0 0\n1 -inf 2\n0 1 0\n1e300 0 0\n1e30 0 0\n", 7)));
  EXPECT_EQ(loaded.declared, 7u);
  EXPECT_EQ(loaded.dropped_non_finite, 4u);  // the last two have no float distances
  EXPECT_EQ(loaded.cloud->size(), 3u);
  EXPECT_EQ(loaded.cloud->width, 3u);
  EXPECT_TRUE(loaded.cloud->is_dense);
}

TEST(CloudReader, NormalsAreScaledToUnitLengthUnderEitherName) {
  const TemporaryDirectory directory;
  for (const std::string prefix : {"n", "normal_"}) {
    const LoadedCloud loaded = readCloud(directory.write(
        "n.ply", asciiCloud({"x", "y", "z", prefix + "x", prefix + "y", prefix + "z"},
                            "0 0 0 0 3 4\n1 0 0 1e-30 0 0\n0 1 0 -1 0 0\n", 3)));
    ASSERT_TRUE(loaded.has_normals);
    EXPECT_EQ(loaded.zero_normals, 0u);
    EXPECT_FLOAT_EQ(pointAt(loaded, {0, 0, 0}).normal_y, 0.6f);
    EXPECT_FLOAT_EQ(pointAt(loaded, {0, 0, 0}).normal_z, 0.8f);
    EXPECT_EQ(pointAt(loaded, {1, 0, 0}).normal_x, 1.0f);
    EXPECT_EQ(pointAt(loaded, {0, 1, 0}).normal_x, -1.0f);
  }
}

TEST(CloudReader, AFewBadNormalsAreZeroedMoreMakeACloudWithoutNormals) {
  const TemporaryDirectory directory;
  for (const int num_bad : {0, 2, 3}) {
    std::string rows;
    for (int i = 0; i < 200; ++i) {
      const char* const normal = i >= num_bad ? " 0 0 1\n" : i == 0 ? " nan 0 1\n" : " 0 0 0\n";
      rows += std::to_string(i) + " " + std::to_string(i % 7) + " 0" + normal;
    }
    const LoadedCloud loaded = readCloud(
        directory.write("n.ply", asciiCloud({"x", "y", "z", "nx", "ny", "nz"}, rows, 200)));
    EXPECT_EQ(loaded.zero_normals, static_cast<std::size_t>(num_bad));
    EXPECT_EQ(loaded.has_normals, num_bad <= 2);  // 1 % of 200
    EXPECT_TRUE(pointAt(loaded, {0, 0, 0}).getNormalVector3fMap().allFinite());
    EXPECT_EQ(pointAt(loaded, {199, 199 % 7, 0}).normal_z, num_bad <= 2 ? 1.0f : 0.0f);
  }
}

// Neighbours on the curve are neighbours in the building, whatever the order of the file.
TEST(CloudReader, TheOrderOfTheFileDoesNotMatter) {
  const TemporaryDirectory directory;
  Points points = boxPoints(5000, {0, 0, 0});
  points.push_back(points[7]);
  const LoadedCloud one = readCloud(directory.write("a.ply", binaryPly<float>(points, "float", 0)));
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  const LoadedCloud two = readCloud(directory.write("b.ply", binaryPly<float>(points, "float", 0)));
  ASSERT_EQ(one.cloud->size(), 5000u);
  ASSERT_EQ(two.cloud->size(), 5000u);
  double length = 0.0;
  for (std::size_t i = 0; i < 5000; ++i) {
    ASSERT_EQ((*one.cloud)[i].getVector3fMap(), (*two.cloud)[i].getVector3fMap()) << i;
    if (i == 0) continue;
    length += static_cast<double>(
        ((*one.cloud)[i].getVector3fMap() - (*one.cloud)[i - 1].getVector3fMap()).norm());
  }
  // Two random points of the box are 18 apart; cubes of one point each have a side of 1.4.
  EXPECT_LT(length / 4999.0, 4.0);
}

TEST(CloudReader, AnIncompleteNormalIsNone) {
  const TemporaryDirectory directory;
  const LoadedCloud loaded = readCloud(directory.write(
      "n.ply", asciiCloud({"x", "y", "z", "nx", "ny"}, "0 0 0 1 0\n1 0 0 1 0\n0 1 0 1 0\n", 3)));
  EXPECT_FALSE(loaded.has_normals);
  EXPECT_EQ((*loaded.cloud)[0].normal_x, 0.0f);
}

TEST(RunMain, TurnsEveryEndIntoAStatusAndOneLine) {
  const auto run = [](const std::function<int()>& body, int expected) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(io::runMain("prog", body), expected);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(run([] { return 1; }, 1), "");
  EXPECT_EQ(
      run([]() -> int { throw io::Failure(io::BadInput, "a\nb.ply", "is bad", "mend it"); }, 65),
      "prog: a?b.ply: is bad; mend it\n");
  const std::string memory = run([]() -> int { throw std::bad_alloc(); }, 75);
  EXPECT_EQ(memory.rfind("prog: out of memory; ", 0), 0u);
  for (const std::string& text : {run([]() -> int { throw std::runtime_error("odd\nthing"); }, 70),
                                  run([]() -> int { throw 3; }, 70)}) {
    EXPECT_EQ(text.rfind("prog: internal error", 0), 0u);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  }
}

}  // namespace
}  // namespace storey
