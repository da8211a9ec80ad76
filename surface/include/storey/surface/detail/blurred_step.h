// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace storey::detail {

constexpr double kStepReach = 8.0;   // noise deviations: beyond, a step is 0 or 1
constexpr double kTailFactor = 5.0;  // noise of the points of heavy tails over that of the others
constexpr double kTailReach = 15.0;  // noise deviations that they reach

/// The density of the normal distribution.
inline double bellAt(double u) {
  constexpr double kInvSqrt2Pi = 0.3989422804014327;
  return kInvSqrt2Pi * std::exp(-0.5 * u * u);
}

/// The normal distribution function, exact to 1e-11.
double normalStep(double u);

/// The integral of the step's tail beyond u.
inline double beyondStep(double u) { return bellAt(u) - u * normalStep(-u); }

/// A step as the noise shows it, u in noise deviations.
struct BlurredStep {
  double noise = 0.0;
  double tails = 0.0;  // share of the points that err kTailFactor times as much

  double reach() const { return tails > 0.0 ? kTailReach : kStepReach; }
  double at(double u) const {
    if (tails == 0.0) return normalStep(u);
    return (1.0 - tails) * normalStep(u) + tails * normalStep(u / kTailFactor);
  }
  double slopeAt(double u) const {
    if (tails == 0.0) return bellAt(u);
    return (1.0 - tails) * bellAt(u) + tails * bellAt(u / kTailFactor) / kTailFactor;
  }
  // Points of the tails between two distances beyond the step, for a density of 1.
  double tailsBetween(double from, double to) const {
    const double scale = kTailFactor * noise;
    return tails * scale * (beyondStep(from / scale) - beyondStep(to / scale));
  }
};

/// The integral of ((1 - stray) S')^2 / ((1 - stray) S + stray): 0.9032 without strays and tails.
double stepInformation(const BlurredStep& step, double stray);

}  // namespace storey::detail
