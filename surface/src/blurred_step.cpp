// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/blurred_step.h>

#include <array>
#include <cstddef>

namespace storey::detail {
namespace {

// The function by cubics between 4096 places: exact to 1e-11.
class NormalSteps {
 public:
  NormalSteps() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double u = static_cast<double>(i) * kWidth - kFar;
      values_[i] = 0.5 * std::erfc(-u * M_SQRT1_2);
      slopes_[i] = kWidth * bellAt(u);
    }
  }

  double operator()(double u) const {
    if (!(u > -kFar)) return 0.0;
    if (u >= kFar) return 1.0;
    const double place = (u + kFar) / kWidth;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    const double rise = values_[i + 1] - values_[i];
    const double from = slopes_[i] - rise;
    const double to = rise - slopes_[i + 1];
    return values_[i] + t * (rise + (1.0 - t) * ((1.0 - t) * from + t * to));
  }

 private:
  static constexpr double kFar = 8.0;  // beyond, it is 0 or 1 to 1e-15
  static constexpr std::size_t kPlaces = 4096;
  static constexpr double kWidth = 2.0 * kFar / kPlaces;

  std::array<double, kPlaces + 1> values_;
  std::array<double, kPlaces + 1> slopes_;
};

}  // namespace

double normalStep(double u) {
  static const NormalSteps steps;
  return steps(u);
}

double stepInformation(const BlurredStep& step, double stray) {
  constexpr double kWidth = 0.05;
  double sum = 0.0;
  for (double u = -step.reach(); u <= step.reach(); u += kWidth) {
    const double slope = (1.0 - stray) * step.slopeAt(u);
    sum += slope * slope / ((1.0 - stray) * step.at(u) + stray) * kWidth;
  }
  return sum;
}

}  // namespace storey::detail
