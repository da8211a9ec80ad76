// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/height_histogram.h>

#include <cmath>
#include <random>

namespace {

using namespace storey::detail;

constexpr double kLow = -2.0;
constexpr double kHigh = 3.0;
constexpr double kNoise = 0.1;

std::vector<double> drawHeights(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(kLow, kHigh);
  std::vector<double> heights;
  for (std::size_t i = 0; i < count; ++i) heights.push_back(place(random));
  return heights;
}

HeightHistogram histogramOf(const std::vector<double>& heights) {
  HeightHistogram histogram(kLow, kHigh, kNoise);
  for (const double z : heights) histogram.add(z);
  return histogram;
}

// Each point has moved to the middle of its bin: by up to a sixteenth of the noise.
TEST(HeightHistogram, TellsHowManyPointsLieBelowAnyHeight) {
  const std::vector<double> heights = drawHeights(2000);
  const CountedHeights counted = histogramOf(heights).ascending();
  ASSERT_EQ(counted.total(), 2000.0);
  const auto countBelow = [&](double z) {
    double count = 0.0;
    for (const double height : heights) count += height < z;
    return count;
  };
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const double z = counted.heights[i];
    EXPECT_GE(counted.before[i], countBelow(z - kNoise / 16.0 - 1e-9)) << z;
    EXPECT_LE(counted.before[i + 1], countBelow(z + kNoise / 16.0 + 1e-9)) << z;
    EXPECT_EQ(counted.before[i + 1] - counted.before[i], counted.counts[i]);
  }
}

TEST(HeightHistogram, MirroredIsTheSameUpsideDown) {
  const HeightHistogram histogram = histogramOf(drawHeights(300));
  const CountedHeights up = histogram.ascending();
  const CountedHeights down = histogram.mirrored();
  ASSERT_EQ(up.size(), down.size());
  for (std::size_t i = 0; i < up.size(); ++i) {
    EXPECT_EQ(down.heights[i], -up.heights[up.size() - 1 - i]);
    EXPECT_EQ(down.counts[i], up.counts[up.size() - 1 - i]);
  }
}

TEST(HeightHistogram, PartsAddUpToTheWhole) {
  const std::vector<double> heights = drawHeights(500);
  HeightHistogram sum = histogramOf({heights.begin(), heights.begin() + 200});
  sum += histogramOf({heights.begin() + 200, heights.end()});
  const CountedHeights all = histogramOf(heights).ascending();
  EXPECT_EQ(sum.total(), 500U);
  EXPECT_EQ(sum.ascending().heights, all.heights);
  EXPECT_EQ(sum.ascending().counts, all.counts);
}

TEST(HeightHistogram, WithoutPointsThereIsNothing) {
  const HeightHistogram histogram(kLow, kHigh, kNoise);
  EXPECT_EQ(histogram.total(), 0U);
  EXPECT_EQ(histogram.ascending().size(), 0U);
  EXPECT_EQ(histogram.mirrored().total(), 0.0);
}

}  // namespace
