// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/distinct_positions.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace storey::detail {
namespace {

constexpr int kMortonBits = 21;          // per axis, 63 in all
constexpr std::size_t kSlices = 1024;    // of an axis, to see how long it is without outliers
constexpr std::size_t kFewShare = 1000;  // a thousandth of the positions at either end
constexpr std::size_t kMuchLonger = 64;
constexpr std::size_t kPrefetched = 32;
constexpr int kMostBucketBits = 24;
constexpr std::size_t kPerBucket = 4;  // leading bits for so many positions in a bucket

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

Cube cubeAround(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::Array3f low = Eigen::Array3f::Constant(kLargestCoordinate);
  Eigen::Array3f high = -low;
  for (const Eigen::Vector3f& p : positions) {
    if (isSearchable(p)) {
      low = low.min(p.array());
      high = high.max(p.array());
    }
  }
  return {low.cast<double>(), high.cast<double>()};
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

std::vector<Entry> codesOf(const std::vector<Eigen::Vector3f>& positions, const Cube& cube) {
  const double side = (cube.high - cube.low).maxCoeff();
  constexpr double kLast = (1 << kMortonBits) - 1;
  const double scale = side > 0.0 ? kLast / side : 0.0;
  std::vector<Entry> entries;
  entries.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (isSearchable(positions[i])) {
      const Eigen::Array3d cell =
          ((positions[i].cast<double>() - cube.low) * scale).array().max(0.0).min(kLast);
      const std::uint64_t code = spreadBits(static_cast<std::uint64_t>(cell.x())) |
                                 spreadBits(static_cast<std::uint64_t>(cell.y())) << 1 |
                                 spreadBits(static_cast<std::uint64_t>(cell.z())) << 2;
      entries.push_back({code, static_cast<pcl::index_t>(i)});
    }
  }
  return entries;
}

// By code, within a code by position: first into buckets of the leading bits, then each by itself.
std::vector<Entry> mortonOrder(const std::vector<Eigen::Vector3f>& positions, const Cube& cube) {
  const std::vector<Entry> entries = codesOf(positions, cube);
  int bits = 1;
  while (bits < kMostBucketBits && (std::size_t{1} << bits) < entries.size() / kPerBucket) {
    ++bits;
  }
  const int shift = 3 * kMortonBits - bits;
  std::vector<std::uint32_t> begins((std::size_t{1} << bits) + 1, 0);
  for (const Entry& e : entries) {
    ++begins[(e.code >> shift) + 1];
  }
  for (std::size_t b = 1; b < begins.size(); ++b) {
    begins[b] += begins[b - 1];
  }
  std::vector<Entry> sorted(entries.size());
  std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
  for (const Entry& e : entries) {
    sorted[ends[e.code >> shift]++] = e;
  }
  const auto before = [&positions](const Entry& a, const Entry& b) {
    if (a.code != b.code) {
      return a.code < b.code;
    }
    const Eigen::Vector3f& p = positions[static_cast<std::size_t>(a.input)];
    const Eigen::Vector3f& q = positions[static_cast<std::size_t>(b.input)];
    return std::make_tuple(p.x(), p.y(), p.z(), a.input) <
           std::make_tuple(q.x(), q.y(), q.z(), b.input);
  };
  for (std::size_t b = 0; b + 1 < begins.size(); ++b) {
    std::sort(sorted.begin() + begins[b], sorted.begin() + begins[b + 1], before);
  }
  return sorted;
}

DistinctPositions distinctInOrder(const std::vector<Eigen::Vector3f>& positions,
                                  const std::vector<Entry>& order) {
  DistinctPositions result;
  result.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  result.cloud->reserve(order.size());
  result.multiplicity.reserve(order.size());
  result.id_of_input.assign(positions.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Entry& e = order[i];
    const Entry& soon = order[std::min(i + kPrefetched, order.size() - 1)];
    __builtin_prefetch(&positions[static_cast<std::size_t>(soon.input)]);  // in no order
    const Eigen::Vector3f& p = positions[static_cast<std::size_t>(e.input)];
    if (result.cloud->empty() || result.cloud->back().getVector3fMap() != p) {
      result.cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
      result.multiplicity.push_back(0);
    }
    ++result.multiplicity.back();
    result.id_of_input[static_cast<std::size_t>(e.input)] =
        static_cast<pcl::index_t>(result.cloud->size()) - 1;
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

DistinctPositions findDistinctPositions(const std::vector<Eigen::Vector3f>& positions) {
  const Cube cube = cubeAround(positions);
  const std::vector<Entry> order = mortonOrder(positions, cube);
  const DistinctPositions distinct = distinctInOrder(positions, order);
  if (!areCrowded(distinct, order)) {
    return distinct;
  }
  return distinctInOrder(positions, mortonOrder(positions, withoutOutliers(*distinct.cloud, cube)));
}

}  // namespace storey::detail
