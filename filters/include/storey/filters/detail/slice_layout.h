// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/cloud_scale.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace storey::detail {

/// max(10 noise, 30 / (density x extent / 50)); 0 where the scale is unknown.
double deriveSliceThickness(const CloudScale& scale);

/// Heights between which slices are cut: the 0.1 % and 99.9 % quantiles, widened by 5 % of their
/// distance, within the lowest and highest. `heights` must not be empty; it is reordered.
std::pair<double, double> robustHeightRange(std::vector<double>& heights);

/// Slices of exactly `thickness` > 0 from the range's lower end until its upper end is inside.
/// Empty if that takes more than `max_slices`.
std::vector<std::pair<double, double>> stackSlices(const std::pair<double, double>& range,
                                                   double thickness, std::size_t max_slices);

/// As many equal slices as fit into the range with at least `min_thickness` each: 1 to 1000.
std::vector<std::pair<double, double>> divideIntoSlices(const std::pair<double, double>& range,
                                                        double min_thickness);

/// Number of the slice at height z, or -1. `slices` must be equally thick and stacked.
std::ptrdiff_t sliceAt(const std::vector<std::pair<double, double>>& slices, double z);

}  // namespace storey::detail
