// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/level_columns.h>

#include <cmath>
#include <random>
#include <vector>

namespace storey::detail {
namespace {

const WallScale kScale{0.05, 100.0};

// A level square of points, 0.1 apart.
void addLevel(std::vector<LevelPoint>& points, double low, double high, double z, bool up) {
  for (double x = low + 0.05; x < high; x += 0.1) {
    for (double y = low + 0.05; y < high; y += 0.1) points.push_back({{x, y}, z, up});
  }
}

TEST(LevelColumns, ALevelFaceIsFoundAtItsHeight) {
  std::vector<LevelPoint> points;
  addLevel(points, 0.0, 5.0, 3.0, true);
  const LevelColumns columns = gatherLevelColumns(points, kScale);
  double area = 0.0;
  for (const LevelColumn& column : columns.columns) {
    ASSERT_EQ(column.faces.size(), 1U);
    EXPECT_NEAR(column.faces[0].z, 3.0, 1e-9);
    EXPECT_TRUE(column.faces[0].up);
    area += columns.side * columns.side;
  }
  EXPECT_NEAR(area, 25.0, 4.0 * 5.0 * columns.side);  // squares at the rim are cut
}

TEST(LevelColumns, ScatterOverManyHeightsIsNoFace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 5.0);
  std::vector<LevelPoint> points;
  for (int i = 0; i < 5000; ++i) {
    points.push_back({{place(random), place(random)}, place(random), true});
  }
  EXPECT_TRUE(gatherLevelColumns(points, kScale).columns.empty());
}

TEST(LevelColumns, GroundIsWhatLiesAtTheFeetOfWalls) {
  std::vector<LevelPoint> points;
  addLevel(points, -8.0, -1.0, 0.0, true);  // beside a house of 10 x 10
  addLevel(points, 0.0, 10.0, 12.0, true);
  std::vector<Eigen::Vector3f> walls;
  for (float s = 0.05f; s < 10.0f; s += 0.1f) {
    for (float z = 0.05f; z < 12.0f; z += 0.1f) {
      walls.emplace_back(s, 0.0f, z);
      walls.emplace_back(0.0f, s, z);
    }
  }
  LevelColumns columns = gatherLevelColumns(points, kScale);
  markGround(walls, kScale, columns);
  ASSERT_FALSE(columns.columns.empty());
  for (const LevelColumn& column : columns.columns) {
    EXPECT_EQ(column.faces[0].ground, column.faces[0].z < 6.0);
  }
}

}  // namespace
}  // namespace storey::detail
