// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// One point of the trade-off between what a model explains and how simple it is.
struct OutlineTradeOff {
  double face_cost = 0.0;  ///< wall area that each face of it explains at least
  double energy = 0.0;     ///< sum of the blocks' energies, in units of wall area
  std::size_t faces = 0;   ///< `countFaces`
  std::size_t types = 0;   ///< different floorplans
};

struct SimplicityLimits {
  std::size_t max_faces = 0;  ///< 0: no limit
  std::size_t max_types = 0;  ///< 0: no limit
  bool whole_front = false;   ///< go on to the simplest model, for the trade-off alone
};

/// Prunes the outlines at a rising cost of a face until the limits are kept, or the cost is more
/// than any two models differ by; there, all blocks are made one. \param face_cost what the blocks
/// were pruned with so far, > 0 \param blocks simplified in place as far as the limits ask \return
/// what was met on the way, from the given blocks on; each with fewer faces than the one before
std::vector<OutlineTradeOff> simplifyOutlines(const LineArrangement& plan, double gap,
                                              double face_cost, const SimplicityLimits& limits,
                                              std::vector<CellBlock>& blocks,
                                              unsigned int threads = 0);

}  // namespace storey::detail
