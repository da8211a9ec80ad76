// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/distinct_positions.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace storey::detail {
namespace {

constexpr int kMortonBits = 21;          // per axis, 63 in all
constexpr std::size_t kSlices = 1024;    // of an axis, to see how long it is without outliers
constexpr std::size_t kFewShare = 1000;  // a thousandth of the positions at either end
constexpr std::size_t kMuchLonger = 64;
constexpr std::size_t kPrefetched = 32;
constexpr int kDigitBits = 11;    // as many places as the cache has lines for
constexpr int kDigitsSorted = 3;  // leading ones: 11 bits for each axis

// Two zero bits after each of the lower 21 bits.
std::uint64_t spreadBits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

struct Entry {
  std::uint64_t code;
  pcl::index_t input;
};

struct Cube {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kLargestCoordinate);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-kLargestCoordinate);
};

Cube cubeAround(const std::vector<Eigen::Vector3f>& positions, unsigned int threads) {
  const Chunks chunks(positions.size());
  std::vector<Eigen::Array3f> lows(chunks.count(), Eigen::Array3f::Constant(kLargestCoordinate));
  std::vector<Eigen::Array3f> highs(chunks.count(), Eigen::Array3f::Constant(-kLargestCoordinate));
  forEachChunk(positions.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Eigen::Array3f low = lows[c];
    Eigen::Array3f high = highs[c];
    for (std::size_t i = begin; i < end; ++i) {
      if (isSearchable(positions[i])) {
        low = low.min(positions[i].array());
        high = high.max(positions[i].array());
      }
    }
    lows[c] = low;
    highs[c] = high;
  });
  Cube cube;
  for (std::size_t c = 0; c < chunks.count(); ++c) {
    cube.low = cube.low.cwiseMin(lows[c].matrix().cast<double>());
    cube.high = cube.high.cwiseMax(highs[c].matrix().cast<double>());
  }
  return cube;
}

// The part that holds all but a few of the positions on each axis, where the whole is much longer:
// a few outliers far away would leave one cell for all the others.
Cube withoutOutliers(const pcl::PointCloud<pcl::PointXYZ>& distinct, Cube cube) {
  std::vector<std::uint32_t> counts(kSlices);
  for (int axis = 0; axis < 3; ++axis) {
    while (true) {
      const double low = cube.low[axis];
      const double scale = kSlices / (cube.high[axis] - low);
      if (!std::isfinite(scale)) {
        break;
      }
      std::fill(counts.begin(), counts.end(), 0);
      std::size_t total = 0;
      for (const pcl::PointXYZ& p : distinct) {
        const double slice = (static_cast<double>(p.data[axis]) - low) * scale;
        if (slice >= 0.0 && slice <= kSlices) {
          ++counts[std::min(static_cast<std::size_t>(slice), kSlices - 1)];
          ++total;
        }
      }
      if (total == 0) {  // rounding left out the one place that nearly all share
        break;
      }
      const std::size_t few = total / kFewShare;
      std::size_t first = 0;
      std::size_t last = kSlices - 1;
      for (std::size_t n = counts[first]; n <= few; n += counts[++first]) {
      }
      for (std::size_t n = counts[last]; n <= few; n += counts[--last]) {
      }
      if (last + 1 - first > kSlices / kMuchLonger) {
        break;
      }
      cube.low[axis] = low + static_cast<double>(first) / scale;
      cube.high[axis] = low + static_cast<double>(last + 1) / scale;
    }
  }
  return cube;
}

// Of a list in chunks: where the part of each begins in what all of them leave, and the end.
std::vector<std::size_t> beginsOf(const std::vector<std::size_t>& counts) {
  std::vector<std::size_t> begins(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), begins.begin() + 1);
  return begins;
}

std::vector<Entry> codesOf(const std::vector<Eigen::Vector3f>& positions, const Cube& cube,
                           unsigned int threads) {
  const double side = (cube.high - cube.low).maxCoeff();
  constexpr double kLast = (1 << kMortonBits) - 1;
  const double scale = side > 0.0 ? kLast / side : 0.0;
  std::vector<std::size_t> counts(Chunks(positions.size()).count());
  forEachChunk(positions.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    counts[c] = static_cast<std::size_t>(
        std::count_if(positions.begin() + static_cast<std::ptrdiff_t>(begin),
                      positions.begin() + static_cast<std::ptrdiff_t>(end), isSearchable));
  });
  const std::vector<std::size_t> begins = beginsOf(counts);
  std::vector<Entry> entries(begins.back());
  forEachChunk(positions.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    std::size_t next = begins[c];
    for (std::size_t i = begin; i < end; ++i) {
      if (!isSearchable(positions[i])) continue;
      const Eigen::Array3d cell =
          ((positions[i].cast<double>() - cube.low) * scale).array().max(0.0).min(kLast);
      const std::uint64_t code = spreadBits(static_cast<std::uint64_t>(cell.x())) |
                                 spreadBits(static_cast<std::uint64_t>(cell.y())) << 1 |
                                 spreadBits(static_cast<std::uint64_t>(cell.z())) << 2;
      entries[next++] = {code, static_cast<pcl::index_t>(i)};
    }
  });
  return entries;
}

