// SPDX-License-Identifier: BSD-3-Clause
// Records along a Morton curve are compared with a sort of all of them by their bits.
#include <gtest/gtest.h>
#include <storey/filters/detail/curve_sorting.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace storey::detail {
namespace {

using Positions = std::vector<Eigen::Vector3f>;

/// Positions that are their own records.
struct PlainPositions {
  using Record = Eigen::Vector3f;

  const Positions& positions;

  std::size_t size() const { return positions.size(); }
  const Eigen::Vector3f& position(std::size_t i) const { return positions[i]; }
  const Eigen::Vector3f& record(std::size_t i) const { return positions[i]; }
  static const Eigen::Vector3f& positionOf(const Record& record) { return record; }
};

Positions sorted(const Positions& positions, unsigned int threads = 1) {
  Positions records;
  sortAlongCurve(PlainPositions{positions}, threads, records);
  return records;
}

/// More than the parts of a curve and than a chunk of the threads, on three faces of a box.
Positions boxFaces(std::size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Positions positions;
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3f p(40.0f * unit(random), 30.0f * unit(random), 12.0f * unit(random));
    p[static_cast<Eigen::Index>(i % 3)] = 0.01f * unit(random);
    positions.push_back(p);
  }
  return positions;
}

/// The bits of the cells in turn, x last, from the first one on: by its definition.
std::uint64_t interleaved(const Eigen::Vector3f& p, double side) {
  std::uint64_t code = 0;
  for (int bit = 20; bit >= 0; --bit) {
    for (int axis = 2; axis >= 0; --axis) {
      const double cell = static_cast<double>(p[axis]) / side * ((1 << 21) - 1);
      code = code << 1 | (static_cast<std::uint64_t>(cell) >> bit & 1);
    }
  }
  return code;
}

bool isBefore(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

TEST(CurveSorting, CodesInterleaveTheBitsOfCells) {
  const MortonCurve curve(
      Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(40, 30, 12)));
  for (const Eigen::Vector3f& p : boxFaces(1000)) {
    EXPECT_EQ(curve.codeOf(p), interleaved(p, 40.0));
    EXPECT_EQ(curve.leadingBits(p, 4), interleaved(p, 40.0) >> (63 - 12));
  }
}

TEST(CurveSorting, IsTheSortByCode) {
  Positions positions = boxFaces(30000);
  positions.insert(positions.end(), 200, positions[7]);  // of one place many
  positions.emplace_back(0, 0, 0);                       // the corner and the length of the curve
  positions.emplace_back(40, 30, 12);
  Positions expected = positions;
  std::sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
    const std::uint64_t code_a = interleaved(a, 40.0);
    const std::uint64_t code_b = interleaved(b, 40.0);
    return code_a != code_b ? code_a < code_b : isBefore(a, b);
  });
  Positions records;
  const std::size_t num_distinct = sortAlongCurve(PlainPositions{positions}, 1, records);
  EXPECT_EQ(records, expected);
  EXPECT_EQ(num_distinct, positions.size() - 200);
}

TEST(CurveSorting, DependsNeitherOnTheOrderNorOnThreads) {
  Positions positions = boxFaces(30000);
  const Positions records = sorted(positions);
  std::shuffle(positions.begin(), positions.end(), std::mt19937(5));
  EXPECT_EQ(sorted(positions), records);
  EXPECT_EQ(sorted(positions, 3), records);
  EXPECT_EQ(sorted(records), records);
}

TEST(CurveSorting, LeavesOutWhatCannotBeSearched) {
  Positions positions = boxFaces(20000);
  const Positions records = sorted(positions);
  positions.insert(positions.begin() + 9, Eigen::Vector3f(1, std::nanf(""), 2));
  positions.emplace_back(std::numeric_limits<float>::infinity(), 0, 0);
  positions.emplace_back(0, 2 * kLargestCoordinate, 0);
  EXPECT_EQ(sorted(positions), records);
}

TEST(CurveSorting, NothingToSort) {
  EXPECT_TRUE(sorted({}).empty());
  EXPECT_TRUE(sorted({Eigen::Vector3f(std::nanf(""), 0, 0)}).empty());
}

// A point so far away that the others share a cell of the curve through all of it: they are in the
// order of the curve without it all the same, as neighbours in it show.
TEST(CurveSorting, AFewOutliersDoNotSpoilTheOrder) {
  for (const std::size_t n : {std::size_t{20000}, std::size_t{100000}}) {  // one part: few, many
    const auto meanStep = [n](const Positions& records) {
      double sum = 0.0;
      for (std::size_t i = 1; i < n; ++i) {
        sum += static_cast<double>((records[i] - records[i - 1]).norm());
      }
      return sum / static_cast<double>(n);
    };
    Positions positions = boxFaces(n);
    const double step = meanStep(sorted(positions));
    positions.emplace_back(1e9f, 1e9f, 1e9f);
    EXPECT_LT(meanStep(sorted(positions)), 2.0 * step);
  }
}

// Copies count where it is decided what a few outliers are. A tail of 60 places is fewer than a
// thousandth of 100,000, four copies of each are more: whether they follow each other or not must
// not matter.
TEST(CurveSorting, CopiesInAnyOrderGiveTheSame) {
  Positions positions = boxFaces(100000);
  positions.emplace_back(1e6f, 0, 0);
  const auto addTail = [&] {
    for (int i = 0; i < 60; ++i) {
      positions.emplace_back(-3000.0f, 0.5f * static_cast<float>(i), 1.0f);
    }
  };
  for (int copy = 0; copy < 4; ++copy) addTail();
  const Positions records = sorted(positions);
  std::sort(positions.begin(), positions.end(), isBefore);
  EXPECT_EQ(sorted(positions), records);
}

}  // namespace
}  // namespace storey::detail
