// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/curve_sorting.h>
#include <storey/filters/detail/distinct_positions.h>

namespace storey::detail {
namespace {

/// Positions and their places in the input.
class NumberedPositions {
 public:
  struct Record {
    Eigen::Vector3f position;
    pcl::index_t input;
  };

  explicit NumberedPositions(const std::vector<Eigen::Vector3f>& positions)
      : positions_(positions) {}

  std::size_t size() const { return positions_.size(); }
  const Eigen::Vector3f& position(std::size_t i) const { return positions_[i]; }
  Record record(std::size_t i) const { return {positions_[i], static_cast<pcl::index_t>(i)}; }
  static const Eigen::Vector3f& positionOf(const Record& record) { return record.position; }

 private:
  const std::vector<Eigen::Vector3f>& positions_;
};

using Records = std::vector<NumberedPositions::Record>;

DistinctPositions distinctOf(const Records& records, std::size_t num_distinct,
                             std::size_t num_inputs) {
  DistinctPositions distinct;
  distinct.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  distinct.cloud->reserve(num_distinct);
  distinct.multiplicity.reserve(num_distinct);
  distinct.id_of_input.assign(num_inputs, -1);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Eigen::Vector3f& p = records[i].position;
    if (i == 0 || p != records[i - 1].position) {
      distinct.cloud->points.emplace_back(p.x(), p.y(), p.z());
      distinct.multiplicity.push_back(0);
    }
    ++distinct.multiplicity.back();
    distinct.id_of_input[static_cast<std::size_t>(records[i].input)] =
        static_cast<pcl::index_t>(distinct.multiplicity.size()) - 1;
  }
  distinct.cloud->width = static_cast<std::uint32_t>(num_distinct);
  distinct.cloud->height = 1;
  return distinct;
}

}  // namespace

DistinctPositions findDistinctPositions(const std::vector<Eigen::Vector3f>& positions,
                                        unsigned int threads) {
  Records records;
  const std::size_t num_distinct = sortAlongCurve(NumberedPositions(positions), threads, records);
  return distinctOf(records, num_distinct, positions.size());
}

DistinctPositions findDistinctPositions(std::vector<Eigen::Vector3f>&& positions,
                                        unsigned int threads) {
  Records records;
  const std::size_t num_distinct = sortAlongCurve(NumberedPositions(positions), threads, records);
  const std::size_t num_inputs = positions.size();
  positions = {};  // the result needs the memory
  return distinctOf(records, num_distinct, num_inputs);
}

}  // namespace storey::detail
