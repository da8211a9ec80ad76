// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/hidden_views.h>
#include <storey/surface/detail/seam_levelling.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kPrior = 0.001;      // steps fade out over some 1 / sqrt(0.001) = 30 blocks
constexpr float kLargestStep = 0.3f;  // logarithm: more is another thing shown, not another shade
constexpr float kDarkest = 8.0f;      // grey levels, below which a ratio is noise

/// The part of d_ab that one block tells, that both photos show; false if it tells nothing.
bool stepAt(const std::vector<BlockView>& here, int photo_a, int photo_b,
            const std::vector<Eigen::Array3f>& gains, Eigen::Array3f& step) {
  const BlockView* const a = findView(here, photo_a);
  const BlockView* const b = findView(here, photo_b);
  if (a == nullptr || b == nullptr || a->hidden || b->hidden) return false;
  Eigen::Array3f sum_a = Eigen::Array3f::Zero();
  Eigen::Array3f sum_b = Eigen::Array3f::Zero();
  for (std::size_t c = 0; c < kCells; ++c) {
    if (!a->shown[c] || !b->shown[c]) continue;
    sum_a += a->colors[c] * gains[static_cast<std::size_t>(photo_a)];
    sum_b += b->colors[c] * gains[static_cast<std::size_t>(photo_b)];
  }
  if (std::min(sum_a.minCoeff(), sum_b.minCoeff()) < kDarkest) return false;
  step = (sum_b / sum_a).log();
  return step.abs().maxCoeff() < kLargestStep;
}

class SeamSystem {
 public:
  SeamSystem(const TextureGrid& grid, const std::vector<Eigen::Array3f>& gains,
             const std::vector<std::vector<BlockView>>& views, const std::vector<int>& selected)
      : gains_(gains), views_(views), selected_(selected) {
    const auto n = static_cast<Eigen::Index>(views.size());
    right_ = Eigen::MatrixXd::Zero(n, 3);
    for (Eigen::Index b = 0; b < n; ++b) entries_.emplace_back(b, b, kPrior);
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const std::size_t block = grid.block(column, row);
        if (column + 1 < grid.columns) join(block, grid.block(column + 1, row));
        if (row + 1 < grid.rows) join(block, grid.block(column, row + 1));
      }
    }
  }

  std::vector<Eigen::Array3f> solve() const {
    Eigen::SparseMatrix<double> matrix(right_.rows(), right_.rows());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::MatrixXd logs = factors.solve(right_);
    std::vector<Eigen::Array3f> corrections;
    for (Eigen::Index b = 0; b < logs.rows(); ++b) {
      corrections.emplace_back(logs.row(b).transpose().array().exp().cast<float>());
    }
    return corrections;
  }

 private:
  int photoOf(std::size_t block) const {
    return views_[block][static_cast<std::size_t>(selected_[block])].photo;
  }

  void join(std::size_t a, std::size_t b) {
    if (selected_[a] < 0 || selected_[b] < 0) return;
    Eigen::Array3d step = Eigen::Array3d::Zero();
    if (photoOf(a) != photoOf(b)) {
      int count = 0;
      for (const std::size_t block : {a, b}) {
        Eigen::Array3f part;
        if (!stepAt(views_[block], photoOf(a), photoOf(b), gains_, part)) continue;
        step += part.cast<double>();
        ++count;
      }
      if (count == 0) return;
      step /= count;
    }
    const auto i = static_cast<Eigen::Index>(a);
    const auto j = static_cast<Eigen::Index>(b);
    entries_.emplace_back(i, i, 1.0);
    entries_.emplace_back(j, j, 1.0);
    entries_.emplace_back(i, j, -1.0);
    entries_.emplace_back(j, i, -1.0);
    right_.row(i) += step.matrix().transpose();
    right_.row(j) -= step.matrix().transpose();
  }

  const std::vector<Eigen::Array3f>& gains_;
  const std::vector<std::vector<BlockView>>& views_;
  const std::vector<int>& selected_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::MatrixXd right_;
};

}  // namespace

std::vector<Eigen::Array3f> levelSeams(const TextureGrid& grid,
                                       const std::vector<Eigen::Array3f>& gains,
                                       const std::vector<std::vector<BlockView>>& views,
                                       const std::vector<int>& selected) {
  return SeamSystem(grid, gains, views, selected).solve();
}

}  // namespace storey::detail
