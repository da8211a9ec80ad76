// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/main_box.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace storey::detail {
namespace {

// Places 0 to 1000 along each axis in an order of its own: the 1 % and 99 % quantiles are 10 and
// 990, their box has the diagonal 980 sqrt(3).
std::vector<Eigen::Vector3f> ladder() {
  std::vector<Eigen::Vector3f> positions(1001);
  std::mt19937 random(2);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> places(positions.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<int>(i);
    std::shuffle(places.begin(), places.end(), random);
    for (std::size_t i = 0; i < places.size(); ++i) {
      positions[i][axis] = static_cast<float>(places[i]);
    }
  }
  return positions;
}

TEST(MainBox, GoesByItsDiagonalBeyondAllButAFew) {
  const Eigen::AlignedBox3f box = mainBoxOf(ladder());
  const float around = 980.0f * std::sqrt(3.0f);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min()[axis], 10.0f - around, 1e-3f);
    EXPECT_NEAR(box.max()[axis], 990.0f + around, 1e-3f);
  }
}

TEST(MainBox, LeavesOutAFewFarAway) {
  std::vector<Eigen::Vector3f> positions = ladder();
  for (int i = 0; i < 5; ++i) positions.emplace_back(1e9f, -1e9f, 1e15f);
  const Eigen::AlignedBox3f box = mainBoxOf(positions);
  EXPECT_FALSE(box.contains(positions.back()));
  for (const Eigen::Vector3f& p : ladder()) EXPECT_TRUE(box.contains(p));
}

TEST(MainBox, HoldsAllOfTooFewToTell) {
  std::vector<Eigen::Vector3f> positions(99, Eigen::Vector3f::Zero());
  positions.emplace_back(1e6f, 0.0f, 0.0f);
  EXPECT_TRUE(mainBoxOf({positions.begin() + 1, positions.end()}).contains(positions.back()));
  EXPECT_TRUE(mainBoxOf({{1.0f, 2.0f, 3.0f}}).contains(Eigen::Vector3f(1.0f, 2.0f, 3.0f)));
  EXPECT_TRUE(mainBoxOf({}).isEmpty());
}

}  // namespace
}  // namespace storey::detail
