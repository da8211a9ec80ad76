// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/instruction_sets.h>
#include <storey/filters/detail/surface_variation.h>

namespace storey::detail {
namespace {

constexpr int kLaguerreRounds = 10;  // three or four are enough
constexpr double kSettled = 1e-6;    // relative: the next step, a third power, would be rounding

}  // namespace

// The smallest root of the characteristic polynomial x^3 - x^2 + minors x - determinant of each
// covariance, with trace 1. All roots are real, so Laguerre's method goes up to it from 0 without
// passing it, even where roots coincide.
STOREY_EACH_INSTRUCTION_SET
void surfaceVariations(const MomentLanes& moments, double count,
                       std::array<double, kLanes>& variations) {
  const double share = 1.0 / count;
  double minors[kLanes];
  double determinants[kLanes];
  double traces[kLanes];
  double x[kLanes];
  std::int64_t is_moving[kLanes];  // no lane knows another: they stop one by one
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double sx = moments[0][i];
    const double sy = moments[1][i];
    const double sz = moments[2][i];
    const double xx = moments[3][i] - sx * sx * share;
    const double xy = moments[4][i] - sx * sy * share;
    const double xz = moments[5][i] - sx * sz * share;
    const double yy = moments[6][i] - sy * sy * share;
    const double yz = moments[7][i] - sy * sz * share;
    const double zz = moments[8][i] - sz * sz * share;
    const double trace = xx + yy + zz;
    const double unit = 1.0 / (trace > 0.0 ? trace : 1.0);
    const double minor = yy * zz - yz * yz;
    traces[i] = trace;
    minors[i] = (minor + xx * yy - xy * xy + xx * zz - xz * xz) * unit * unit;
    determinants[i] =
        (xx * minor - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)) * unit * unit * unit;
    x[i] = 0.0;
    is_moving[i] = 1;
  }
  for (int round = 0; round < kLaguerreRounds; ++round) {
    std::int64_t any = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double p = ((x[i] - 1.0) * x[i] + minors[i]) * x[i] - determinants[i];
      const double slope = (3.0 * x[i] - 2.0) * x[i] + minors[i];
      const double curvature = 6.0 * x[i] - 2.0;
      const double square = 4.0 * slope * slope - 6.0 * p * curvature;
      const double divisor = slope + __builtin_sqrt(square > 0.0 ? square : 0.0);
      const bool below = (p < 0.0) & (divisor > 0.0) & (is_moving[i] != 0);
      const double step = below ? -3.0 * p / (below ? divisor : 1.0) : 0.0;
      x[i] += step;
      is_moving[i] = step > kSettled * x[i] ? 1 : 0;
      any |= is_moving[i];
    }
    if (any == 0) {
      break;
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    variations[i] = traces[i] > 0.0 ? x[i] : -1.0;
  }
}

}  // namespace storey::detail
