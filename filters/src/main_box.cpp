// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/main_box.h>

#include <algorithm>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr std::size_t kFewShare = 100;  // a hundredth of the points at either end

}  // namespace

Eigen::AlignedBox3f mainBoxOf(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::AlignedBox3f box;
  if (positions.empty()) return box;
  const std::size_t few = positions.size() / kFewShare;
  std::vector<float> values(positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(positions.begin(), positions.end(), values.begin(),
                   [axis](const Eigen::Vector3f& p) { return p[axis]; });
    const auto quantile = [&values](std::size_t rank) {
      const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
      std::nth_element(values.begin(), place, values.end());
      return *place;
    };
    box.min()[axis] = quantile(few);
    box.max()[axis] = quantile(values.size() - 1 - few);
  }
  const Eigen::Vector3f around = Eigen::Vector3f::Constant(box.diagonal().norm());
  return {box.min() - around, box.max() + around};
}

}  // namespace storey::detail
