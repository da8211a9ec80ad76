// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/assignment.h>

#include <cstddef>
#include <limits>

namespace storey::detail {

// Rows are inserted one by one; each insertion is a shortest augmenting path by Dijkstra over the
// reduced costs cost(i, j) - u(i) - v(j) >= 0. Row and column 0 are sentinels.
std::vector<int> solveAssignment(const std::vector<double>& cost, int n) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> u(size + 1, 0.0);
  std::vector<double> v(size + 1, 0.0);
  std::vector<std::size_t> row_of(size + 1, 0);
  std::vector<std::size_t> previous(size + 1, 0);
  for (std::size_t row = 1; row <= size; ++row) {
    std::vector<double> distance(size + 1, std::numeric_limits<double>::infinity());
    std::vector<char> done(size + 1, 0);
    std::size_t column = 0;
    row_of[0] = row;
    do {
      done[column] = 1;
      const std::size_t i = row_of[column];
      double delta = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= size; ++j) {
        if (done[j]) continue;
        const double reduced = cost[(i - 1) * size + (j - 1)] - u[i] - v[j];
        if (reduced < distance[j]) {
          distance[j] = reduced;
          previous[j] = column;
        }
        if (distance[j] < delta) {
          delta = distance[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= size; ++j) {
        if (done[j]) {
          u[row_of[j]] += delta;
          v[j] -= delta;
        } else {
          distance[j] -= delta;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {
      row_of[column] = row_of[previous[column]];
      column = previous[column];
    }
  }
  std::vector<int> assigned(size, -1);
  for (std::size_t j = 1; j <= size; ++j) assigned[row_of[j] - 1] = static_cast<int>(j) - 1;
  return assigned;
}

}  // namespace storey::detail
