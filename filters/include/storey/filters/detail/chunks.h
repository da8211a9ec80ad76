// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// Parts of equal length of a list. Their number depends on that of the elements alone, so that
/// what is summed within each, and then over all in order, is the same for any number of threads.
class Chunks {
 public:
  explicit Chunks(std::size_t size)
      : size_(size), length_(std::max(kLeastLength, (size + kMost - 1) / kMost)) {}

  std::size_t count() const { return (size_ + length_ - 1) / length_; }
  std::size_t begin(std::size_t chunk) const { return chunk * length_; }
  std::size_t end(std::size_t chunk) const { return std::min(size_, begin(chunk) + length_); }

 private:
  static constexpr std::size_t kMost = 32;
  static constexpr std::size_t kLeastLength = 8192;

  std::size_t size_;
  std::size_t length_;
};

/// Calls `work(chunk, begin, end)` for all chunks of a list of this size, in several threads.
template <typename Work>
void forEachChunk(std::size_t size, unsigned int threads, const Work& work) {
  const Chunks chunks(size);
  const auto count = static_cast<std::ptrdiff_t>(chunks.count());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1) if (count > 1)
  for (std::ptrdiff_t c = 0; c < count; ++c) {
    const auto chunk = static_cast<std::size_t>(c);
    work(chunk, chunks.begin(chunk), chunks.end(chunk));
  }
}

/// Sums what `work(begin, end, sums)` adds to a list of as many sums as `zero` has, each with `+=`.
template <typename Sum, typename Work>
std::vector<Sum> sumByChunks(std::size_t size, unsigned int threads, const std::vector<Sum>& zero,
                             const Work& work) {
  std::vector<std::vector<Sum>> parts(Chunks(size).count());
  forEachChunk(size, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    parts[chunk] = zero;
    work(begin, end, parts[chunk]);
  });
  std::vector<Sum> sums = zero;
  for (const std::vector<Sum>& part : parts) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += part[i];
  }
  return sums;
}

}  // namespace storey::detail
