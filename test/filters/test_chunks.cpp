// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/chunks.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace {

using storey::detail::forEachChunk;
using storey::detail::sumByChunks;

TEST(Chunks, EveryElementIsWorkedOnOnce) {
  for (const std::size_t size : {0U, 1U, 8192U, 8193U, 1000003U}) {
    std::vector<int> visits(size, 0);
    forEachChunk(size, 3, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), std::size_t{0}), size);
    for (const int n : visits) ASSERT_EQ(n, 1);
  }
}

TEST(Chunks, SumsAreTheSameForAnyNumberOfThreads) {
  // Sums of these depend on the order of the summands in their last digits.
  const auto sumWith = [](unsigned int threads) {
    return sumByChunks(300000, threads, std::vector<double>(2),
                       [](std::size_t begin, std::size_t end, std::vector<double>& sums) {
                         for (std::size_t i = begin; i < end; ++i) {
                           sums[i % 2] += std::sqrt(static_cast<double>(i));
                         }
                       });
  };
  const std::vector<double> one = sumWith(1);
  for (const unsigned int threads : {2U, 5U, 0U}) EXPECT_EQ(sumWith(threads), one);
  // The sum of all roots by Euler and Maclaurin: 2/3 n^1.5 - n^0.5 / 2 + zeta(-1/2).
  const double n = 300000.0;
  EXPECT_NEAR(one[0] + one[1], 2.0 / 3.0 * std::pow(n, 1.5) - 0.5 * std::sqrt(n) - 0.2078862, 1e-3);
}

}  // namespace
