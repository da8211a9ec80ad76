// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

namespace storey::detail {

/// Sums over points about a line: of their places along it (s) and across it (d), and of the parts
/// of their unit normals along it (t).
struct WallMoments {
  double n = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0, t = 0.0, tt = 0.0;

  /// One point. \param along its place along the line, from wherever the sums count
  static WallMoments of(const WallPoint& p, double along, const WallLine& line) {
    const double across = line.across(p.position);
    const double turn = line.tangent().dot(p.normal);
    return {1.0, along, across, along * along, along * across, turn, turn * turn};
  }
  /// Of the place alone.
  static WallMoments ofPlace(double along, double across) {
    return {1.0, along, across, along * along, along * across, 0.0, 0.0};
  }
  void add(const WallMoments& m) {
    n += m.n, s += m.s, d += m.d, ss += m.ss, sd += m.sd, t += m.t, tt += m.tt;
  }
  WallMoments operator-(const WallMoments& m) const {
    return {n - m.n, s - m.s, d - m.d, ss - m.ss, sd - m.sd, t - m.t, tt - m.tt};
  }

  double spread() const { return n > 0.0 ? ss - s * s / n : 0.0; }
  /// Of the line d(s) of least squares, where `spread` > 0.
  double slope() const { return (sd - s * d / n) / spread(); }
};

}  // namespace storey::detail
