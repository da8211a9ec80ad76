// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/layer_energy.h>

#include <vector>

namespace storey::detail {

/// Branch and bound over the sets of labels in use, see `minimizeLayerEnergy`.
/// \param price of a label at the start: the multiplier of the limit on their number, if there is
/// one \param known a labelling within the limit to begin with, or none
LayerLabeling branchAndBound(const LayerEnergy& energy, std::size_t max_work, double price = 0.0,
                             const std::vector<int>& known = {});

}  // namespace storey::detail
