// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/kdtree/kdtree_flann.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/position_refinement.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

// Notation, as in the paper: x_i0 is where point i was, x_i = x_i0 + t_i n_i where it goes, and
// w_ij = phi(|x_i0 - x_j0|) psi(n_i, n_j). With the weights fixed, (8) is linear in t:
//
//     t_i <- (c_i + sum_j a_ij t_j) / (sum_j w_ij + beta)
//     c_i = sum_j w_ij n_i.(x_j0 - x_i0),   a_ij = w_ij n_i.n_j
//
// so an iteration needs one float and one index a neighbour.
namespace storey::detail {
namespace {

using Tree = pcl::KdTreeFLANN<pcl::PointXYZ>;

constexpr std::size_t kRowsPerBlock = 1024;
constexpr std::size_t kNoiseSamples = 300;  // sigma_p need not be sharper than a few percent
constexpr double kSmallest =
    std::numeric_limits<double>::min();     // to divide by, where squares vanish
constexpr double kNormalQuartile = 0.6745;  // median of |x| for x ~ N(0, 1)
constexpr double kNoisePerSigmaP = 5.0;    // deviations: the direction of a wall shows from here on
constexpr double kSpacingPerSigmaP = 2.0;  // so that neighbours weigh something

// Points sorted along a Morton curve. Of points at one position the first is a neighbour to others,
// so that a heap of copies is no burden.
struct Rows {
  DistinctPositions distinct;
  std::vector<std::size_t> input;      // row -> place in the input
  std::vector<std::size_t> first_row;  // distinct id -> first of its rows
  std::vector<pcl::index_t> id;        // row -> distinct id
};

Rows sortIntoRows(const std::vector<Eigen::Vector3f>& positions) {
  Rows rows;
  rows.distinct = findDistinctPositions(positions);
  rows.first_row.reserve(rows.distinct.cloud->size());
  std::size_t num_rows = 0;
  for (const std::uint32_t copies : rows.distinct.multiplicity) {
    rows.first_row.push_back(num_rows);
    num_rows += copies;
  }
  rows.input.resize(num_rows);
  rows.id.resize(num_rows);
  std::vector<std::size_t> next = rows.first_row;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const pcl::index_t id = rows.distinct.id_of_input[i];
    const std::size_t row = next[static_cast<std::size_t>(id)]++;
    rows.input[row] = i;
    rows.id[row] = id;
  }
  return rows;
}

// The rows [first, first + begin.size() - 1) of the system, compressed.
struct Block {
  std::size_t first = 0;
  std::vector<std::size_t> begin;    // row -> its first entry; one more at the end
  std::vector<pcl::index_t> column;  // row of the neighbour
  std::vector<float> coefficient;    // a_ij
  std::vector<double> constant;      // c_i
  std::vector<double> weight;        // sum_j w_ij + beta
};

class SystemBuilder {
 public:
  SystemBuilder(const OrientedPositions& points, const Rows& rows,
                const RefinementParameters& parameters)
      : points_(points), rows_(rows), parameters_(parameters), tree_(false) {
    tree_.setInputCloud(rows.distinct.cloud);
  }

  Block build(std::size_t first) const {
    const std::size_t last = std::min(first + kRowsPerBlock, rows_.input.size());
    Block block;
    block.first = first;
    block.begin.push_back(0);
    pcl::Indices neighbors;
    std::vector<float> squared_distances;
    for (std::size_t row = first; row < last; ++row) {
      if (row == first || rows_.id[row] != rows_.id[row - 1]) {  // copies share their neighbours
        search(rows_.id[row], neighbors, squared_distances);
      }
      addRow(row, neighbors, squared_distances, block);
    }
    return block;
  }

 private:
  // Ids of the neighbours, the point's own among them.
  void search(pcl::index_t id, pcl::Indices& neighbors,
              std::vector<float>& squared_distances) const {
    const pcl::PointXYZ& p = (*rows_.distinct.cloud)[static_cast<std::size_t>(id)];
    if (parameters_.k > 0) {
      const std::size_t k =
          std::min(static_cast<std::size_t>(parameters_.k) + 1, rows_.distinct.cloud->size());
      tree_.nearestKSearch(p, static_cast<unsigned>(k), neighbors, squared_distances);
    } else {
      tree_.radiusSearch(p, parameters_.radius, neighbors, squared_distances,
                         kMaxRadiusNeighbors + 1);
    }
  }

