// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_votes.h>

#include <numeric>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::TaskCrew;
using detail::VoteTable;

constexpr int kWindow = 3;

std::vector<double> someAngles() {
  std::vector<double> angles;
  for (int a = 0; a < 36; ++a) angles.push_back(2.0 * M_PI * a / 36.0);
  return angles;
}

void expectSame(const VoteTable::Peak& found, const VoteTable::Peak& expected) {
  EXPECT_EQ(found.angle, expected.angle);
  EXPECT_EQ(found.bin, expected.bin);
  EXPECT_EQ(found.votes, expected.votes);
}

// A table that remembers peaks finds what a new one does, in which the points that are left vote.
TEST(WallVotes, TheStrongestIsThatOfANewTable) {
  const WallSampling sampling;
  const std::vector<WallPoint> points = wallsOf(box(0, 0, 12, 8), sampling, 1);
  std::mt19937 random(1);
  TaskCrew crew(3);
  TaskCrew alone(1);
  VoteTable table(points, someAngles(), sampling.noise, kWindow, crew);
  std::vector<int> voters(points.size());
  std::iota(voters.begin(), voters.end(), 0);
  table.vote(voters, 1);
  std::vector<VoteTable::Peak> struck;
  int moved = 0;
  VoteTable::Peak before;
  for (int round = 0; round < 60; ++round) {
    VoteTable fresh(points, someAngles(), sampling.noise, kWindow, alone);
    fresh.vote(voters, 1);
    for (const VoteTable::Peak& peak : struck) fresh.strikeOut(peak);
    const VoteTable::Peak peak = table.strongest();
    expectSame(peak, fresh.strongest());
    moved += peak.angle != before.angle || peak.bin != before.bin ? 1 : 0;
    before = peak;
    switch (random() % 3) {
      case 0: {  // some points are taken away, of all walls or of the strongest line
        std::vector<int> taken;
        const WallLine line = table.lineAt(peak);
        const bool of_line = random() % 2 == 0;
        const auto goes = [&](int i) {
          const WallPoint& p = points[static_cast<std::size_t>(i)];
          return random() % (of_line ? 2 : 20) == 0 &&
                 (!of_line || std::abs(line.across(p.position)) < 2.0 * sampling.noise);
        };
        std::vector<int> left;
        for (const int i : voters) (goes(i) ? taken : left).push_back(i);
        table.vote(taken, -1);
        voters = left;
        break;
      }
      case 1:
        table.strikeOut(peak);
        struck.push_back(peak);
        break;
      default:
        if (struck.empty()) break;
        const std::size_t back = 1 + random() % struck.size();
        table.takeBack(back);
        struck.resize(struck.size() - back);
    }
  }
  EXPECT_GT(moved, 20) << "weak cases";
}

}  // namespace
