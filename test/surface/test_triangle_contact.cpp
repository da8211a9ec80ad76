// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/triangle_contact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

namespace {

using namespace storey;
using detail::findContact;
using detail::LatticePoint;
using detail::LatticeTriangle;
using detail::TriangleContact;

// Brute force in floating point: the share of the segment of intersection by clipping the edges of
// each triangle against the other, on small integers where this is safe.
std::vector<Eigen::Vector3d> meetingPoints(const LatticeTriangle& a, const LatticeTriangle& b) {
  const auto vec = [](const LatticePoint& p) {
    return Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]),
                           static_cast<double>(p[2]));
  };
  std::vector<Eigen::Vector3d> points;
  const auto collect = [&](const LatticeTriangle& s, const LatticeTriangle& t) {
    const Eigen::Vector3d o = vec(t[0]);
    const Eigen::Vector3d n = (vec(t[1]) - o).cross(vec(t[2]) - o);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = vec(s[i]);
      const Eigen::Vector3d q = vec(s[(i + 1) % 3]);
      const double dp = n.dot(p - o);
      const double dq = n.dot(q - o);
      if (dp * dq > 0.0 || dp == dq) continue;
      const Eigen::Vector3d x = p + dp / (dp - dq) * (q - p);
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d u = vec(t[k]);
        const Eigen::Vector3d v = vec(t[(k + 1) % 3]);
        inside = inside && n.dot((v - u).cross(x - u)) > -1e-7;
      }
      if (inside) points.push_back(x);
    }
  };
  collect(a, b);
  collect(b, a);
  return points;
}

TEST(TriangleContact, AgreesWithBruteForce) {
  std::mt19937 random(3);
  int counts[4] = {0, 0, 0, 0};
  for (int i = 0; i < 200000; ++i) {
    LatticeTriangle t[2];
    for (LatticeTriangle& triangle : t) {
      for (LatticePoint& p : triangle) {
        for (std::int64_t& x : p) x = static_cast<std::int64_t>(random() % 5);
      }
    }
    const auto normal = [](const LatticeTriangle& s) {
      Eigen::Vector3d e[2];
      for (int k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < 3; ++j) {
          e[k][static_cast<int>(j)] =
              static_cast<double>(s[static_cast<std::size_t>(k) + 1][j] - s[0][j]);
        }
      }
      return Eigen::Vector3d(e[0].cross(e[1]));
    };
    if (normal(t[0]).norm() == 0.0 || normal(t[1]).norm() == 0.0) continue;
    const TriangleContact contact = findContact(t[0], t[1]);
    ++counts[contact.kind];
    EXPECT_EQ(findContact(t[1], t[0]).kind, contact.kind);
    if (normal(t[0]).cross(normal(t[1])).norm() == 0.0) continue;  // parallel: see the next test
    double length = 0.0;
    const std::vector<Eigen::Vector3d> points = meetingPoints(t[0], t[1]);
    for (const Eigen::Vector3d& p : points) length = std::max(length, (p - points[0]).norm());
    const TriangleContact::Kind expected = points.empty()  ? TriangleContact::Nothing
                                           : length < 1e-6 ? TriangleContact::Point
                                                           : TriangleContact::Segment;
    ASSERT_EQ(contact.kind, expected) << i;
  }
  for (const int count : counts) EXPECT_GT(count, 10);
}

TEST(TriangleContact, CoplanarTriangles) {
  const LatticeTriangle t = {{{0, 0, 7}, {4, 0, 7}, {0, 4, 7}}};
  EXPECT_EQ(findContact(t, t).kind, TriangleContact::Area);
  EXPECT_EQ(findContact(t, {{{4, 0, 7}, {4, 4, 7}, {0, 4, 7}}}).kind, TriangleContact::Nothing);
  EXPECT_EQ(findContact(t, {{{1, 1, 7}, {2, 1, 7}, {1, 2, 7}}}).kind, TriangleContact::Area);
  EXPECT_EQ(findContact(t, {{{4, 4, 7}, {1, 1, 7}, {4, 3, 7}}}).kind, TriangleContact::Area);
  EXPECT_EQ(findContact(t, {{{0, 0, 8}, {4, 0, 8}, {0, 4, 8}}}).kind, TriangleContact::Nothing);
}

TEST(TriangleContact, NamesTheEdge) {
  const LatticeTriangle floor = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const TriangleContact on_edge = findContact(floor, {{{1, 0, 0}, {3, 0, 0}, {2, 0, 5}}});
  EXPECT_EQ(on_edge.kind, TriangleContact::Segment);
  EXPECT_EQ(on_edge.edge_of_first, 0);
  EXPECT_EQ(on_edge.edge_of_second, 0);
  const TriangleContact inside = findContact(floor, {{{1, 1, -1}, {2, 1, -1}, {1, 1, 5}}});
  EXPECT_EQ(inside.kind, TriangleContact::Segment);
  EXPECT_EQ(inside.edge_of_first, -1);
  EXPECT_EQ(inside.edge_of_second, -1);
}

}  // namespace