  void addRow(std::size_t row, const pcl::Indices& neighbors,
              const std::vector<float>& squared_distances, Block& block) const {
    const double inverse_sigma_p2 =
        1.0 / std::max(parameters_.sigma_p * parameters_.sigma_p, kSmallest);
    const double inverse_bend = 1.0 / std::max(1.0 - std::cos(parameters_.sigma_n), kSmallest);
    const std::size_t i = rows_.input[row];
    const Eigen::Vector3d x_i = points_.positions[i].cast<double>();
    const Eigen::Vector3d n_i = points_.normals[i].cast<double>();
    double constant = 0.0;
    double weight = 0.0;
    for (std::size_t m = 0; m < neighbors.size(); ++m) {
      if (neighbors[m] == rows_.id[row]) {
        continue;
      }
      const std::size_t column = rows_.first_row[static_cast<std::size_t>(neighbors[m])];
      const std::size_t j = rows_.input[column];
      const double cosine = n_i.dot(points_.normals[j].cast<double>());
      const double bend = (1.0 - cosine) * inverse_bend;
      const double w = std::exp(-squared_distances[m] * inverse_sigma_p2 - bend * bend);  // (2)
      constant += w * n_i.dot(points_.positions[j].cast<double>() - x_i);
      weight += w;
      block.column.push_back(static_cast<pcl::index_t>(column));
      block.coefficient.push_back(static_cast<float>(w * cosine));
    }
    block.begin.push_back(block.column.size());
    block.constant.push_back(constant);
    block.weight.push_back(weight + parameters_.beta);
  }

  const OrientedPositions& points_;
  const Rows& rows_;
  const RefinementParameters& parameters_;
  Tree tree_;
};

// (8) for the rows of a block. A point without neighbours and beta stays.
void iterate(const Block& block, const std::vector<double>& t, std::vector<double>& t_next) {
  for (std::size_t r = 0; r < block.constant.size(); ++r) {
    double sum = block.constant[r];
    for (std::size_t m = block.begin[r]; m < block.begin[r + 1]; ++m) {
      sum +=
          static_cast<double>(block.coefficient[m]) * t[static_cast<std::size_t>(block.column[m])];
    }
    t_next[block.first + r] = block.weight[r] > 0.0 ? sum / block.weight[r] : 0.0;
  }
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double deriveSigmaP(const OrientedPositions& points) {
  const Rows rows = sortIntoRows(points.positions);
  const auto& cloud = rows.distinct.cloud;
  if (cloud->size() < 2) {
    return 0.0;
  }
  Tree tree(true);  // nearest first
  tree.setInputCloud(cloud);
  const std::size_t n = cloud->size();
  const std::size_t k = std::min(n, std::clamp<std::size_t>(n / 100, 20, 200));  // as CloudScale
  const std::size_t num_samples = std::min(n, kNoiseSamples);
  std::vector<double> offsets;
  std::vector<double> spacings;
  pcl::Indices neighbors;
  std::vector<float> squared_distances;
  for (std::size_t s = 0; s < num_samples; ++s) {
    const std::size_t id = s * n / num_samples;
    tree.nearestKSearch((*cloud)[id], static_cast<unsigned>(k), neighbors, squared_distances);
    spacings.push_back(std::sqrt(static_cast<double>(squared_distances[1])));
    const Eigen::Vector3d n_i = points.normals[rows.input[rows.first_row[id]]].cast<double>();
    for (std::size_t m = 1; m < k; ++m) {
      const Eigen::Vector3d d =
          (*cloud)[static_cast<std::size_t>(neighbors[m])].getVector3fMap().cast<double>() -
          (*cloud)[id].getVector3fMap().cast<double>();
      offsets.push_back(std::abs(n_i.dot(d)));
    }
  }
  const double noise = median(offsets) / (kNormalQuartile * std::sqrt(2.0));
  return std::max(kNoisePerSigmaP * noise, kSpacingPerSigmaP * median(spacings));
}

std::vector<double> refineAlongNormals(const OrientedPositions& points,
                                       const RefinementParameters& parameters) {
  const std::size_t n = points.positions.size();
  std::vector<double> displacements(n, 0.0);
  if (n < 2 || parameters.iterations == 0) {
    return displacements;
  }
  const Rows rows = sortIntoRows(points.positions);
  const SystemBuilder builder(points, rows, parameters);
  std::vector<Block> blocks((n + kRowsPerBlock - 1) / kRowsPerBlock);
  const auto num_blocks = static_cast<std::ptrdiff_t>(blocks.size());
  std::vector<double> t(n, 0.0);
  std::vector<double> t_next(n, 0.0);
#pragma omp parallel num_threads(threadsFor(parameters.threads)) if (num_blocks > 1)
  {
#pragma omp for schedule(dynamic, 1)
    for (std::ptrdiff_t b = 0; b < num_blocks; ++b) {
      blocks[static_cast<std::size_t>(b)] =
          builder.build(static_cast<std::size_t>(b) * kRowsPerBlock);
    }
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
#pragma omp for schedule(dynamic, 1)
      for (std::ptrdiff_t b = 0; b < num_blocks; ++b) {
        iterate(blocks[static_cast<std::size_t>(b)], t, t_next);
      }
#pragma omp single
      t.swap(t_next);
    }
  }
  for (std::size_t row = 0; row < n; ++row) {
    displacements[rows.input[row]] = t[row];
  }
  return displacements;
}

}  // namespace storey::detail
