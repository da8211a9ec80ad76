// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// Factors, for each photo a red, green and blue one, that make photos agree about the blocks they
/// share. Of each pair of photos the median d_kl of the logarithms of their ratios over at most
/// 20,000 blocks of all facades (what hides a part of them is no more than outliers of it), with
/// s_kl its scatter, then the most likely logarithms g of the factors,
///     min sum_kl (g_k - g_l + d_kl)^2 / (0.02^2 + s_kl^2) + sum_k g_k^2 / 0.3^2,
/// which change the photos as little as need be.
std::vector<Eigen::Array3f> levelExposures(
    const std::vector<std::vector<std::vector<BlockView>>>& views, std::size_t num_photos);

}  // namespace storey::detail
