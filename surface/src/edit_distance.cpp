// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/floorplan_grammar.h>

#include <algorithm>
#include <numeric>

namespace storey {

std::size_t editDistance(const std::vector<int>& a, const std::vector<int>& b, int never_equal) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1] && a[i - 1] != never_equal;
      const std::size_t substituted = diagonal + (same ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::size_t cyclicEditDistance(const std::vector<int>& a, const std::vector<int>& b,
                               int never_equal) {
  const std::vector<int>& longer = a.size() >= b.size() ? a : b;
  std::vector<int> rotated = a.size() >= b.size() ? b : a;  // fewer rotations
  const std::size_t floor = longer.size() - rotated.size();
  std::size_t best = editDistance(longer, rotated, never_equal);
  for (std::size_t i = 1; i < rotated.size() && best > floor; ++i) {
    std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
    best = std::min(best, editDistance(longer, rotated, never_equal));
  }
  return best;
}

}  // namespace storey
