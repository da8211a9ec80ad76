// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/edge_index.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace storey::detail;

TEST(EdgeIndex, NoStretchWithinTheGateIsMissed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 40.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr double kGate = 0.4;
  for (const std::size_t count : {1U, 4U, 60U}) {
    std::vector<WallStretch> stretches;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle =  // some along the axes
          i % 3 == 0 ? 0.5 * M_PI * static_cast<double>(i) : 2.0 * M_PI * unit(random);
      stretches.push_back({{place(random), place(random)},
                           {std::cos(angle), std::sin(angle)},
                           20.0 * unit(random),
                           static_cast<int>(i)});
    }
    const EdgeIndex index(stretches, kGate);
    std::size_t found = 0;
    for (int draw = 0; draw < 3000; ++draw) {
      const WallStretch& near = stretches[random() % count];  // or hardly any point is near one
      const Eigen::Vector2d p = near.start + near.length * unit(random) * near.tangent +
                                2.0 * kGate * (unit(random) - 0.5) * near.normal();
      int nearest = -1;
      double best = kGate;
      for (std::size_t i = 0; i < count; ++i) {
        const WallStretch& s = stretches[i];
        const double along = (p - s.start).dot(s.tangent);
        const double across = std::abs((p - s.start).dot(s.normal()));
        if (along < 0.0 || along > s.length || across > best) continue;
        best = across;
        nearest = static_cast<int>(i);
      }
      ASSERT_EQ(index.nearest(p, Eigen::Vector2d::Zero(), 0.0), nearest);
      found += nearest >= 0 ? 1U : 0U;
    }
    EXPECT_GT(found, 2500U);
  }
  EXPECT_EQ(EdgeIndex({}, kGate).nearest({0, 0}, {0, 0}, 0.0), -1);
}

}  // namespace
