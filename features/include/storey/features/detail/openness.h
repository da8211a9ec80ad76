// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/features/detail/wall_voxels.h>

#include <vector>

namespace storey::detail {

/// Which side of each wall patch is outside, in [-1, 1]: +1 if its `normal` points outwards, -1 if
/// inwards, 0 if nothing tells.
///
/// Rays are cast from both sides of a patch, level and upwards. A ray that leaves the grid sideways
/// has been outside all the way. One that ends below a roof has been inside. One that ends at
/// another patch comes from the same space as that side of it. One that leaves steeply says
/// outside only as far as the cloud has roofs: on the inner side of walls that the level rays
/// already decide, a roof stops them. One that ends in clutter says nothing. With e+ and e- the
/// mean outcome of the rays of both sides, s = e+ - e- is solved for all patches by iteration.
std::vector<double> findOutsides(const WallVoxels& walls, int num_threads);

}  // namespace storey::detail
