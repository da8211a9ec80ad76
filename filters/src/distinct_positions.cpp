// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/distinct_positions.h>

#include <algorithm>
#include <tuple>

namespace storey::detail {
namespace {

constexpr int kMortonBits = 21;  // per axis, 63 in all

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

std::vector<Entry> mortonOrder(const std::vector<Eigen::Vector3f>& positions) {
  std::vector<Entry> entries;
  entries.reserve(positions.size());
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kLargestCoordinate);
  Eigen::Vector3d high = -low;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (isSearchable(positions[i])) {
      entries.push_back({0, static_cast<pcl::index_t>(i)});
      low = low.cwiseMin(positions[i].cast<double>());
      high = high.cwiseMax(positions[i].cast<double>());
    }
  }
  const double side = entries.empty() ? 0.0 : (high - low).maxCoeff();
  const double scale = side > 0.0 ? ((1 << kMortonBits) - 1) / side : 0.0;
  for (Entry& e : entries) {
    const Eigen::Vector3d cell =
        (positions[static_cast<std::size_t>(e.input)].cast<double>() - low) * scale;
    e.code = spreadBits(static_cast<std::uint64_t>(cell.x())) |
             spreadBits(static_cast<std::uint64_t>(cell.y())) << 1 |
             spreadBits(static_cast<std::uint64_t>(cell.z())) << 2;
  }
  std::sort(entries.begin(), entries.end(), [&positions](const Entry& a, const Entry& b) {
    if (a.code != b.code) {
      return a.code < b.code;
    }
    const Eigen::Vector3f& p = positions[static_cast<std::size_t>(a.input)];
    const Eigen::Vector3f& q = positions[static_cast<std::size_t>(b.input)];
    return std::make_tuple(p.x(), p.y(), p.z(), a.input) <
           std::make_tuple(q.x(), q.y(), q.z(), b.input);
  });
  return entries;
}

}  // namespace

DistinctPositions findDistinctPositions(const std::vector<Eigen::Vector3f>& positions) {
  DistinctPositions result;
  result.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  result.id_of_input.assign(positions.size(), -1);
  for (const Entry& e : mortonOrder(positions)) {
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

}  // namespace storey::detail
