// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/layer_energy.h>

#include <vector>

namespace storey::detail {

/// Branch and bound over the sets of labels in use, see `minimizeLayerEnergy`.
/// \param price of a label: the multiplier of the limit on their number, if there is one; any is
/// right, the better it is the fewer branches \param known a labelling to begin with, or none
LayerLabeling branchAndBound(const LayerEnergy& energy, std::size_t max_work, double price = 0.0,
                             const std::vector<int>& known = {});

}  // namespace storey::detail
