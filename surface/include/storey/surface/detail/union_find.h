// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace storey {
namespace detail {

/// Disjoint sets of 0 ... n - 1. The representative of a set is its smallest member, so results
/// do not depend on the order of the unions.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int i) {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }

  void unite(int i, int j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent(high) = low;
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<int> parent_;
};

}  // namespace detail
}  // namespace storey
