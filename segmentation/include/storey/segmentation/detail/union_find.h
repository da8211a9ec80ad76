// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace storey::detail {

/// Disjoint sets of 0 ... n - 1. The representative of a set is its smallest member, so results
/// do not depend on the order of the unions.
/// \tparam Index the integer type that the caller numbers things with
template <typename Index = std::size_t>
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  Index find(Index i) {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }

  void unite(Index i, Index j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent(high) = low;
  }

 private:
  Index& parent(Index i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<Index> parent_;
};

}  // namespace storey::detail