// Stable, by a digit of the code: each chunk has its own places in the result.
void sortByDigit(std::vector<Entry>& entries, int shift, unsigned int threads,
                 std::vector<Entry>& sorted) {
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  const auto digitOf = [shift](const Entry& e) {
    return static_cast<std::size_t>(e.code >> shift) & (kDigits - 1);
  };
  std::vector<std::vector<std::uint32_t>> places(Chunks(entries.size()).count());
  forEachChunk(entries.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    places[c].assign(kDigits, 0);
    for (std::size_t i = begin; i < end; ++i) {
      ++places[c][digitOf(entries[i])];
    }
  });
  std::uint32_t next = 0;
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    for (std::vector<std::uint32_t>& of_chunk : places) {
      next += std::exchange(of_chunk[digit], next);
    }
  }
  sorted.resize(entries.size());
  forEachChunk(entries.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sorted[places[c][digitOf(entries[i])]++] = entries[i];
    }
  });
  entries.swap(sorted);
}

// By code, within a code by position: first by the leading digits, then what shares these.
std::vector<Entry> mortonOrder(const std::vector<Eigen::Vector3f>& positions, const Cube& cube,
                               unsigned int threads) {
  std::vector<Entry> entries = codesOf(positions, cube, threads);
  const auto before = [&positions](const Entry& a, const Entry& b) {
    if (a.code != b.code) {
      return a.code < b.code;
    }
    const Eigen::Vector3f& p = positions[static_cast<std::size_t>(a.input)];
    const Eigen::Vector3f& q = positions[static_cast<std::size_t>(b.input)];
    return std::make_tuple(p.x(), p.y(), p.z(), a.input) <
           std::make_tuple(q.x(), q.y(), q.z(), b.input);
  };
  if (std::is_sorted(entries.begin(), entries.end(), before)) {
    return entries;  // the programs keep their points in this order
  }
  constexpr int kRest = 3 * kMortonBits - kDigitsSorted * kDigitBits;
  std::vector<Entry> sorted;
  for (int digit = 0; digit < kDigitsSorted; ++digit) {
    sortByDigit(entries, kRest + digit * kDigitBits, threads, sorted);
  }
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin + 1;
    while (end < entries.size() && entries[end].code >> kRest == entries[begin].code >> kRest) {
      ++end;
    }
    if (end - begin > 1) {
      std::sort(entries.begin() + static_cast<std::ptrdiff_t>(begin),
                entries.begin() + static_cast<std::ptrdiff_t>(end), before);
    }
    begin = end;
  }
  return entries;
}

DistinctPositions distinctInOrder(const std::vector<Eigen::Vector3f>& positions,
                                  const std::vector<Entry>& order, unsigned int threads) {
  const auto positionOf = [&](std::size_t i) -> const Eigen::Vector3f& {
    const Entry& soon = order[std::min(i + kPrefetched, order.size() - 1)];
    __builtin_prefetch(&positions[static_cast<std::size_t>(soon.input)]);  // in no order
    return positions[static_cast<std::size_t>(order[i].input)];
  };
  const auto isNew = [&](std::size_t i) {
    return i == 0 || order[i].code != order[i - 1].code ||
           positions[static_cast<std::size_t>(order[i].input)] !=
               positions[static_cast<std::size_t>(order[i - 1].input)];
  };
  std::vector<std::size_t> counts(Chunks(order.size()).count());
  forEachChunk(order.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) counts[c] += isNew(i) ? 1 : 0;
  });
  const std::vector<std::size_t> begins = beginsOf(counts);
  DistinctPositions result;
  result.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  result.cloud->resize(begins.back());
  std::vector<std::uint32_t> firsts(begins.back() + 1,
                                    static_cast<std::uint32_t>(order.size()));  // in the order
  result.id_of_input.assign(positions.size(), -1);
  forEachChunk(order.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    std::size_t next = begins[c];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f& p = positionOf(i);
      if (isNew(i)) {
        (*result.cloud)[next].getVector3fMap() = p;
        firsts[next++] = static_cast<std::uint32_t>(i);
      }
      result.id_of_input[static_cast<std::size_t>(order[i].input)] =
          static_cast<pcl::index_t>(next) - 1;
    }
  });
  result.multiplicity.resize(begins.back());
  for (std::size_t id = 0; id < begins.back(); ++id) {
    result.multiplicity[id] = firsts[id + 1] - firsts[id];
  }
  return result;
}

// Whether most positions share a cell of the curve with another.
bool areCrowded(const DistinctPositions& distinct, const std::vector<Entry>& order) {
  std::size_t num_codes = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    num_codes += i == 0 || order[i].code != order[i - 1].code ? 1 : 0;
  }
  return num_codes < distinct.cloud->size() / 2;
}

}  // namespace

DistinctPositions findDistinctPositions(const std::vector<Eigen::Vector3f>& positions,
                                        unsigned int threads) {
  const Cube cube = cubeAround(positions, threads);
  const std::vector<Entry> order = mortonOrder(positions, cube, threads);
  const DistinctPositions distinct = distinctInOrder(positions, order, threads);
  if (!areCrowded(distinct, order)) {
    return distinct;
  }
  return distinctInOrder(
      positions, mortonOrder(positions, withoutOutliers(*distinct.cloud, cube), threads), threads);
}

}  // namespace storey::detail
